"""A method of perception from outside: two files of predictions for `cargo xtask eval`.

    python3 docs/examples/external_method.py EVENTS [--split SPLIT] [--out FOLDER]

EVENTS is the folder of a generated dataset or a file in the format phase-events/1 (docs/reference/formats/events.md). Two files are
written, both called after the method: goals/rules-of-thumb.json (Task 1: what does each agent want, and how do the two
relate to each other?) and trajectories/rules-of-thumb.json (Task 2: where will everyone be in the 20 steps after the
first 20?).

The method is deliberately small. It has no physics, no planning and no idea of beliefs, only rules of thumb about
motion: an agent that ends at a landmark wanted to be there, one that moved an object wanted it where it ended, and one
that kept heading for the other wanted to reach it. It never says that an agent hinders, only what each would want for itself.
Put a method of your own in place of `judge` and `forecast`; the rest is the way in and out.
"""

import argparse
import json
import math
from pathlib import Path

LANDMARKS = [(8.5, 19.5), (23.5, 19.5), (23.5, 4.5), (8.5, 4.5)]  # centres, by number, the same in every event (u)
STEP_SECONDS = 5 / 60  # of physics; a step is shown for 0.25 s of video
WATCHED, PREDICTED = 20, 20  # steps of Task 2; row 0 of a trajectory is before the first step

# REACH, HEADING, CHASE and DAMPING were chosen on the training events of a generated dataset, the others are guesses.
# Nothing was chosen on test events.
REACH = 3.0  # an agent moves an object if it is as near as this, centre to centre (u)
SURENESS = 0.8  # of the softmax over goals (per u)
PUSHED_ENOUGH = 2.0  # an object moved less than this was only bumped into (u)
HEADING = 0.25  # what a u of heading for or away from the other counts against a u of distance
CHASE = 6.0  # what heading has to make up for before it is chasing or fleeing (u)
DAMPING = 0.85  # share of the velocity that is left after each step


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def events_of(path, split):
    """Yields the events of a file or dataset, one at a time."""
    if path.is_file():
        yield from read(path)["events"]
        return
    for entry in read(path / "manifest.json")["events"]:
        if split is None or entry.get("split", "train") == split:
            yield from read(path / entry["event"]["path"])["events"]


def what_is_shown(event):
    """The rows of agents and of objects, by entity and step: `[x, y, vx, vy, angle]` (u, u/s, rad).

    An event's file has the answers too (`agents[i].goal`, `event`, `relation`). A method that is measured must not see
    them, so only this function looks into the event.
    """
    return event["trajectory"]["agents"], event["trajectory"]["objects"]


def distance(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1])


def softmax(scores):
    highest = max(scores)
    weights = [math.exp(score - highest) for score in scores]
    return [weight / sum(weights) for weight in weights]


def moved(agent, thing):
    """How far a thing moved while the agent was near (u)."""
    steps = zip(agent, thing, thing[1:])
    return sum(distance(before, after) for me, before, after in steps if distance(me, before) < REACH)


def heading(me, other):
    """How far I went towards the other by motion of my own; negative if away from it (u)."""
    total = 0.0
    for before, after, there in zip(me, me[1:], other):
        apart = distance(before, there) or 1.0
        along = (after[0] - before[0]) * (there[0] - before[0]) + (after[1] - before[1]) * (there[1] - before[1])
        total += along / apart
    return total


def goals_of(number, agents, objects):
    """A list of (goal, score) for one agent: the higher, the more likely. Scores are in u."""
    me, other = agents[number], agents[1 - number]
    towards = HEADING * heading(me, other)
    touch = {"kind": "touch", "agent": number, "other": 1 - number}
    scored = [({**touch, "sign": 1}, towards - CHASE), ({**touch, "sign": -1}, -towards - CHASE)]
    for mark, centre in enumerate(LANDMARKS):
        place = {"kind": "agent_on_landmark", "agent": number, "landmark": mark, "sign": 1}
        scored.append((place, -distance(me[-1], centre)))
        for k, thing in enumerate(objects):
            goal = {"kind": "object_on_landmark", "object": k, "landmark": mark, "sign": 1}
            # Somebody who moves an object is after that, not after being where it takes them.
            effort = 3.0 if moved(me, thing) > PUSHED_ENOUGH else -6.0
            scored.append((goal, effort - distance(thing[-1], centre)))
    return scored


def relation_of(best, agents, objects):
    """Probabilities of the relations, from what each agent seems to want most."""
    # Two who do not meddle with each other are neutral.
    evidence = {"friendly": 0.0, "adversarial": 0.0, "neutral": 1.0}
    if any(goal["kind"] == "touch" for goal in best):
        evidence["adversarial"] += 3.0
    for thing in objects:
        if all(moved(agent, thing) > PUSHED_ENOUGH for agent in agents):
            # Both had a hand in it: together if it got somewhere, against each other if it did not.
            arrived = min(distance(thing[-1], centre) for centre in LANDMARKS) < 2.0
            evidence["friendly" if arrived else "adversarial"] += 3.0
    return dict(zip(evidence, softmax(list(evidence.values()))))


def judge(agents, objects):
    """Task 1: goals of both agents with their probabilities, and the relation."""
    goals, best = [], []
    for number in (0, 1):
        scored = goals_of(number, agents, objects)
        shares = softmax([SURENESS * score for _, score in scored])
        goals.append([{"goal": goal, "p": p} for (goal, _), p in zip(scored, shares)])
        best.append(max(scored, key=lambda pair: pair[1])[0])
    return {"goals": goals, "relation": relation_of(best, agents, objects)}


def forecast(agents, objects):
    """Task 2: everyone goes on, slower and slower, from the last row watched; agents first, then objects.

    Always 20 steps: what goes on after an event's end is not scored.
    """
    paths = []
    for rows in agents + objects:
        x, y, vx, vy, _angle = rows[-1]
        path = []
        for _ in range(PREDICTED):
            vx, vy = DAMPING * vx, DAMPING * vy
            # Nobody leaves the arena.
            x = min(max(x + STEP_SECONDS * vx, 6.0), 26.0)
            y = min(max(y + STEP_SECONDS * vy, 2.0), 22.0)
            path.append([x, y])
        paths.append(path)
    return paths


def main():
    options = argparse.ArgumentParser(description="Writes predictions for `cargo xtask eval`.")
    options.add_argument("events", type=Path, help="folder of a generated dataset, or a phase-events/1 file")
    options.add_argument("--split", choices=["train", "validation", "test"], help="only this part of a dataset")
    options.add_argument("--out", type=Path, default=Path("."), help="folder to write into")
    options = options.parse_args()
    answers, forecasts = [], []
    for event in events_of(options.events, options.split):
        agents, objects = what_is_shown(event)
        answers.append({"id": event["id"], **judge(agents, objects)})
        # Only the first 20 steps are shown for Task 2.
        watched = [[rows[: WATCHED + 1] for rows in paths] for paths in (agents, objects)]
        forecasts.append({"id": event["id"], "forecast": forecast(*watched)})
    for task, events in (("goals", answers), ("trajectories", forecasts)):
        file = options.out / task / "rules-of-thumb.json"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps({"events": events}), encoding="utf-8")


if __name__ == "__main__":
    main()
