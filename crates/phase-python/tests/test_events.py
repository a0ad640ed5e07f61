"""Events, data, minds and inference."""

import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import warnings

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
    assert event.attitudes.tolist() in ([0, 1], [1, 0])


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
    assert at_once["watched_steps"] == 11
    assert observer.inference()["relation"] == at_once["relation"]
    with pytest.raises(phase.PhaseError):
        observer.push(event.trajectory[12][:2])
    with pytest.raises(phase.PhaseError, match="not finite"):
        observer.push(np.full((3, 5), np.nan))
    with pytest.raises(phase.PhaseError, match=r"row\[0\] must lie inside the arena"):
        observer.push(np.zeros((3, 5)))
    spinning = np.array(event.trajectory[12])
    spinning[0, 4] = 1e30
    with pytest.raises(phase.PhaseError, match="an angle beyond 100000 rad"):
        observer.push(spinning)


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


def test_comparisons(event):
    other = phase.simulate(phase.sample_scene("chasing", seed=1), seed=2, max_steps=45, parameters=QUICK, id="other")
    events = [event, other]
    found = phase.evaluate("cue", events, compare=["chance", "intent-network"])
    names = [row["method"] for row in found["comparison"]]
    assert names == ["cue", "chance", "intent-network"] and found["comparison"][0]["difference"] is None
    alone = {name: phase.evaluate(name, events) for name in names}
    for row in found["comparison"]:
        assert row["goal"]["value"] == alone[row["method"]]["goal"]["top1"]
        assert [row["relation"]["low"], row["relation"]["high"]] == alone[row["method"]]["intervals"]["relation"]["accuracy"]
    for row in found["comparison"][1:]:
        wanted = alone["cue"]["goal"]["top1"] - alone[row["method"]]["goal"]["top1"]
        assert row["difference"]["goal"]["value"] == pytest.approx(wanted)
    # The same from answers, and from documents of earlier evaluations.
    answers = {event.id: phase.infer(event, method="cue") for event in events}
    again = phase.evaluate(answers, events, name="mine", compare={"a": alone["chance"], "b": answers})
    assert again["comparison"][1]["difference"] == found["comparison"][1]["difference"]
    assert again["comparison"][2]["difference"]["goal"] == {"value": 0, "low": 0, "high": 0}
    moved = phase.evaluate("still", events, task="trajectories", compare=["constant-velocity"])
    assert set(moved["comparison"][1]["difference"]) == {"ade", "fde"}
    with pytest.raises(phase.PhaseError, match="same events"):
        phase.evaluate("cue", [event], compare={"chance": alone["chance"]})
    for wrong in ("chance", 7, ["oracle"], {"a": 7}, {"a": {event.id: 7}}, {"a": phase.evaluate("still", [event], task="trajectories")}):
        with pytest.raises(phase.PhaseError):
            phase.evaluate("cue", [event], compare=wrong)


def test_every_method_is_there_by_name(event):
    """All that methods() lists; networks are not listed without being there."""
    for method in phase.methods()["goals"]:
        if not method.startswith("simple"):
            assert phase.infer(event, method=method)["relation"]
    assert "simple" in phase.methods()["goals"] and "simple" in phase.methods()["trajectories"]
    for method in phase.methods()["trajectories"]:
        if not method.startswith("simple"):
            assert phase.forecast(event, method=method)["forecast"].shape == (3, 20, 2)


def test_errors_name_arguments(event, tmp_path):
    """The words of Python: no options of the command line, no files that the caller has not named."""
    right = phase.infer(event, method="chance")
    refusals = {
        "method must be one of simple, .* not 'oracle'": lambda: phase.infer(event, method="oracle"),
        "method must be one of .* not 'cue'": lambda: phase.forecast(event, method="cue"),
        "predictions must be one of simple, .* not 'oracle'": lambda: phase.evaluate("oracle", [event]),
        "split must be one of train, validation, test, not 'all'": lambda: phase.evaluate("chance", [event], split="all"),
        "split needs a dataset": lambda: phase.evaluate("chance", [event], split="test"),
        "predictions: has no answer to 1 of the 1 events of events.json: event; it has other": lambda: phase.evaluate(
            {"other": right}, [event]
        ),
        "predictions: event event: field `relation`": lambda: phase.evaluate({event.id: {"goals": [[], []]}}, [event]),
        "compare: event event: field `relation`": lambda: phase.evaluate("cue", [event], compare={"a": {event.id: {"goals": [[], []]}}}),
        "ratings are of relations": lambda: phase.evaluate("still", [event], task="trajectories", ratings=tmp_path / "x"),
        "preset: unknown preset": lambda: phase.generate("none", out=tmp_path / "x"),
        "compare is a list": lambda: phase.evaluate("chance", [event], compare="cue"),
    }
    for sentence, use in refusals.items():
        with pytest.raises(phase.PhaseError, match=sentence) as refused:
            use()
        assert "--" not in str(refused.value) and "predictions.json" not in str(refused.value), refused.value


