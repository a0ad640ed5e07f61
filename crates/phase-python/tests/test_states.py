"""A state that is saved and restored goes on as it did, bit for bit, with its partner and in other processes."""

import pickle
import random as chance
import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from conftest import QUICK, same

import phase_events as phase
from phase_events._native import ENGINES
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.vector import PhaseVectorEnv

WAYS = {"kept": lambda state: state, "pickle": lambda state: pickle.loads(pickle.dumps(state))}
ways = pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
ATTACH, DETACH = phase.ACTIONS.index("attach"), phase.ACTIONS.index("detach")


def crowded(seed):
    """A sampled scene whose bodies are close together, so that they push and grip each other."""
    scene = phase.sample_scene("helping", variant="fetch", seed=seed).to_dict()
    places = np.random.default_rng(seed).uniform(0, 4, (4, 2)) + np.array([8.0, 4.0])
    for body, (x, y) in zip((*scene["agents"], *scene["objects"]), places.tolist(), strict=False):
        body["start"].update(x=x, y=y)
    return phase.scene(scene)


def actions_of(random, count):
    """Random actions, attaching and detaching more often than others."""
    return random.choice([*range(14), *[ATTACH] * 4, *[DETACH] * 2], size=count)


@ways
@pytest.mark.parametrize("engine", ENGINES)
def test_any_moment_of_any_scene(way, engine):
    """Random scenes, moments and actions; the environment goes elsewhere between saving and restoring."""
    held = touched = 0
    for case in range(15):
        random = np.random.default_rng(case)
        env = PhaseParallelEnv(crowded, engine=engine, max_steps=30)
        env.reset(seed=case)

        def play(steps, env=env, random=random):
            found = []
            for first, second in actions_of(random, (steps, 2)):
                # After its last step an episode is followed by the next.
                found.append(env.step({"agent_0": first, "agent_1": second}) if env.agents else env.reset())
                found.append((env.state(), env._arena.observations.copy()))
            return tuple(found)

        play(int(random.integers(1, 28)))
        parts = phase.split_observation(env._arena.observations[0])
        held, touched = held + parts["grips"][:, 0, :2].any(), touched + parts["contacts"].any()
        state, position = env.get_state(), random.bit_generator.state
        here = play(12)
        play(7)
        observations, infos = env.set_state(way(state))
        assert env.seed == state.seed and env.scene.to_json() == state.scene.to_json()
        assert np.array_equal(observations["agent_1"], env._arena.observations[0, 1]) and infos.keys() == observations.keys()
        random.bit_generator.state = position
        assert same(play(12), here), case
    assert held >= 3 and touched >= 5, "the moments must be eventful for this to test anything"


class Counting:
    """A policy with a memory and random numbers of its own."""

    def reset(self, scene, agent, seed):
        self.random, self.count = chance.Random(seed), 0

    def __call__(self, observation):
        self.count += 1
        return (self.count + self.random.randrange(14)) % 14


@ways
@pytest.mark.parametrize("partner", ["phase", "heuristic", "random", "still", Counting], ids=str)
def test_partners_go_on(way, partner):
    partner = phase.Mind(parameters=QUICK) if partner == "phase" else partner
    env = PhaseEnv("helping", agent=1, partner=partner, max_steps=12)
    env.reset(seed=3)
    play = lambda steps: [env.step(2) if not env._arena.truncated else env.reset() for _ in range(steps)]  # noqa: E731
    play(4)
    state = env.get_state()
    here = play(11)
    for _ in range(2):
        env.set_state(way(state))
        assert all(map(same, play(11), here)), "as often as one likes, and into the next episode"


def test_minds_keep_beliefs_and_reasons():
    env = PhaseEnv("helping", partner=phase.Mind(parameters=QUICK))
    env.reset(seed=1)
    for _ in range(3):
        env.step(0)
    state = env.get_state()
    belief, thought = env.partner.belief, env.partner.thought
    env.step(1)
    assert not np.array_equal(env.partner.belief, belief)
    env.set_state(state)
    assert np.array_equal(env.partner.belief, belief) and env.partner.thought == thought


CHILD = """
import pickle, sys
import numpy as np
from phase_events.env import PhaseEnv
from phase_events.policies import Mind
env = PhaseEnv("helping", agent=1, partner=Mind(parameters={"simulations": 50, "particles": 10}), max_steps=12)
env.set_state(pickle.load(sys.stdin.buffer))
found = [env.step(2) if not env._arena.truncated else env.reset() for _ in range(11)]
sys.stdout.buffer.write(pickle.dumps(found))
"""


