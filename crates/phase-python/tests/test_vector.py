"""Many worlds at once are the same worlds."""

import gymnasium
import numpy as np
import pytest
from conftest import QUICK

import phase_events as phase
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.vector import PhaseVectorEnv


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("engine", ["world", "forward"])
def test_each_world_is_a_single_environment(engine, threads):
    scenes = [phase.sample_scene(seed=seed) for seed in range(5)]
    vector = PhaseVectorEnv(5, scenes, engine=engine, threads=threads, copy=True)
    observations, _ = vector.reset(seed=2)
    single = [PhaseParallelEnv(vector.scene(world), engine=engine) for world in range(5)]
    first = [env.reset()[0] for env in single]
    assert np.array_equal(observations, [one[agent] for one in first for agent in ("agent_0", "agent_1")])
    random = np.random.default_rng(1)
    for _ in range(20):
        actions = random.integers(14, size=10)
        observations, rewards, _, _, _ = vector.step(actions)
        for world, env in enumerate(single):
            pair = actions[2 * world : 2 * world + 2]
            found = env.step({"agent_0": pair[0], "agent_1": pair[1]})
            for k, agent in enumerate(("agent_0", "agent_1")):
                assert np.array_equal(observations[2 * world + k], found[0][agent])
                assert rewards[2 * world + k] == found[1][agent]


def test_minds_decide_as_in_a_single_environment():
    scene = phase.sample_scene("helping", seed=5)
    vector = PhaseVectorEnv(3, scene, agent=0, partner=lambda: phase.Mind(parameters=QUICK), threads=2)
    vector.reset(seed=1)
    for _ in range(4):
        vector.step(np.array([2, 2, 2]))
    assert all(partner.thought is not None for partner in vector._partners)


@pytest.mark.parametrize("autoreset", ["next_step", "same_step"])
def test_episodes_follow_one_another(autoreset):
    vector = PhaseVectorEnv(2, agent=0, partner="still", max_steps=3, pool=4, autoreset=autoreset, copy=True)
    vector.reset(seed=1)
    ends = []
    for step in range(9):
        observations, rewards, terminated, truncated, infos = vector.step(np.array([10, 10]))
        assert not terminated.any()
        ends.append(bool(truncated.all()))
        if autoreset == "same_step" and truncated.any():
            assert infos["_final_obs"].all()
            assert infos["final_obs"][0].shape == observations[0].shape
    if autoreset == "same_step":
        assert ends == [False, False, True] * 3
    else:
        # The step after the last one begins the next episode.
        assert ends == [False, False, True, False, False, False, True, False, False]


def test_seeds_decide_everything():
    def run():
        vector = PhaseVectorEnv(4, agent=None, pool=8, max_steps=6, copy=True)
        first, _ = vector.reset(seed=9)
        random = np.random.default_rng(0)
        return [first] + [vector.step(random.integers(14, size=8))[0] for _ in range(10)]

    assert all(np.array_equal(a, b) for a, b in zip(run(), run(), strict=True))


def test_gymnasium_makes_vectors():
    vector = gymnasium.make_vec("PHASE-v0", num_envs=3, vectorization_mode="vector_entry_point", scenes="chasing", pool=4)
    observations, _ = vector.reset(seed=1)
    assert observations in vector.observation_space
    assert vector.num_envs == 3


def test_rubbish_is_refused():
    for wrong in ({"worlds": 0}, {"worlds": 1.5}, {"agent": 2}, {"engine": "x"}, {"autoreset": "never"}, {"observation": "x"}):
        with pytest.raises(phase.PhaseError):
            PhaseVectorEnv(**{"worlds": 2, **wrong})
    vector = PhaseVectorEnv(2, "helping", pool=2)
    with pytest.raises(phase.PhaseError, match="reset"):
        vector.step(np.zeros(4, dtype=np.int64))
    vector.reset(seed=1)
    for wrong in (np.zeros(3, dtype=np.int64), np.zeros(4), np.full(4, np.nan), np.full(4, 14), np.full(4, -1)):
        with pytest.raises(phase.PhaseError, match="action"):
            vector.step(wrong)
    vector.close()
    with pytest.raises(phase.PhaseError, match="closed"):
        vector.step(np.zeros(4, dtype=np.int64))
    assert isinstance(PhaseEnv, type)
