"""A recurrent PPO agent learns to help a PHASE mind, in one file after CleanRL's `ppo_atari_lstm`.

A weak agent wants an object on a landmark and cannot move it alone. The learner is strong, has the attitude 1 towards it, and sees only
its field of view. Its reward is Equation 1 of the paper: 1 for each step in which the other's goal holds, less what its own actions cost.
In training only, progress is rewarded beside it, because the reward is rare at first: each u that the helper comes closer to the object, and
the object to its place. It is the difference of a potential, but undiscounted, so it may change which policy is best (Ng, Harada and
Russell, 1999). Every episode begins with other positions.

At the end the same twenty-four new scenes are played by the learner, by a PHASE helper, by the heuristic policy and by nobody; the learning curve is
drawn beside them (OUT/curve.png, and OUT/curve.json with its numbers).

It needs `pip install "phase-events[env,torch]" matplotlib`.

Usage: learn_to_help.py [--seconds 600] [--out out/learn-to-help]
"""

import argparse
import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import torch
from torch import nn
from torch.distributions import Categorical

import phase_events as phase
from phase_events.env import PhaseEnv
from phase_events.observation import split_observation
from phase_events.policies import HeuristicPolicy, Mind, StillPolicy
from phase_events.vector import PhaseVectorEnv

HELPER, PARTNER, OBJECT = 1, 0, 2  # numbers of bodies
LANDMARK = 3  # bottom left
PLACE = np.array([8.5, 4.5])  # its centre (u)


@dataclass(frozen=True)
class Settings:
    """What PPO is told. Common values; the numbers of worlds and minibatches, the discount and the shaping were chosen by hand, by how the
    first two minutes of training with seed 1 went."""

    worlds: int = 64
    horizon: int = 80  # steps of an episode, and of each world between two updates
    discount: float = 0.97
    trace: float = 0.95  # lambda of the generalised advantage estimate
    clip: float = 0.2
    entropy: float = 0.01
    learning_rate: float = 1e-3
    epochs: int = 4
    minibatches: int = 4  # of whole episodes, as the network is recurrent
    hidden: int = 128
    shaping: float = 0.5  # reward of progress by 1 u
    simulations: int = 50  # of the partner's search at each decision


def scene(seed):
    """An arena without inner walls; the places of the three bodies are random."""
    random = np.random.default_rng(seed)
    radii = {PARTNER: 0.8, HELPER: 1.2, OBJECT: 1.6}
    while True:
        places = {body: random.uniform([7 + r, 3 + r], [25 - r, 21 - r]) for body, r in radii.items()}
        apart = [
            np.linalg.norm(places[a] - places[b]) > radii[a] + radii[b] + 0.2 for a, b in ((0, 1), (0, 2), (1, 2))
        ]
        if all(apart) and np.linalg.norm(places[OBJECT] - PLACE) > 6:
            break

    def start(body, angle):
        x, y = places[body].tolist()
        return {"x": x, "y": y, "vx": 0, "vy": 0, "angle": angle, "angular_velocity": 0}

    def agent(number, size_level, strength_level, force, alpha):
        goal = {"kind": "object_on_landmark", "object": 0, "landmark": LANDMARK, "sign": 1}
        return {
            "radius": radii[number],
            "size_level": size_level,
            "max_force": force,
            "strength_level": strength_level,
            "goal": goal,
            "alpha": alpha,
            "start": start(number, random.uniform(-np.pi, np.pi)),
        }

    return phase.scene(
        {
            "layout": {"base": 0, "flip": 0},
            "agents": [agent(PARTNER, 0, 0, 150, 0), agent(HELPER, 1, 3, 600, 1)],
            "objects": [{"radius": radii[OBJECT], "size_level": 2, "start": start(OBJECT, 0)}],
            "event": "helping",
        }
    )


