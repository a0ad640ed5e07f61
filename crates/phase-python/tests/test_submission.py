"""Submissions to the leaderboard, on events that stand for those of PHASE-500."""

import hashlib
import json
from pathlib import Path

import pytest

import phase_events as phase
from phase_events.events import save_events

ROOT = Path(__file__).parent.parent.parent.parent
WHO = {"by": "N. N.", "source": "https://example.org/mine"}


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    """A folder with a manifest like that of PHASE-500: a hundred test events, all of the same motion."""
    folder = tmp_path_factory.mktemp("dataset") / "d"
    phase.generate("demo", 1, folder, video=False, options=["--simulations", "10", "--particles", "5", "--max-steps", "24"])
    manifest = json.loads((folder / "manifest.json").read_text())
    (entry,) = manifest["events"]
    document = json.loads((folder / entry["event"]["path"]).read_text())
    entries = []
    for k in range(100):
        id = f"phase-500-{k:04}"
        document["events"][0]["id"] = id
        text = json.dumps(document)
        (folder / "events" / f"{id}.json").write_text(text)
        file = {"path": f"events/{id}.json", "bytes": len(text), "sha256": hashlib.sha256(text.encode()).hexdigest()}
        entries.append(dict(entry, id=id, split="test", event=file))
    manifest |= {"preset": "phase-500", "seed": 1, "events": entries}
    (folder / "manifest.json").write_text(json.dumps(manifest))
    return folder


def test_a_submission_is_scored_and_written(dataset, tmp_path):
    events = phase.load_events(dataset)
    right = {"goals": [[{"goal": goal, "p": 1.0}] for goal in events[0].goals]}
    right["relation"] = {name: float(name == events[0].relation) for name in phase.RELATIONS}
    right |= phase.forecast(events[0], method="still")
    del right["futures"]
    answers = {event.id: right for event in events}
    done = phase.submit(answers, dataset, name="mine", out=tmp_path, **WHO)
    goals, trajectories = done["scores"]
    assert (goals["top1"]["value"], goals["relation"]["value"], goals["set"]) == (1, 1, "generated")
    still = phase.evaluate("still", dataset, task="trajectories", split="test")
    assert trajectories["ade"]["value"] == pytest.approx(still["ade"]["all"])
    # These are not the events that the other scores are of.
    assert done["same_events"] is False
    written = sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file())
    assert sorted(str(Path(path).relative_to(tmp_path)) for path in done["files"]) == written
    assert written == [
        "data/leaderboard/generated/goals/mine.json",
        "data/leaderboard/generated/trajectories/mine.json",
        "data/leaderboard/methods.json",
        "data/leaderboard/scores.json",
        "docs/results/leaderboard.md",
    ]
    # What was there before is still there, and the file is the one that was scored.
    authors = json.loads((tmp_path / "data/leaderboard/methods.json").read_text())
    assert authors == json.loads((ROOT / "data/leaderboard/methods.json").read_text()) | {"mine": WHO}
    scores = json.loads((tmp_path / "data/leaderboard/scores.json").read_text())["scores"]
    before = json.loads((ROOT / "data/leaderboard/scores.json").read_text())["scores"]
    assert [score for score in scores if score["method"] != "mine"] == before
    digest = hashlib.sha256((tmp_path / "data/leaderboard/generated/goals/mine.json").read_bytes()).hexdigest()
    assert goals["predictions"] == digest and goals in scores
    page = (tmp_path / "docs/results/leaderboard.md").read_text()
    assert "| mine | 1.000 [1.000, 1.000] |" in page and "- mine: N. N., https://example.org/mine" in page
    # A second submission goes into the same folder, and a better one replaces the first.
    file = tmp_path / "again.json"
    wrong = dict(right, relation={"friendly": 0, "adversarial": 0, "neutral": 0} | {_other(events[0].relation): 1.0})
    file.write_text(json.dumps({"events": [{"id": id, "goals": wrong["goals"], "relation": wrong["relation"]} for id in answers]}))
    who = ["--method", "mine", "--by", "N. N.", "--source", "https://example.org"]
    phase.run("submit", file, "--events", dataset, *who, "--out", tmp_path)
    scores = json.loads((tmp_path / "data/leaderboard/scores.json").read_text())["scores"]
    mine = {score["task"]: score for score in scores if score["method"] == "mine"}
    assert mine["goals"]["relation"]["value"] == 0 and mine["trajectories"] == trajectories