def test_progress_is_shown_if_it_is_wanted(event, capfd):
    phase.evaluate("cue", [event])
    assert capfd.readouterr() == ("", "")
    phase.evaluate("cue", [event], quiet=False)
    shown = capfd.readouterr()
    assert "evaluating cue on 1 event" in shown.err and "cue" in shown.out


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


def test_arrays_are_what_the_file_says(event):
    """Members of the JSON, read by hand."""
    (document,) = json.loads(event.to_json())["events"]
    found = phase.events.arrays(event)
    assert found["radii"].tolist() == [np.float32(one["radius"]) for one in document["agents"] + document["objects"]]
    assert np.allclose(found["walls"], np.array(document["walls"]).reshape(-1, 2, 2), atol=1e-4)
    assert np.allclose(found["landmarks"], document["landmarks"], atol=1e-4)
    assert [phase.GOALS[k] for k in found["goals"]] == [one["goal"] for one in document["agents"]]
    assert phase.RELATIONS[found["relation"]] == document["relation"] and phase.KINDS[found["kind"]] == document["event"]
    assert found["attitudes"].tolist() == [one["alpha"] for one in document["agents"]]
    assert found["strength_levels"].tolist() == [one["strength_level"] for one in document["agents"]]
    rows = np.array(document["trajectory"]["agents"] + document["trajectory"]["objects"], dtype=np.float32)
    assert np.array_equal(found["trajectory"], rows.transpose(1, 0, 2))
    assert [phase.ACTIONS[k] for k in found["actions"][3]] == document["actions"][3]


def test_batches_of_arrays(event):
    short = phase.simulate(phase.sample_scene("chasing", seed=1), seed=2, max_steps=7, parameters=QUICK, id="short")
    batch = phase.events.tensors([event, short])
    assert batch["id"] == [event.id, "short"]
    for k, one in enumerate((event, short)):
        rows, entities, walls = batch["mask"][k], batch["entities"][k], batch["wall_mask"][k]
        assert np.array_equal(batch["trajectory"][k][rows][:, entities], one.trajectory)
        assert np.array_equal(batch["radii"][k][entities], one.observed.radii)
        assert np.array_equal(batch["walls"][k][walls], one.observed.walls)
        assert np.array_equal(batch["goals"][k], one.goal_indices)
        assert not batch["trajectory"][k][~rows].any() and not batch["radii"][k][~entities].any()
    assert (batch["actions"][1, short.steps :] == -1).all() and (batch["actions"][1, : short.steps] >= 0).all()
    seen = phase.events.tensors([event.observed, short.observed])
    assert batch.keys() - seen.keys() == {"goals", "relation", "kind", "attitudes", "strength_levels", "actions"}
    assert all(np.array_equal(seen[name], batch[name]) for name in seen)
    with pytest.raises(phase.PhaseError, match="labels"):
        phase.events.tensors([event, short.observed])


def test_goals_have_numbers():
    assert len(phase.GOALS) == 34
    for k, goal in enumerate(phase.GOALS):
        assert phase.goal_index(goal) == k
        assert phase.goal_index({**goal, "sign": -goal["sign"]}) == (k + 17) % 34
    assert phase.goal_index({"kind": "touch", "agent": 1, "other": 0, "sign": 1}) == 16
    for wrong in ({"kind": "touch", "agent": 0, "other": 0, "sign": 1}, {"kind": "fly"}, 7, None):
        with pytest.raises(phase.PhaseError, match="goal"):
            phase.goal_index(wrong)


