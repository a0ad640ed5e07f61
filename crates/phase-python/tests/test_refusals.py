"""What is invalid raises PhaseError, whatever it is; numpy's numbers are numbers, and True is none."""

import json
import os
import threading

import numpy as np
import pytest
from conftest import QUICK

import phase_events as phase
from phase_events import _native
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.events import save_events
from phase_events.vector import PhaseVectorEnv

# What is no whole number from 0 to 13, 2000 or 2**64 - 1, for any argument that wants one.
NO_NUMBERS = (-1, 2**70, True, np.True_, 1.0, np.float32(1), float("nan"), "1", b"1", None, [1], (), {}, np.ones(2, dtype=int), object())


def no_numbers(allowed=()):
    return [wrong for wrong in NO_NUMBERS if not any(wrong is one for one in allowed)]


@pytest.fixture
def running(scene):
    env = PhaseEnv(scene, partner="still")
    env.reset(seed=1)
    vector = PhaseVectorEnv(2, scene, agent=0, partner="still")
    vector.reset(seed=1)
    return env, vector


def test_no_numbers(scene, event, running):
    env, vector = running
    observation, _ = env.reset(seed=1)
    mind = phase.Mind(scene, 0, 1, QUICK)
    none = (None,)
    refusals = {
        "seed of a scene": (lambda wrong: phase.sample_scene(seed=wrong), ()),
        "seed of an event": (lambda wrong: phase.simulate(scene, wrong), ()),
        "max_steps of an event": (lambda wrong: phase.simulate(scene, max_steps=wrong), ()),
        "seed of a mind": (lambda wrong: phase.Mind(scene, 0, wrong), ()),
        "agent of a mind": (lambda wrong: phase.Mind(scene, wrong), ()),
        "action of a mind": (lambda wrong: mind.decide(observation, wrong), none),
        "agent of a replay": (lambda wrong: phase.ReplayPolicy(event, wrong), ()),
        "actions of a replay": (lambda wrong: phase.ReplayPolicy([wrong]), ()),
        "seed of a policy": (lambda wrong: phase.RandomPolicy(wrong), ()),
        "row": (lambda wrong: event.picture(wrong), (NO_NUMBERS[0],)),
        "side": (lambda wrong: event.picture(side=wrong), ()),
        "side of a video": (lambda wrong: event.save_video("/nowhere/x.mp4", side=wrong), ()),
        "steps of an inference": (lambda wrong: phase.infer(event, steps=wrong), none),
        "seed of an inference": (lambda wrong: phase.infer(event, seed=wrong), ()),
        "watched": (lambda wrong: phase.forecast(event, method="still", watched=wrong), ()),
        "steps of a forecast": (lambda wrong: phase.forecast(event, method="still", steps=wrong), ()),
        "seed of an observer": (lambda wrong: phase.Observer(scene, event.trajectory[0], seed=wrong), ()),
        "decisions": (lambda wrong: phase.Observer(scene, event.trajectory[0], decisions=wrong), none),
        "events": (lambda wrong: phase.generate("demo", wrong, "/nowhere/x"), none),
        "seed of a dataset": (lambda wrong: phase.generate("demo", 1, "/nowhere/x", seed=wrong), none),
        "jobs": (lambda wrong: phase.generate("demo", 1, "/nowhere/x", jobs=wrong), none),
        "shard": (lambda wrong: phase.generate("demo", 1, "/nowhere/x", shard=wrong), none),
        "part of a shard": (lambda wrong: phase.generate("demo", 1, "/nowhere/x", shard=(wrong, 2)), ()),
        "seed of an evaluation": (lambda wrong: phase.evaluate("chance", [event], seed=wrong), ()),
        "agent of an environment": (lambda wrong: PhaseEnv(scene, agent=wrong), ()),
        "max_steps of an environment": (lambda wrong: PhaseEnv(scene, max_steps=wrong), ()),
        "side of an environment": (lambda wrong: PhaseEnv(scene, side=wrong), ()),
        "seed of a reset": (lambda wrong: env.reset(seed=wrong), none),
        "action": (lambda wrong: env.step(wrong), ()),
        "worlds": (lambda wrong: PhaseVectorEnv(wrong), ()),
        "agent of worlds": (lambda wrong: PhaseVectorEnv(2, agent=wrong), none),
        "pool": (lambda wrong: PhaseVectorEnv(2, pool=wrong), none),
        "threads": (lambda wrong: PhaseVectorEnv(2, threads=wrong), none),
        "max_steps of worlds": (lambda wrong: PhaseVectorEnv(2, max_steps=wrong), ()),
        "side of worlds": (lambda wrong: PhaseVectorEnv(2, side=wrong), ()),
        "seed of worlds": (lambda wrong: vector.reset(seed=wrong), none),
        "seeds of worlds": (lambda wrong: vector.reset(seed=[1, wrong]), none),
        "world": (lambda wrong: vector.scene(wrong), ()),
    }
    for what, (use, allowed) in refusals.items():
        for wrong in no_numbers(allowed):
            # A pair of numbers is two seeds.
            if what == "seed of worlds" and isinstance(wrong, np.ndarray):
                continue
            with pytest.raises(phase.PhaseError):
                use(wrong)
                pytest.fail(f"{what} {wrong!r} was taken")


