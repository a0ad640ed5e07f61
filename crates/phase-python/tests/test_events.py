"""Events, data, minds and inference."""

import json
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from conftest import QUICK

import phase_events as phase
from phase_events.events import save_events


def test_an_event_is_what_its_file_says(event, tmp_path):
    document = json.loads(event.to_json())
    assert document["format"] == "phase-events/1"
    event.save(tmp_path / "event.json")
    (read,) = phase.load_events(tmp_path / "event.json")
    assert read.to_json() == event.to_json()
    assert (read.id, read.kind, read.relation) == (event.id, "helping", "friendly")
    assert event.trajectory.shape == (event.steps + 1, 3, 5)
    # Every row after the first is the mean over the substeps of its step.
    means = event.substeps.reshape(event.steps, 5, 3, 6).mean(axis=1)
    assert np.allclose(event.trajectory[1:, :, :2], means[:, :, :2], atol=1e-4)
    assert len(event.thoughts) == event.steps
    assert event.attitudes in ([0, 1], [1, 0])


def test_a_seed_decides_everything(scene, event):
    again = phase.simulate(scene, seed=7, max_steps=45, parameters=QUICK)
    assert again.to_json() == event.to_json()
    other = phase.simulate(scene, seed=8, max_steps=45, parameters=QUICK)
    assert not np.array_equal(other.substeps[-1], event.substeps[-1])


def test_scenes_are_sampled():
    for kind in ("helping", "hindering", "chasing", "competing", "collaborating", "independent"):
        scene = phase.sample_scene(kind, seed=2)
        assert scene.kind == kind
        assert scene.to_json() == phase.sample_scene(kind, seed=2).to_json()
    assert phase.sample_scene(preset="phase-500", seed=1).entity_count == 4
    assert phase.sample_scene(preset="phase-pairs", seed=1).entity_count == 4
    assert phase.sample_scene("hindering", variant="take", seed=1).kind == "hindering"
    for wrong in ({"kind": "loving"}, {"kind": "helping", "variant": "take"}, {"preset": "none"}, {"seed": 0.5}):
        with pytest.raises(phase.PhaseError):
            phase.sample_scene(**wrong)


def test_minds_explain_themselves(scene):
    mind = phase.Mind(scene, 0, 3, QUICK)
    assert mind.belief is None and mind.thought is None
    from phase_events.env import PhaseParallelEnv

    observations, _ = PhaseParallelEnv(scene).reset()
    action = mind.decide(observations["agent_0"])
    thought = mind.thought
    assert mind.belief.shape == (10, 3, 6)
    # The agent knows where it is itself.
    assert np.ptp(mind.belief[:, 0, :2], axis=0).max() == 0
    assert thought["subgoal"] in [one["subgoal"] for one in thought["subgoals"]]
    assert thought["subgoal"].split("(")[0] in ("Close", "Attach", "On", "Touch")
    if thought["actions"]:
        assert mind.visits.sum() == sum(one["visits"] for one in thought["actions"])
        assert 0 <= action < 14


def test_minds_refuse_rubbish(scene):
    from phase_events.env import PhaseParallelEnv

    observations, _ = PhaseParallelEnv(scene).reset()
    own, other = observations["agent_0"], observations["agent_1"]
    mind = phase.Mind(scene, 0, 1, QUICK)
    for wrong in (own[:-1], np.full_like(own, np.nan), other, np.zeros_like(own), own[None]):
        with pytest.raises(phase.PhaseError):
            mind.decide(wrong)
    with pytest.raises(phase.PhaseError):
        mind.decide(own, action=99)
    for wrong in ({"simulations": 0}, {"particles": 0}, {"particles": "many"}, {"telepathy": 1}, {"kind": "published"}):
        with pytest.raises(phase.PhaseError):
            phase.Mind(scene, 0, 1, wrong)
    with pytest.raises(phase.PhaseError):
        phase.Mind(scene, 2, 1)
    with pytest.raises(phase.PhaseError):
        phase.Mind().decide(own)