def test_answers_from_arrays(event):
    shares = np.zeros((2, 34), dtype=np.float32)
    shares[[0, 1], event.goal_indices] = 0.75
    shares[:, 33] = 0.25
    relation = [0.5, 0.25, 0.25]
    found = phase.answer(shares, relation, [[1, 0], [0, 0]])
    assert [goals[0] for goals in found["goals"]] == [{"goal": goal, "p": 0.75} for goal in event.goals]
    assert found["relation"] == {"friendly": 0.5, "adversarial": 0.25, "neutral": 0.25}
    scores = phase.evaluate({event.id: found}, [event])
    assert scores["goal"]["top1"] == 1 and scores["relation"]["accuracy"] == (event.relation == "friendly")
    # 32-bit numbers that add up to a little more than 1.
    logits = np.random.default_rng(1).normal(size=(2, 34)).astype(np.float32)
    exponents = np.exp(logits)
    phase.evaluate({event.id: phase.answer(exponents / exponents.sum(1, keepdims=True) * np.float32(1.00001), relation)}, [event])
    for wrong in (shares[0], shares * 2, -shares, shares * np.nan, "x"):
        with pytest.raises(phase.PhaseError, match="goals"):
            phase.answer(wrong, relation)


def test_a_viewer_sees_no_labels(event, tmp_path):
    seen = event.observed
    labels = ("goals", "attitudes", "relation", "kind", "actions", "thoughts", "scene", "substeps", "strength_levels", "to_json", "goal_indices")
    assert not [name for name in labels if hasattr(seen, name)]
    assert (seen.id, seen.steps) == (event.id, event.steps)
    assert phase.infer(seen, steps=15) == phase.infer(event, steps=15)
    assert np.array_equal(phase.forecast(seen, method="still")["forecast"], phase.forecast(event, method="still")["forecast"])
    assert np.array_equal(seen.picture(3, side=64), event.picture(3, side=64))
    watching = phase.Observer(seen)
    assert watching.push(seen.trajectory[1]) == phase.Observer(event.scene, event.trajectory[0]).push(event.trajectory[1])
    # Motion of one's own, without any labels.
    levels = seen.size_levels.tolist()
    mine = phase.ObservedEvent(seen.layout, levels[:2], levels[2:], seen.trajectory, id="mine")
    assert phase.infer(mine, method="intent-network") == phase.infer(event, method="intent-network")
    mine.save_video(tmp_path / "mine.mp4", side=64)
    copied = pickle.loads(pickle.dumps(seen))
    assert np.array_equal(copied.trajectory, seen.trajectory) and np.array_equal(copied.walls, seen.walls)
    assert seen.prefix(4).trajectory.shape[0] == 5
    outside = seen.trajectory.copy()
    outside[2, 0, 0] = 40
    for layout, agents, objects, rows, rule in (
        ((22, None), levels[:2], levels[2:], seen.trajectory, "layout"),
        ((0, 4), levels[:2], levels[2:], seen.trajectory, "reflection"),
        ((0, None), [0], levels[2:], seen.trajectory, "agent_size_levels"),
        ((0, None), [0, 4], levels[2:], seen.trajectory, "size level"),
        ((0, None), levels[:2], [0, 0, 0], seen.trajectory, "objects"),
        ((0, None), levels[:2], levels[2:], seen.trajectory[0], "trajectory"),
        ((0, None), levels[:2], levels[2:], seen.trajectory[:, :2], "trajectory"),
        ((0, None), levels[:2], levels[2:], seen.trajectory[:0], "row"),
        ((0, None), levels[:2], levels[2:], outside, r"trajectory\[2, 0\]"),
        ((0, None), levels[:2], levels[2:], outside * np.nan, "finite"),
    ):
        with pytest.raises(phase.PhaseError, match=rule):
            phase.ObservedEvent(layout, agents, objects, rows)


def test_velocities_of_another_unit_are_warned_of(tmp_path):
    rows = np.zeros((21, 2, 5), dtype=np.float32)
    rows[:, 0, 0] = 8 + 0.5 * np.arange(21)  # u; half a unit a step is 6 u/s of physics, and 2 u/s of video
    rows[:, 0, 1], rows[:, 1, :2] = 14, (12, 5)
    rows[:, 0, 2] = 6
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        phase.ObservedEvent((0, None), [0, 0], [], rows)
    rows[:, 0, 2] = 2
    with pytest.warns(UserWarning, match=r"event mine: trajectory: bodies move 10.0 u in all, .* say 3.3 u"):
        mine = phase.ObservedEvent((0, None), [0, 0], [], rows, id="mine")
    assert np.array_equal(mine.trajectory, rows)
    body = [{"size_level": 0}] * 2
    of_agent = [rows[:, agent].tolist() for agent in (0, 1)]
    trajectory = {"columns": ["x", "y", "vx", "vy", "angle"], "agents": of_agent, "objects": []}
    one = {"id": "mine", "layout": {"base": 0, "flip": None}, "agents": body, "objects": []}
    one["trajectory"] = trajectory
    (tmp_path / "seen.json").write_text(json.dumps({"format": "phase-events/1", "events": [one]}))
    with pytest.warns(UserWarning, match="per second of physics"):
        phase.load_observed(tmp_path / "seen.json")