def features(observations):
    """What the network is given: an observation without the four hundred cells of the field of view, seen from the agent, scaled to
    about 1. The first axis of its frame points to its right, the second ahead."""
    parts = split_observation(observations)
    entities = parts["entities"]
    own = entities[..., :1, :]
    cosine, sine = own[..., 5], own[..., 6]

    def turned(vectors):
        x, y = vectors[..., 0], vectors[..., 1]
        return np.stack([cosine * x + sine * y, cosine * y - sine * x], axis=-1)

    seen = entities[..., 1:2]
    places = turned(entities[..., 3:5] - own[..., 3:5]) / 9 * seen
    velocities = turned(entities[..., 8:10]) / 4 * seen
    goal = turned(PLACE - own[..., 3:5]) / 9
    flat = [entities[..., :3], places, velocities, entities[..., 10:] / 4, goal, own[..., 3:5] / 9 - 1.5, own[..., 5:7]]
    flat += [parts["grips"], parts["contacts"], parts["holds"]]
    batch = observations.shape[:-1]
    return torch.as_tensor(np.concatenate([part.reshape(*batch, -1) for part in flat], axis=-1), dtype=torch.float32)


class Network(nn.Module):
    """Features, an LSTM, and on it the policy and the value."""

    def __init__(self, inputs, hidden):
        super().__init__()
        self.encode = nn.Sequential(nn.Linear(inputs, hidden), nn.Tanh())
        self.memory = nn.LSTM(hidden, hidden)
        self.policy = nn.Linear(hidden, len(phase.ACTIONS))
        self.value = nn.Linear(hidden, 1)
        nn.init.orthogonal_(self.policy.weight, 0.01)
        nn.init.orthogonal_(self.value.weight, 1.0)

    def forward(self, features, state=None):
        """`features` is (steps, worlds, inputs); each sequence begins where `state` ended, or an episode begins."""
        hidden, state = self.memory(self.encode(features), state)
        return Categorical(logits=self.policy(hidden)), self.value(hidden).squeeze(-1), state


class Learned:
    """The network as a policy of the package."""

    def __init__(self, network):
        self.network, self.state = network, None

    def reset(self, scene, agent, seed):
        """Forgets the last episode."""
        self.state = None

    def __call__(self, observation):
        with torch.no_grad():
            policy, _, self.state = self.network(features(observation[None, None]), self.state)
        return int(policy.sample())


def potential(env):
    """Larger the closer the helper is to the object and the object to its place, (worlds,)."""
    bodies = env.state()[..., :2]
    carried = np.linalg.norm(bodies[:, OBJECT] - PLACE, axis=-1)
    reached = np.linalg.norm(bodies[:, HELPER] - bodies[:, OBJECT], axis=-1)
    return -(carried + 0.5 * reached)


def rollout(env, network, settings, seed):
    """One episode in every world: features, actions, log probabilities, values, shaped rewards, the value of what follows, returns."""
    observations, _ = env.reset(seed=seed)
    state, before, total = None, potential(env), np.zeros(settings.worlds)
    steps = []
    for _ in range(settings.horizon):
        seen = features(observations)
        with torch.no_grad():
            policy, value, state = network(seen[None], state)
            action = policy.sample()
        observations, reward, _, _, _ = env.step(action[0].numpy())
        total += reward
        after = potential(env)
        shaped = reward + settings.shaping * (after - before)
        before = after
        steps.append((seen, action[0], policy.log_prob(action)[0], value[0], torch.as_tensor(shaped, dtype=torch.float32)))
    with torch.no_grad():
        _, following, _ = network(features(observations)[None], state)
    return *(torch.stack(part) for part in zip(*steps, strict=True)), following[0], total


def advantages(values, rewards, following, settings):
    """Generalised advantage estimates. That an episode is cut off is no reason to expect nothing more: `following` stands for it."""
    estimate, result = torch.zeros_like(following), torch.zeros_like(values)
    for step in reversed(range(len(values))):
        error = rewards[step] + settings.discount * following - values[step]
        estimate = error + settings.discount * settings.trace * estimate
        result[step], following = estimate, values[step]
    return result