def test_inference_is_the_command_lines(event, tmp_path):
    answer = phase.infer(event, seed=0)
    for goals in answer["goals"]:
        assert sum(one["p"] for one in goals) == pytest.approx(1, abs=1e-6)
        assert goals == sorted(goals, key=lambda one: -one["p"])
    assert sum(answer["relation"].values()) == pytest.approx(1)
    assert set(answer["roles"]) == {"helps", "hinders"}
    assert sum(answer["strengths"][0].values()) == pytest.approx(1)
    event.save(tmp_path / "event.json")
    phase.run("eval", "goals", "--method", "simple", "--events", tmp_path / "event.json", "--out", tmp_path / "out", "--quiet")
    found = json.loads((tmp_path / "out" / "results.json").read_text())["events"][0]
    # The command line derives the seed of an event from its id, so likelihoods differ by the noise of the search.
    assert found["goals"][0][0]["goal"] == answer["goals"][0][0]["goal"]


def test_an_observer_ends_where_inference_does(event):
    observer = phase.Observer(event.scene, event.trajectory[0], seed=0)
    for row in event.trajectory[1:12]:
        pushed = observer.push(row)
        assert sum(pushed["relation"].values()) == pytest.approx(1)
    at_once = phase.infer(event, seed=0, steps=11)
    assert observer.inference()["relation"] == at_once["relation"]
    with pytest.raises(phase.PhaseError):
        observer.push(event.trajectory[12][:2])
    with pytest.raises(phase.PhaseError):
        observer.push(np.full((3, 5), np.nan))


def test_forecasts(event):
    found = phase.forecast(event, watched=20, steps=10)
    assert found["forecast"].shape == (3, 10, 2)
    assert found["futures"].shape == (20, 3, 10, 2)
    still = phase.forecast(event, method="still", watched=20, steps=10)
    assert np.allclose(still["forecast"], event.trajectory[20, :, None, :2])
    with pytest.raises(phase.PhaseError):
        phase.forecast(event, watched=1000)
    with pytest.raises(phase.PhaseError):
        phase.forecast(event, method="oracle")


def test_scores_are_the_benchmarks(event, tmp_path):
    right = {
        "goals": [[{"goal": goal, "p": 1.0}] for goal in event.goals],
        "relation": {"friendly": 1.0, "adversarial": 0.0, "neutral": 0.0},
    }
    scores = phase.evaluate({event.id: right}, [event])
    assert scores["goal"]["top1"] == 1.0
    assert scores["relation"]["accuracy"] == 1.0
    future = {"forecast": event.trajectory[21:41, :, :2].transpose(1, 0, 2)}
    scores = phase.evaluate({event.id: future}, [event], task="trajectories")
    assert scores["ade"]["all"] == pytest.approx(0, abs=1e-6)
    assert phase.evaluate("chance", [event])["method"] == "chance"
    with pytest.raises(phase.PhaseError):
        phase.evaluate({}, [event])
    with pytest.raises(phase.PhaseError):
        phase.evaluate({event.id: {"goals": [[], []]}}, [event])