@pytest.mark.parametrize("number", [np.int8(3), np.uint64(3), np.array(3)])
def test_numbers_of_numpy_are_numbers(number, scene, event):
    assert phase.sample_scene(seed=number).to_json() == phase.sample_scene(seed=3).to_json()
    short = phase.simulate(scene, number, max_steps=number, parameters={"simulations": number, "particles": number})
    assert short.to_json() == phase.simulate(scene, 3, max_steps=3, parameters={"simulations": 3, "particles": 3}).to_json()
    env = PhaseEnv(scene, partner="still", max_steps=number)
    env.reset(seed=number)
    env.step(number)
    assert phase.forecast(event, method="still", watched=number, steps=number)["forecast"].shape == (3, 3, 2)
    assert phase.infer(event, method="chance", steps=number, seed=number)["relation"]
    vector = PhaseVectorEnv(number, scene, agent=None, pool=number, threads=number)
    vector.reset(seed=number)
    assert vector.num_envs == 6


def test_limits_are_said(scene, event):
    for use, sentence in (
        (lambda: PhaseVectorEnv(4, threads=3000), "threads is a whole number from 1 to 1024, not 3000"),
        (lambda: PhaseVectorEnv(10**9), "worlds is a whole number from 1 to 65536, not 1000000000"),
        (lambda: PhaseVectorEnv(4, pool=10**9), "pool is"),
        (lambda: phase.generate("demo", 1, "/nowhere/x", jobs=3000), "jobs is a whole number from 1 to 1024"),
        (lambda: phase.forecast(event, steps=10**6), "steps is a whole number from 1 to 10000"),
        (lambda: _native.Worlds([scene], "world", False, 3000), "`threads` must be 1 to 1024"),
        (lambda: phase.Observer(scene, event.trajectory[0], decisions=10**9), "decisions is"),
    ):
        with pytest.raises(phase.PhaseError, match=sentence):
            use()