def update(network, optimiser, batch, settings):
    """PPO on whole episodes."""
    seen, actions, old, values, rewards, following = batch
    gains = advantages(values, rewards, following, settings)
    targets = gains + values
    gains = (gains - gains.mean()) / (gains.std() + 1e-8)
    for _ in range(settings.epochs):
        for worlds in torch.randperm(settings.worlds).chunk(settings.minibatches):
            policy, value, _ = network(seen[:, worlds])
            ratio = (policy.log_prob(actions[:, worlds]) - old[:, worlds]).exp()
            gain = gains[:, worlds]
            surrogate = torch.minimum(ratio * gain, ratio.clamp(1 - settings.clip, 1 + settings.clip) * gain).mean()
            loss = -surrogate + 0.5 * (value - targets[:, worlds]).square().mean() - settings.entropy * policy.entropy().mean()
            optimiser.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(network.parameters(), 0.5)
            optimiser.step()


def returns(helper, scenes, settings):
    """Returns of a helper, one for each scene."""
    totals = []
    for number, one in enumerate(scenes):
        partner = Mind(parameters={"simulations": settings.simulations})
        env = PhaseEnv(one, agent=HELPER, partner=partner, engine="forward", max_steps=settings.horizon)
        observation, _ = env.reset(seed=number)
        if hasattr(helper, "reset"):
            helper.reset(one, HELPER, number)
        total, over = 0.0, False
        while not over:
            observation, reward, _, over, _ = env.step(helper(observation))
            total += reward
        totals.append(total)
    return np.array(totals)


def draw(curve, finals, path):
    """The learning curve beside what others achieve."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    steps, means = np.array(curve["steps"]) / 1000, np.array(curve["returns"])
    axes.plot(steps, means, label="PPO with an LSTM, in training")
    for (name, numbers), style in zip(finals.items(), ("-", "--", ":", "-."), strict=True):
        axes.axhline(np.mean(numbers), color="black", linestyle=style, linewidth=1, label=f"{name}, 24 new scenes: {np.mean(numbers):.1f}")
    axes.set(xlabel="steps (thousand)", ylabel="return of an episode of 80 steps", title="Learning to help a PHASE mind")
    axes.legend(fontsize="small")
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600, help="how long it learns")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("out/learn-to-help"))
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    settings = Settings()
    torch.manual_seed(arguments.seed)
    torch.set_num_threads(1)  # matrices this small are faster on one; the minds use the other cores

    env = PhaseVectorEnv(
        settings.worlds,
        scenes=scene,
        agent=HELPER,
        partner=lambda: Mind(parameters={"simulations": settings.simulations}),
        pool=settings.worlds,
        engine="forward",
        max_steps=settings.horizon + 1,
    )
    inputs = features(env.reset(seed=0)[0]).shape[-1]
    network = Network(inputs, settings.hidden)
    optimiser = torch.optim.Adam(network.parameters(), settings.learning_rate, eps=1e-5)
    curve = {"steps": [], "seconds": [], "returns": []}
    begun, number = time.perf_counter(), 0
    while time.perf_counter() - begun < arguments.seconds:
        *batch, totals = rollout(env, network, settings, seed=1_000_000 * arguments.seed + number)
        update(network, optimiser, batch, settings)
        number += 1
        curve["steps"].append(number * settings.worlds * settings.horizon)
        curve["seconds"].append(round(time.perf_counter() - begun, 1))
        curve["returns"].append(float(totals.mean()))
        if number % 10 == 1:
            print(f"{curve['seconds'][-1]:6.0f} s  {curve['steps'][-1]:8d} steps  return {np.mean(curve['returns'][-10:]):6.2f}", flush=True)

    scenes = [scene(seed) for seed in range(24)]
    helpers = {"learned": Learned(network), "PHASE mind": Mind(), "heuristic": HeuristicPolicy(), "nobody": StillPolicy()}
    finals = {name: returns(helper, scenes, settings).tolist() for name, helper in helpers.items()}
    for name, numbers in finals.items():
        error = 1.96 * np.std(numbers, ddof=1) / len(numbers) ** 0.5
        print(f"{name:>12}: {np.mean(numbers):6.2f} +- {error:.2f}")
    document = {"settings": asdict(settings), "curve": curve, "finals": finals}
    (arguments.out / "curve.json").write_text(json.dumps(document) + "\n")
    draw(curve, finals, arguments.out / "curve.png")
    print(f"curve in {arguments.out / 'curve.png'}")


if __name__ == "__main__":
    main()