@pytest.mark.parametrize("name", ["org/model", "../../x", "events", "results", "a b", "-x", "Ünï", "."])
def test_the_name_of_a_method_names_no_file(name, event, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    right = {"goals": [[{"goal": goal, "p": np.float32(1)}] for goal in event.goals]}
    right["relation"] = {"friendly": np.float64(0.5), "adversarial": np.array(0.25), "neutral": 0.25}
    scores = phase.evaluate({event.id: right}, [event], name=name, out=tmp_path / "out" / "kept")
    assert (scores["method"], scores["goal"]["top1"]) == (name, 1.0)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out"]
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["kept"]


def test_answers_are_not_changed(event):
    answer = {"goals": [[], []], "relation": {"friendly": np.float32(1), "adversarial": 0, "neutral": 0}}
    phase.evaluate({event.id: answer}, [event])
    assert set(answer) == {"goals", "relation"}


THREADS = """
import os, sys, tempfile, threading
import phase_events as phase

def make(events):
    options = ("--particles", "4", "--simulations", "20", "--max-steps", "10")
    phase.generate("demo", events, tempfile.mkdtemp() + "/x", video=False, jobs=1, options=options)

threads = [threading.Thread(target=make, args=(count,)) for count in (1, 6, 3)]
[thread.start() for thread in threads]
print("while they run", flush=True)
[thread.join() for thread in threads]
print("afterwards", flush=True)
phase.run("stats", "--help")
"""


def test_silence_is_that_of_one_command():
    """Commands that run at once, some silently, do not take stdout away from each other or from Python."""
    done = subprocess.run([sys.executable, "-c", THREADS], capture_output=True, text=True, check=True, timeout=300)
    first, second, *help = done.stdout.splitlines()
    assert (first, second) == ("while they run", "afterwards")
    assert help and done.stderr == ""


def test_commands_print_unless_they_are_silent(tmp_path, capfd):
    options = ["--simulations", "10", "--particles", "5", "--max-steps", "4"]
    phase.generate("demo", 1, tmp_path / "a", video=False, options=options)
    assert capfd.readouterr() == ("", "")
    phase.generate("demo", 1, tmp_path / "b", video=False, options=options, quiet=False)
    assert "manifest" in capfd.readouterr().out


def test_datasets_are_generated_and_read(tmp_path):
    options = ["--simulations", "10", "--particles", "5", "--max-steps", "4"]
    out = phase.generate("demo", 3, tmp_path / "demo", video=False, options=options)
    events = phase.load_events(out)
    assert len(events) == 3
    tensors = events.tensors()
    assert tensors["trajectory"].shape == (3, 5, 4, 5)
    assert tensors["mask"].all()
    assert (tensors["actions"] >= 0).all()
    for k in (1, 2):
        phase.generate("demo", 3, tmp_path / f"part{k}", video=False, shard=(k, 2), options=options)
    phase.run("merge", tmp_path / "part1", tmp_path / "part2", "--out", tmp_path / "merged", "--quiet")
    assert (tmp_path / "merged/manifest.json").read_bytes() == (out / "manifest.json").read_bytes()
    with pytest.raises(phase.PhaseError):
        phase.generate("none", 1, tmp_path / "x")
    with pytest.raises(phase.PhaseError):
        phase.load_events(tmp_path / "nowhere")
    with pytest.raises(IndexError):
        events[3]


def test_tables(event):
    pandas = pytest.importorskip("pandas")
    table = phase.events.to_pandas([event])
    assert isinstance(table, pandas.DataFrame)
    assert len(table) == (event.steps + 1) * 3
    first = table[(table.step == 0) & (table.entity == "agent 1")].iloc[0]
    assert first.action == phase.ACTIONS[event.actions[0, 1]]


def test_pictures_and_videos(event, tmp_path):
    picture = event.picture(0, side=100)
    assert picture.shape == (100, 100, 3) and picture.dtype == np.uint8
    assert (picture != event.picture(side=100)).any()
    event.save_video(tmp_path / "event.mp4", side=100)
    assert (tmp_path / "event.mp4").read_bytes()[4:8] == b"ftyp"
    with pytest.raises(phase.PhaseError):
        event.picture(1000)
    with pytest.raises(phase.PhaseError):
        event.save_video(tmp_path / "no" / "event.mp4")


def test_what_fails_leaves_the_old_file(event, tmp_path):
    """A file is written whole or not at all, and nothing else remains."""
    video, file, many = (tmp_path / name for name in ("event.mp4", "event.json", "events.json"))
    event.save_video(video, side=64)
    event.save(file)
    save_events([event], many)
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    with pytest.raises(phase.PhaseError, match="even"):
        event.save_video(video, side=101)
    with pytest.raises(phase.PhaseError):
        event.save_video(video, side=3)
    with pytest.raises(phase.PhaseError):
        save_events([event, event], many)
    with pytest.raises(phase.PhaseError):
        save_events([], many)
    # No file of more than a few bytes can be written.
    resource = pytest.importorskip("resource")
    limits, handler = resource.getrlimit(resource.RLIMIT_FSIZE), signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
    try:
        for write in (lambda: event.save_video(video), lambda: event.save(file), lambda: save_events([event], many)):
            with pytest.raises(phase.PhaseError, match="event"):
                write()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_ids_must_differ(event, tmp_path):
    with pytest.raises(phase.PhaseError, match="same id"):
        save_events([event, event], tmp_path / "events.json")