def test_what_is_no_text_scene_or_event(scene, event, tmp_path):
    wrongs = (7, 0.5, True, b"x", ["x"], {"x": {1, 2}}, object(), "\udcff", "")
    uses = (
        lambda wrong: phase.scene(wrong),
        lambda wrong: phase.sample_scene(wrong),
        lambda wrong: phase.sample_scene("helping", variant=wrong),
        lambda wrong: phase.sample_scene(preset=wrong),
        lambda wrong: phase.simulate(scene, engine=wrong),
        lambda wrong: phase.simulate(scene, id=wrong, max_steps=1, parameters=QUICK),
        lambda wrong: phase.simulate(scene, parameters=wrong),
        lambda wrong: phase.Mind(scene, parameters=wrong),
        lambda wrong: phase.Mind(wrong),
        lambda wrong: phase.Observer(wrong, event.trajectory[0]),
        lambda wrong: phase.Observer(scene, wrong),
        lambda wrong: phase.infer(wrong),
        lambda wrong: phase.infer(event, method=wrong),
        lambda wrong: phase.forecast(wrong),
        lambda wrong: phase.forecast(event, method=wrong),
        lambda wrong: phase.evaluate(wrong, [event]),
        lambda wrong: phase.evaluate({event.id: wrong}, [event]),
        lambda wrong: phase.evaluate("chance", [wrong]),
        lambda wrong: phase.evaluate("chance", [event], task=wrong),
        lambda wrong: phase.evaluate("chance", [event], split=wrong),
        lambda wrong: phase.generate(wrong, 1, tmp_path / "x"),
        lambda wrong: phase.generate("demo", 1, tmp_path / "x", options=[wrong]),
        lambda wrong: phase.run(wrong, wrong),
        lambda wrong: phase.events.tensors([wrong]),
        lambda wrong: save_events([wrong], tmp_path / "x.json"),
        lambda wrong: PhaseEnv(wrong),
        lambda wrong: PhaseEnv(scene, partner=wrong),
        lambda wrong: PhaseEnv(scene, observation=wrong),
        lambda wrong: PhaseEnv(scene, engine=wrong),
        lambda wrong: PhaseEnv(scene, render_mode=wrong),
        lambda wrong: PhaseVectorEnv(2, scene, autoreset=wrong),
        lambda wrong: PhaseVectorEnv(2, scene, render_mode=wrong),
        lambda wrong: PhaseParallelEnv(scene).reset(options={"scene": wrong}),
        lambda wrong: phase.split_observation(wrong),
    )
    for number, use in enumerate(uses):
        for wrong in wrongs:
            with pytest.raises(phase.PhaseError):
                use(wrong)
                pytest.fail(f"use {number} took {wrong!r}")


def test_names_that_are_misspelt(scene):
    """The sentence has the names there are."""
    kinds = "kind must be one of helping, hindering, chasing, competing, collaborating, independent, not 'helpin'"
    for use, sentence in (
        (lambda: PhaseEnv("helpin"), kinds),
        (lambda: phase.sample_scene("helpin"), kinds.replace("'", '"')),
        (lambda: phase.sample_scene("chasing", variant="fech"), "variant must be one of"),
        (lambda: PhaseEnv(scene, engine="rapier"), "engine must be one of world, forward, original, not 'rapier'"),
        (lambda: PhaseEnv(scene, partner="heuristics"), "partner must be one of phase, heuristic, random, still, or a policy"),
        (lambda: PhaseEnv(scene, observation="all"), "observation must be one of view, state, image, state_image"),
        (lambda: PhaseVectorEnv(2, scene, autoreset="never"), "autoreset must be one of next_step, same_step, disabled"),
    ):
        with pytest.raises(phase.PhaseError, match=sentence):
            use()


def test_a_mind_refuses_parameters_when_it_is_made():
    """Without a scene, too, and before an environment begins."""
    for wrong, sentence in (
        ({"simulation": 5}, "simulation"),
        ({"simulations": 0}, "simulations"),
        ({"kind": "published"}, "kind phase"),
        ({"kind": "phas"}, "kind"),
        ([], "parameters of minds must be an object"),
    ):
        with pytest.raises(phase.PhaseError, match=sentence):
            phase.Mind(parameters=wrong)
    assert phase.Mind(parameters={"simulations": 5}) is not None


def test_what_is_no_path(event, tmp_path):
    for wrong in (7, None, True, 0.5, ["x"], "", "a\0b", tmp_path, tmp_path / "no" / "file"):
        for use in (event.save, event.save_video, lambda path: save_events([event], path), lambda path: phase.load_events(path)):
            if wrong is tmp_path and use not in (event.save, event.save_video):
                continue
            with pytest.raises(phase.PhaseError, match="a path must not be empty" if wrong == "" else None):
                use(wrong)
                pytest.fail(f"{wrong!r} was taken")


def test_paths_that_are_no_text(event, tmp_path):
    """Names of files are bytes."""
    if os.name != "posix":
        pytest.skip("paths are text here")
    for path in (os.path.join(os.fsencode(tmp_path), b"\xff.json"), os.fsdecode(os.path.join(os.fsencode(tmp_path), b"\xfe.json"))):
        event.save(path)
        assert phase.load_events(path)[0].id == event.id
        assert phase.evaluate("chance", path)["method"] == "chance"


