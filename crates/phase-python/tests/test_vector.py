"""Many worlds at once are the same worlds."""

import gymnasium
import numpy as np
import pytest
from conftest import QUICK, same
from gymnasium.vector import AutoresetMode

import phase_events as phase
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.vector import AUTORESETS, PhaseVectorEnv


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("engine", ["world", "forward"])
def test_each_world_is_a_single_environment(engine, threads):
    scenes = [phase.sample_scene(seed=seed) for seed in range(5)]
    vector = PhaseVectorEnv(5, scenes, engine=engine, threads=threads)
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
    mind = phase.Mind(parameters=QUICK)
    vector = PhaseVectorEnv(3, scene, agent=0, partner=mind, threads=2)
    made = PhaseVectorEnv(3, scene, agent=0, partner=lambda: phase.Mind(parameters=QUICK), threads=1)
    assert same(vector.reset(seed=1), made.reset(seed=1))
    for _ in range(4):
        assert same(vector.step(np.array([2, 2, 2])), made.step(np.array([2, 2, 2])))
    assert len({id(partner) for partner in (*vector._partners, mind)}) == 4, "each world has a mind of its own"


@pytest.mark.parametrize("autoreset", ["next_step", "same_step"])
def test_episodes_follow_one_another(autoreset):
    vector = PhaseVectorEnv(2, agent=0, partner="still", max_steps=3, pool=4, autoreset=autoreset)
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
        vector = PhaseVectorEnv(4, agent=None, pool=8, max_steps=6)
        first, _ = vector.reset(seed=9)
        random = np.random.default_rng(0)
        return [first] + [vector.step(random.integers(14, size=8))[0] for _ in range(10)]

    assert all(np.array_equal(a, b) for a, b in zip(run(), run(), strict=True))


@pytest.mark.parametrize("mode", list(AutoresetMode), ids=lambda mode: mode.name)
@pytest.mark.parametrize("partner", ["phase", "heuristic", "random"])
def test_one_id_is_one_task(partner, mode):
    """`make`, `make_vec` in one call, and `make_vec` one after the other: equal bit for bit, with all infos."""
    partner = phase.Mind(parameters=QUICK) if partner == "phase" else partner
    arguments = {"partner": partner, "max_steps": 4, "agent": 1}
    autoreset = {value: name for name, value in AUTORESETS.items()}[mode]
    together = gymnasium.make_vec("PHASE-v0", num_envs=3, autoreset=autoreset, threads=2, **arguments)
    apart = gymnasium.make_vec(
        "PHASE-v0", num_envs=3, vectorization_mode="sync", vector_kwargs={"autoreset_mode": mode}, **arguments
    )
    single = gymnasium.make("PHASE-v0", **arguments)
    assert together.metadata["autoreset_mode"] == mode == apart.metadata["autoreset_mode"]
    assert together.single_observation_space == single.observation_space
    assert together.action_space == apart.action_space
    assert same(together.reset(seed=[5, 2**40, 7]), apart.reset(seed=[5, 2**40, 7]))
    assert same(together.reset(seed=3), apart.reset(seed=3))
    assert same(together.reset(), apart.reset()), "without a seed it goes on drawing"
    observations, infos = together.reset(seed=3)
    observation, info = single.reset(seed=3)
    assert np.array_equal(observations[0], observation) and infos["goal_holds"][0] == info["goal_holds"]
    apart.reset(seed=3)
    random = np.random.default_rng(1)
    for step in range(11):
        actions = random.integers(14, size=3)
        found = together.step(actions)
        assert same(found, apart.step(actions))
        if step < 4:
            observation, reward, _, truncated, info = single.step(actions[0])
            assert found[1][0] == reward and found[3][0] == truncated
            assert np.array_equal(found[4]["final_obs"][0] if "final_obs" in found[4] else found[0][0], observation)
            last = found[4].get("final_info", found[4])
            assert info == {name: last[name][0] for name in info}
        if mode == AutoresetMode.DISABLED and step % 4 == 3:
            for mask in ([True, False, True], [False, True, False]):
                mask = {"reset_mask": np.array(mask)}
                assert same(together.reset(options=dict(mask)), apart.reset(options=dict(mask)))
    assert same(together.reset(options={"scene": "chasing"}), apart.reset(options={"scene": "chasing"}))
    assert [together.unwrapped.scene(world).kind for world in range(3)] == ["chasing"] * 3


def test_the_defaults_are_one_task():
    together, apart = (gymnasium.make_vec("PHASE-v0", num_envs=1, vectorization_mode=mode) for mode in ("vector_entry_point", "sync"))
    assert same(together.reset(seed=1), apart.reset(seed=1))
    assert same(together.step(np.array([2])), apart.step(np.array([2])))
    assert type(together.unwrapped._partners[0]) is type(apart.envs[0].unwrapped._partner) is phase.Mind