def test_files_without_labels(event, tmp_path):
    document = json.loads(event.to_json())
    (one,) = document["events"]
    # What a viewer sees, and nothing else.
    one = {name: one[name] for name in ("id", "layout", "agents", "objects", "trajectory")}
    one["agents"] = [{"size_level": agent["size_level"]} for agent in one["agents"]]
    file = tmp_path / "seen.json"
    file.write_text(json.dumps(dict(document, events=[one])))
    (read,) = phase.load_observed(file)
    assert np.array_equal(read.trajectory, event.trajectory) and read.layout == event.observed.layout
    event.save(tmp_path / "whole.json")
    assert np.array_equal(phase.load_observed(tmp_path / "whole.json")[0].walls, read.walls)
    with pytest.raises(phase.PhaseError, match="seen.json: event event: .*strength_level"):
        phase.load_events(file)
    for wrong in (tmp_path, tmp_path / "nowhere.json"):
        with pytest.raises(phase.PhaseError, match=str(wrong)):
            phase.load_observed(wrong)


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
    frames = event.frames(4, side=64)
    assert frames.shape == (4, 64, 64, 3)
    assert np.array_equal(frames[0], event.picture(0, side=64)) and np.array_equal(frames[-1], event.picture(side=64))
    assert np.array_equal(event.frames([0, -1], side=64), frames[[0, -1]])
    assert len(event.frames(side=64)) == event.steps + 1
    # A clip has the substeps: frame 5 t is the state after step t.
    clip = event.clip(side=64)
    assert len(clip) == 5 * event.steps + 1
    assert np.array_equal(event.clip(5, 12, side=64), clip[5:12])
    assert np.array_equal(clip[0], frames[0]) and (clip[5] != clip[4]).any()
    other = event.picture(0, side=64, palette="accessible")
    assert (other != frames[0]).any()
    for wrong in ({"rows": 0}, {"rows": [1000]}, {"rows": 1.5}, {"palette": "loud"}, {"side": 63}, {"rows": range(10_000), "side": 2000}):
        with pytest.raises(phase.PhaseError):
            event.frames(**wrong)
    with pytest.raises(phase.PhaseError, match="stop"):
        event.clip(5, 4)
    event.save_video(tmp_path / "event.mp4", side=100)
    assert (tmp_path / "event.mp4").read_bytes()[4:8] == b"ftyp"
    with pytest.raises(phase.PhaseError):
        event.picture(1000)
    with pytest.raises(phase.PhaseError):
        event.save_video(tmp_path / "no" / "event.mp4")


def test_a_video_is_read_as_it_was_drawn(event, tmp_path):
    """Layout, sizes, places and headings are those of the event, within a tenth of a unit and some degrees."""
    video = tmp_path / "event.mp4"
    event.save_video(video, side=400)
    seen = phase.track(video)
    assert (seen.layout, list(seen.size_levels)) == (event.observed.layout, list(event.observed.size_levels))
    truth = event.observed.trajectory
    rows = min(len(truth), len(seen.trajectory))
    assert abs(len(truth) - len(seen.trajectory)) <= 1
    off = np.linalg.norm(seen.trajectory[:rows, :, :2] - truth[:rows, :, :2], axis=-1)
    assert np.median(off) < 0.05 and np.quantile(off, 0.99) < 0.3, (np.median(off), off.max())
    turned = np.angle(np.exp(1j * (seen.trajectory[:rows, :2, 4] - truth[:rows, :2, 4])))
    assert np.quantile(np.abs(turned), 0.95) < np.radians(6)
    assert phase.infer(seen, method="intent-network") is not None
    with pytest.raises(phase.PhaseError, match="frame_rate"):
        phase.track(video, frame_rate=3)
    with pytest.raises(phase.PhaseError, match="uint8"):
        phase.track(np.zeros((3, 8, 8, 3)))
    with pytest.raises(phase.PhaseError):
        phase.track(np.zeros((30, 64, 64, 3), np.uint8))


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