def _other(relation):
    return next(name for name in phase.RELATIONS if name != relation)


def test_submissions_that_are_refused(dataset, event, tmp_path):
    events = phase.load_events(dataset)
    answer = phase.infer(events[0], method="chance")
    answers = {event.id: answer for event in events}
    few = dict(list(answers.items())[:97])
    event.save(tmp_path / "event.json")
    other = tmp_path / "demo"
    phase.generate("demo", 1, other, video=False, options=["--simulations", "10", "--particles", "5", "--max-steps", "4"])
    manifest = json.loads((dataset / "manifest.json").read_text())
    second = tmp_path / "second"
    second.mkdir()
    (second / "manifest.json").write_text(json.dumps(manifest | {"seed": 2}))
    half = tmp_path / "half.json"
    save_events(events[:50], half)
    which = r"the events of the leaderboard are 100 of phase-500-seed1, test events \(made by .*phase-500.*; 280 of phase-pairs-seed1"
    for given, where, change, rule in (
        (few, dataset, {}, "no answer to 3 of the 100 events of d, test events: phase-500-0097, phase-500-0098, phase-500-0099; "),
        (answers, other, {}, "has events of the preset demo; " + which),
        (answers, second, {}, "was made with the seed 2; " + which),
        (answers, tmp_path / "event.json", {}, "has 1 of them; " + which),
        (answers, half, {}, "its events are not the 50 recordings of the leaderboard"),
        (answers, tmp_path / "nowhere", {}, "nowhere"),
        ({id: {} for id in answers}, dataset, {}, "neither `goals` nor `forecast`"),
        ({id: {"goals": [[], []]} for id in answers}, dataset, {}, "predictions: event phase-500-0000: field `relation`"),
        (answers, dataset, {"name": "../x"}, "the name of the method must be"),
        (answers, dataset, {"by": " "}, "by must be a line of text"),
        (answers, dataset, {"source": "a\nb"}, "source must be a line of text"),
        (7, dataset, {}, "predictions: answers are a dict"),
    ):
        out = tmp_path / "out"
        with pytest.raises(phase.PhaseError, match=rule):
            phase.submit(given, where, **({"name": "mine", "out": out} | WHO | change))
        assert not out.exists()


def test_answers_to_a_sealed_dataset(tmp_path):
    secret, public = tmp_path / "secret", tmp_path / "public"
    small = ["--simulations", "10", "--particles", "4", "--max-steps", "8", "--size", "64"]
    phase.generate("demo", 6, secret, seed=11259375999999999999, options=small)
    phase.run("seal", secret, "--out", public)
    published = phase.load_observed(public / "events.json")
    answers = {seen.id: phase.infer(seen, method="cue") for seen in published}
    with pytest.raises(phase.PhaseError, match="sealed must be given, too"):
        phase.submit(answers, secret, name="mine", out=tmp_path / "out", questions=tmp_path, **WHO)
    other = tmp_path / "other"
    phase.generate("demo", 6, other, seed=11259375999999999998, options=small)
    with pytest.raises(phase.PhaseError, match="the manifest of .*other is not what was sealed"):
        phase.submit(answers, other, name="mine", out=tmp_path / "out", sealed=public, **WHO)
    assert not (tmp_path / "out").exists()
    done = phase.submit(answers, secret, name="mine", out=tmp_path / "out", sealed=public, **WHO)
    (score,) = done["scores"]
    seal = hashlib.sha256((public / "seal.json").read_bytes()).hexdigest()
    assert (score["set"], score["sealed"]) == (f"sealed-{seal[:12]}", {"seal": seal, "events": 6})
    assert score["top1"]["value"] == phase.evaluate("cue", secret)["goal"]["top1"]