def test_a_mask_resets_some_worlds():
    vector = PhaseVectorEnv(3, pool=4)
    with pytest.raises(phase.PhaseError, match="reset_mask"):
        vector.reset(options={"reset_mask": np.array([True] * 4 + [False] * 2)})
    vector.reset(seed=1)
    for _ in range(5):
        before, *_ = vector.step(np.full(6, 2))
    scenes = [vector.scene(world).to_json() for world in range(3)]
    after, infos = vector.reset(seed=[None, 8, None], options={"reset_mask": np.array([False, False, True, True, False, False])})
    rows = np.array([True, True, False, False, True, True])
    assert np.array_equal(before[rows], after[rows]) and not (before[~rows] == after[~rows]).all(axis=1).any()
    assert np.array_equal(infos["_goal_holds"], ~rows)
    assert [vector.scene(world).to_json() for world in (0, 2)] == [scenes[0], scenes[2]]
    for wrong in ([True] * 6, np.ones(3, bool), np.ones(6, int), np.zeros(6, bool), np.arange(6) % 2 == 0, "all", None):
        with pytest.raises(phase.PhaseError, match="reset_mask"):
            vector.reset(options={"reset_mask": wrong})
    assert np.array_equal(vector.step(np.full(6, 10))[0].shape, after.shape)


def test_worlds_that_a_mask_leaves_go_on():
    """Their observations, rewards and partners are those of worlds next to which nothing begins, bit for bit."""
    envs = [PhaseVectorEnv(4, "helping", agent=1, partner="random", max_steps=9, autoreset="disabled", threads=2) for _ in range(2)]
    [env.reset(seed=1) for env in envs]
    stay = np.array([True, False, True, False])
    random = np.random.default_rng(0)
    for step in range(9):
        actions = random.integers(14, size=4)
        found, wanted = (env.step(actions) for env in envs)
        for k in (0, 1, 3):
            assert np.array_equal(found[k][stay], wanted[k][stay])
        assert np.array_equal(found[4]["partner_action"][stay], wanted[4]["partner_action"][stay])
        if step in (2, 5):
            envs[0].reset(options={"reset_mask": ~stay})
    assert found[3].tolist() == [True, False, True, False], "each world has a clock of its own"
    assert wanted[3].all()


def test_the_last_step_of_an_episode_tells_both():
    """`same_step`: infos are those of the new episode, and `final_info` has those of the ended one."""
    place = phase.sample_scene("independent", seed=1).to_dict()
    vector = PhaseVectorEnv(2, place, agent=0, partner="still", max_steps=2, autoreset="same_step")
    _, begun = vector.reset(seed=1)
    vector.step(np.array([2, 2]))
    _, _, _, truncated, infos = vector.step(np.array([2, 2]))
    assert truncated.all()
    assert same({name: infos[name] for name in begun}, begun)
    assert "partner_action" not in infos and "partner_action" in infos["final_info"]


def test_observations_are_kept():
    """As in Gymnasium, what was returned does not change, unless one asks for it."""
    vector = PhaseVectorEnv(2, "chasing", agent=0, partner="still")
    first, _ = vector.reset(seed=1)
    kept = first.copy()
    second, rewards, terminated, truncated, infos = vector.step(np.full(2, 2))
    copies = [array.copy() for array in (second, rewards, terminated, truncated, infos["goal_holds"])]
    vector.step(np.full(2, 3))
    assert np.array_equal(first, kept) and not np.array_equal(first, second)
    assert same(tuple(copies), (second, rewards, terminated, truncated, infos["goal_holds"]))
    faster = PhaseVectorEnv(2, "chasing", agent=0, partner="still", copy=False)
    first, _ = faster.reset(seed=1)
    faster.step(np.full(2, 2))
    assert np.array_equal(first, second)


def test_a_pool_has_few_scenes():
    vector = PhaseVectorEnv(16, pool=3, max_steps=1)
    vector.reset(seed=1)
    scenes = set()
    for _ in range(8):
        vector.step(np.full(32, 10))
        scenes |= {vector.scene(world).to_json() for world in range(16)}
    assert len(scenes) == 3
    vector.reset(seed=2)
    assert not scenes & {vector.scene(world).to_json() for world in range(16)}


def test_options_are_taken_or_refused():
    vector = PhaseVectorEnv(2, "helping", agent=0, partner="still")
    env = PhaseEnv("helping", partner="still")
    for one in (vector, env):
        for wrong in ({"scenes": "chasing"}, {"seed": 1}, {1: 2}, [1], "scene"):
            with pytest.raises(phase.PhaseError, match="options"):
                one.reset(seed=1, options=wrong)
    with pytest.raises(phase.PhaseError, match="options"):
        env.reset(options={"reset_mask": np.ones(2, bool)})
    for wrong in ([], [1], [1, 2, 3], [1, -1], [[1, 2], [3, 4]], {"a": 1}, 2**64 - 1):
        with pytest.raises(phase.PhaseError, match="seed"):
            vector.reset(seed=wrong)
    parallel = PhaseParallelEnv("helping")
    for wrong in ({"reset_mask": 1}, {"options": 2}, {"options": 1, "scene": "chasing"}):
        with pytest.raises(phase.PhaseError, match="options may have scene"):
            parallel.reset(options=wrong)
    # What PettingZoo's test of conformance passes.
    parallel.reset(options={"options": 1})
    _, _ = parallel.reset(seed=1, options={"scene": "chasing"})
    assert parallel.scene.kind == "chasing"
    with pytest.raises(phase.PhaseError, match="options"):
        parallel.reset(options=7)
    for wrong in ({"agent_0": 1, "agent_1": 1, "agent_2": 1}, [1, 1], None, {0: 1, 1: 1}):
        with pytest.raises(phase.PhaseError):
            parallel.step(wrong)


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