def test_calls_in_the_wrong_order():
    vector = PhaseVectorEnv(1, "helping", render_mode="rgb_array")
    for use in (vector.render, vector.state, lambda: vector.scene(0), lambda: vector.step(np.zeros(2, dtype=int))):
        with pytest.raises(phase.PhaseError, match="reset"):
            use()
    env = PhaseEnv("helping", partner="still", render_mode="rgb_array")
    for use in (env.render, lambda: env.step(0)):
        with pytest.raises(phase.PhaseError, match="reset"):
            use()


def test_arrays_are_read_and_written_in_any_order(scene):
    scenes = [phase.sample_scene("helping", seed=seed) for seed in range(3)]
    worlds = _native.Worlds(scenes, "world", False, 1)
    shapes = ((3, 2, phase.OBSERVATION_SIZE), np.float32), ((3, 2), np.float64), ((3, 2), bool)
    rows, columns = ([np.zeros(shape, kind, order=order) for shape, kind in shapes] for order in "CF")
    other = _native.Worlds(scenes, "world", False, 1)
    worlds.step(np.array([[1, 2], [3, 4], [5, 6]]), *rows)
    other.step(np.asfortranarray([[1, 2], [3, 4], [5, 6]]), *columns)
    for row, column in zip(rows, columns, strict=True):
        assert np.array_equal(row, column) and row.any() == column.any()
    skipped = np.zeros((6, 2, phase.OBSERVATION_SIZE), np.float32)[::2]
    worlds.observe(skipped, np.zeros((3, 2), bool))
    assert np.array_equal(skipped, rows[0])
    # A mind reads a column of a matrix, and a matrix that is transposed.
    minds = [[phase.Mind(one, 0, 1, QUICK).native for one in scenes] for _ in range(2)]
    seen = np.ascontiguousarray(rows[0][:, 0])
    assert np.array_equal(_native.decide_all(minds[0], seen, 1), _native.decide_all(minds[1], np.asfortranarray(seen), 1))
    fixed = np.zeros((3, 2, phase.OBSERVATION_SIZE), np.float32)
    fixed.flags.writeable = False
    for wrong in (fixed, rows[0][:2]):
        with pytest.raises(phase.PhaseError, match="observations"):
            worlds.observe(wrong, np.zeros((3, 2), bool))


def test_observers_read_rows_in_any_order(scene, event):
    row = event.trajectory[0]
    plain, fortran = phase.Observer(scene, row), phase.Observer(scene, np.asfortranarray(row))
    assert plain.push(event.trajectory[1]) == fortran.push(np.asfortranarray(event.trajectory[1]))


def test_worlds_in_two_threads(scene):
    """Worlds that are being stepped refuse, or wait; they do neither panic nor mix steps."""
    vector = PhaseVectorEnv(64, scene, threads=2)
    vector.reset(seed=1)
    wrong = []

    def step():
        for _ in range(20):
            try:
                vector.step(np.zeros(128, dtype=np.int64))
            except phase.PhaseError:
                pass
            except BaseException as error:
                wrong.append(error)

    threads = [threading.Thread(target=step) for _ in range(3)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert not wrong


def test_a_policy_of_ones_own_is_checked(scene):
    """What a partner answers is checked as what a learner does, not rounded."""
    for wrong in (2.7, True, 14, None):
        env = PhaseEnv(scene, partner=lambda observation, wrong=wrong: wrong)
        env.reset(seed=1)
        vector = PhaseVectorEnv(2, scene, agent=0, partner=lambda observation, wrong=wrong: wrong)
        vector.reset(seed=1)
        for use in (lambda env=env: env.step(0), lambda vector=vector: vector.step(np.zeros(2, dtype=int))):
            with pytest.raises(phase.PhaseError, match="action"):
                use()


def test_one_native_event_is_read_from_a_document_of_one(scene):
    """The sentence says how many events there are."""
    event = phase.simulate(scene, seed=1, max_steps=3, parameters=QUICK)
    document = json.loads(event.to_json())
    document["events"].append({**document["events"][0], "id": "another"})
    with pytest.raises(phase.PhaseError, match="one event is expected, not 2"):
        type(event.native)(json.dumps(document))