def test_another_process_goes_on():
    """A new interpreter, with an environment that was never reset."""
    env = PhaseEnv("helping", agent=1, partner=phase.Mind(parameters=QUICK), max_steps=12)
    env.reset(seed=3)
    for action in (2, ATTACH, 4, 5):
        env.step(action)
    state = pickle.dumps(env.get_state())
    done = subprocess.run([sys.executable, "-c", CHILD], input=state, capture_output=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr.decode()
    here = [env.step(2) if not env._arena.truncated else env.reset() for _ in range(11)]
    assert all(map(same, pickle.loads(done.stdout), here))


@ways
@pytest.mark.parametrize("autoreset", ["next_step", "same_step", "disabled"])
@pytest.mark.parametrize("agent", [None, 0])
def test_vector_environments(way, autoreset, agent):
    def made():
        partner = phase.Mind(parameters=QUICK)
        return PhaseVectorEnv(
            3, "helping", agent=agent, partner=partner, pool=2, max_steps=6, autoreset=autoreset, threads=2
        )

    env = made()
    env.reset(seed=1)
    random = np.random.default_rng(0)

    def play(env, actions):
        found = []
        for row in actions:
            if autoreset == "disabled" and env._over.any():
                found.append(env.reset(options={"reset_mask": env._rows(env._over)}))
            found.append(env.step(row))
        return tuple(found)

    play(env, random.integers(14, size=(4, env.num_envs)))
    states = env.get_state()
    actions = random.integers(14, size=(9, env.num_envs))
    here = play(env, actions)
    other = made()
    other.set_state(way(states))
    assert same(play(other, actions), here), "an environment that was never reset"
    env.reset(seed=9)
    env.set_state(states)
    assert same(play(env, actions), here), "the pool is restored, too"


def test_some_worlds_go_back_and_others_stay():
    env = PhaseVectorEnv(4, "chasing", agent=0, partner="random")
    env.reset(seed=1)
    env.step(np.array([1, 2, 3, 4]))
    state = env.get_state()[1]
    env.step(np.array([5, 5, 5, 5]))
    before = env.state()
    observations, infos = env.set_state(state, worlds=[0, 2])
    assert np.array_equal(observations[0], observations[2])
    assert np.array_equal(env.state()[[1, 3]], before[[1, 3]]) and not np.array_equal(env.state()[0], before[0])
    assert infos["_goal_holds"].tolist() == [True, False, True, False]
    single = PhaseEnv("chasing", partner="random")
    single.set_state(state)
    for action in (3, 7, 9):
        found = env.step(np.array([action, 0, action, 0]))
        alone = single.step(action)
        assert np.array_equal(found[0][0], alone[0]) and np.array_equal(found[0][2], alone[0])
        assert found[1][0] == alone[1] and found[4]["partner_action"][0] == alone[4]["partner_action"]


def test_a_pool_goes_along_until_there_is_a_new_seed():
    many = PhaseVectorEnv(2, "helping", agent=0, partner="random", pool=2, max_steps=1)
    many.reset(seed=1)
    single = PhaseEnv("helping", partner="random", max_steps=1)
    single.set_state(many.get_state()[0])
    many.step(np.array([0, 0])), many.step(np.array([0, 0]))
    single.reset()
    assert single.scene.to_json() == many.scene(0).to_json()
    fresh = PhaseEnv("helping", partner="random")
    single.reset(seed=5), fresh.reset(seed=5)
    assert single.scene.to_json() == fresh.scene.to_json()


def test_gymnasium_calls_it_in_workers():
    many = gymnasium.make_vec("PHASE-v0", num_envs=2, vectorization_mode="sync", scenes="chasing", partner="random")
    many.reset(seed=1)
    states = many.call("get_state")
    first = many.step(np.array([2, 3]))
    for env, state in zip(many.envs, states, strict=True):
        env.unwrapped.set_state(state)
    assert same(many.step(np.array([2, 3])), first)


def test_what_is_no_state():
    env = PhaseEnv("helping", partner="random")
    with pytest.raises(phase.PhaseError, match="reset"):
        env.get_state()
    env.reset(seed=1)
    state = env.get_state()
    vector = PhaseVectorEnv(2, "helping", agent=0, partner="random")
    with pytest.raises(phase.PhaseError, match="reset"):
        vector.get_state()
    with pytest.raises(phase.PhaseError, match="first"):
        vector.set_state(state, worlds=[0])
    for wrong in (None, 7, {}, b"", [state], "state", env):
        with pytest.raises(phase.PhaseError, match="state"):
            env.set_state(wrong)
    for wrong in (None, 7, [state], [state] * 3, [state, 7], {0: state}):
        with pytest.raises(phase.PhaseError, match="state"):
            vector.set_state(wrong)
    vector.set_state(state)
    for worlds in ([2], [-1], [0.5], [True]):
        with pytest.raises(phase.PhaseError, match="world"):
            vector.set_state(state, worlds=worlds)
    with pytest.raises(phase.PhaseError, match="engine world"):
        PhaseEnv("helping", partner="random", engine="forward").set_state(state)
    for partner in ("still", "phase"):
        with pytest.raises(phase.PhaseError, match="partner"):
            PhaseEnv("helping", partner=partner).set_state(state)
    env.close()
    for use in (env.get_state, lambda: env.set_state(state)):
        with pytest.raises(phase.PhaseError, match="closed"):
            use()
