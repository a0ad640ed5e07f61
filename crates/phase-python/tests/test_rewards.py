"""Rewards: Equation 1, progress, and functions of one's own, in all environments alike."""

import numpy as np
import pytest
from conftest import same

import phase_events as phase
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.rewards import Progress
from phase_events.vector import PhaseVectorEnv


def everything(step):
    """A reward that reads all there is."""
    assert step.state.shape == step.previous_state.shape == (len(step.agent), 4, 6)
    moved = np.linalg.norm(step.state[:, 0, :2] - step.previous_state[:, 0, :2], axis=1)
    numbers = (
        step.agent, step.attitude, step.action, step.other_action, step.equation_1, step.goal_holds, step.other_goal_holds,
        step.distance, step.previous_distance, step.other_distance, step.previous_other_distance, step.approach, step.previous_approach,
        moved,
    )  # fmt: skip
    assert all(one.shape == step.agent.shape for one in numbers)
    return sum((k + 1) * one.astype(np.float64) for k, one in enumerate(numbers))


@pytest.mark.parametrize("reward", ["progress", everything])
def test_one_many_and_both_agree(reward):
    scenes = [phase.sample_scene(seed=seed) for seed in range(9)]
    both = PhaseVectorEnv(9, scenes, reward=reward, threads=2)
    both.reset(seed=4)
    parallel = [PhaseParallelEnv(both.scene(world), reward=reward) for world in range(9)]
    [env.reset(seed=0) for env in parallel]
    random = np.random.default_rng(1)
    for _ in range(6):
        actions = random.integers(14, size=18)
        found = both.step(actions)[1]
        for world, env in enumerate(parallel):
            pair = actions[2 * world : 2 * world + 2]
            alone = env.step({"agent_0": pair[0], "agent_1": pair[1]})[1]
            assert list(alone.values()) == found[2 * world : 2 * world + 2].tolist()
    one = PhaseEnv("helping", agent=1, partner="random", reward=reward, max_steps=4)
    many = PhaseVectorEnv(1, "helping", agent=1, partner="random", reward=reward, max_steps=4)
    one.reset(seed=2), many.reset(seed=2)
    for action in (1, 2, 3, 4):
        assert many.step(np.array([action]))[1][0] == one.step(action)[1]
    assert many.step(np.array([1]))[1][0] == 0, "the step that begins an episode has no reward"


def test_equation_1_is_the_default():
    plain, named, function = (
        PhaseEnv("chasing", partner="random", **given)
        for given in ({}, {"reward": "equation_1"}, {"reward": lambda step: step.equation_1})
    )
    for env in (plain, named, function):
        env.reset(seed=5)
    for action in range(14):
        first = plain.step(action)
        assert same(named.step(action), first) and same(function.step(action), first)


def place(kind, alpha, sign=1):
    """An open arena: agent 0 at (8.5, 8), agent 1 at (23.5, 8), an object at (8.5, 13.5)."""
    goal = {"kind": kind, "landmark": 0, "sign": sign}
    goal |= {"object": 0} if kind == "object_on_landmark" else {"agent": 1}
    goals = (goal | {"sign": -sign if alpha < 0 else sign}, goal)
    agents = [
        {"size_level": 0, "strength_level": 2, "alpha": alpha * (1 - k), "start": {"x": x, "y": 8, "angle": 0}, "goal": goals[k]}
        for k, x in enumerate((8.5, 23.5))
    ]
    objects = [{"size_level": 0, "start": {"x": 8.5, "y": 13.5, "angle": 0}}]
    return {"layout": {"base": 0}, "objects": objects, "event": "independent", "agents": agents}


@pytest.mark.parametrize("alpha", [-1, 0, 1])
@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("kind", ["object_on_landmark", "agent_on_landmark"])
def test_progress_is_its_formula(kind, alpha, sign):
    """By hand in an open arena, where ways are straight: landmark 0 is at (8.5, 19.5)."""
    weight, discount = 0.5, 0.9
    env = PhaseParallelEnv(place(kind, alpha, sign), reward=Progress(weight, discount))
    plain = PhaseParallelEnv(place(kind, alpha, sign))
    env.reset(seed=1), plain.reset(seed=1)

    def potentials(state):
        subject = state[2] if kind == "object_on_landmark" else state[1]
        goal = sign * np.hypot(subject[0] - 8.5, subject[1] - 19.5)
        reach = [np.hypot(*(state[k, :2] - state[2, :2])) - 1.6 if kind == "object_on_landmark" else 0 for k in (0, 1)]
        # Both agents have the same goal; agent 0 helps or hinders agent 1, or is neutral.
        return [-((1 - abs(a)) * goal + a * goal + max(r, 0)) for a, r in zip((alpha, 0), reach, strict=True)]

    for actions in ((0, 0), (0, 3), (2, 1), (0, 0)):
        actions = {"agent_0": actions[0], "agent_1": actions[1]}
        before = potentials(env.state())
        rewards, base = env.step(actions)[1], plain.step(actions)[1]
        after = potentials(env.state())
        for k, agent in enumerate(rewards):
            assert rewards[agent] == pytest.approx(base[agent] + weight * (discount * after[k] - before[k]), abs=1e-4)


def test_progress_tells_where_to_go():
    """Without a discount and Equation 1, its sum is the way that has been made: the heuristic makes most of it."""
    progress = Progress(1, 1)
    env = PhaseEnv(place("object_on_landmark", 0), partner="still", reward=lambda step: progress(step) - step.equation_1)
    observation, info = env.reset(seed=1)
    policy, total = phase.HeuristicPolicy(), 0
    start = 6 + 5.5 - 1.6
    while not info["goal_holds"]:
        observation, reward, _, truncated, info = env.step(policy(observation))
        total += reward
        assert not truncated
    assert 0.7 * start < total <= start + 0.01


def test_rubbish_is_refused(scene):
    for wrong in ("progres", "Equation 1", 7, None, Progress, ["progress"], {"reward": 1}):
        for make in (lambda w: PhaseEnv(scene, reward=w), lambda w: PhaseParallelEnv(scene, reward=w), lambda w: PhaseVectorEnv(2, scene, reward=w)):
            with pytest.raises(phase.PhaseError, match="reward must be one of equation_1, progress, or a function"):
                make(wrong)
    for answer in (None, "a lot", float("nan"), [1, 2, 3], np.inf, 1.0, [[1.0]], {}, [None]):
        env = PhaseEnv(scene, partner="still", reward=lambda step, answer=answer: answer)
        env.reset(seed=1)
        with pytest.raises(phase.PhaseError, match="reward function"):
            env.step(0)
    for wrong in ({"weight": "1"}, {"weight": float("nan")}, {"discount": 2}, {"discount": None}, {"discount": True}):
        with pytest.raises(phase.PhaseError, match="number from"):
            Progress(**wrong)
