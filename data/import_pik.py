#!/usr/bin/env python3
"""Turns recordings of the published PHASE simulator (.pik) into a phase-events/1 file.

    python3 data/import_pik.py recordings.pik [more.pik ...] --out events.json
    python3 data/import_pik.py --self-test [--out events.json]

The result is what `cargo xtask simulate`, `render` and `check-physics` read; docs/reference/formats/events.md describes it.
Python 3.9 or later is enough; numpy is needed only if the recordings hold numpy arrays.

What is read. A file holds one record, a list of records, or records by name. A record is a dictionary:

    trajectories       [4 entities][rows][x, y, vx, vy, angle]: agents 0 and 1, objects 0 and 1
    sizes              radii of the four entities (also entity_sizes)
    strengths          of the agents, 30, 60, 90 or 120 (150 to 600 N in the world); else from the name
    entity_color_code  which colours the entities had; the name lists them by colour, the record does not
    wall_segs          inner walls
    actions            one index from 0 to 13 for each agent and step, if they were kept
    goals              used only if the name does not tell them (also flipped_goals, physical_goals)
    social_goals       what human viewers said: friendly, adversarial or neutral, if it is there

and its name is in `name`, `video_name` or `file_name`, is its key, or is that of the file. The name looks like
D...E<layout>[.<flip>]_G<goal>_<goal>_ST<a>_<b>_SZ...L<steps>_R<alpha>_<alpha>_...

What is mended. Rows that were kept for every substep of 1/60 s become means over five, as everywhere else.
Objects' rows end where the agents' do. Recordings that were mirrored for the data set have agents' velocities
mirrored as if they were points, objects' velocities and angles not mirrored at all, and with the two diagonal
mirrors agents' angles that jump by a full turn; all three are put right. An angle that is the mean over such a
jump is off by fifths of a turn, which are taken away again.
"""

import argparse
import io
import math
import pickle
import re
import sys

from importer import (EXIT_BAD_INPUT, EXIT_FAILURE, Failure, Unusable, answer, ask, content_of, is_reading, load, save,
                      shown)

RADII = [0.8, 1.2, 1.6, 1.01]
FORCES = [150.0, 300.0, 450.0, 600.0]
ACTIONS = ["turnleft", "turnright", "up", "down", "left", "right", "upleft", "upright", "downleft", "downright",
           "stop", "noforce", "attach", "detach"]
LANDMARKS = [[8.5, 19.5], [23.5, 19.5], [23.5, 4.5], [8.5, 4.5]]
CENTRE = (16.0, 12.0)
SUBSTEPS = 5
# Start positions by their number in names, before the mirroring.
STARTS = [(8, 20), (8, 14), (8, 10), (8, 4), (24, 20), (24, 14), (24, 10), (24, 4), (16, 16), (16, 8),
          (14, 16), (14, 8), (18, 16), (18, 8), (14, 20), (14, 4), (18, 20), (18, 4), (16, 12), (18, 14)]
# The largest file that is read (bytes); the published recordings have less than a megabyte each.
LARGEST_FILE_BYTES = 256 << 20
# No agent turns farther than this in a step (rad).
FASTEST_TURN = 1.1
# How far one that turns clockwise alone may be pushed the other way in a step (rad); a fifth of a turn lies between.
PUSHED = 0.15


def plain(value):
    """Arrays as lists, numpy's numbers as Python's."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(element) for element in value]
    return value


# Mirrors: up and down, left and right, the two diagonals.

def mirror_vector(flip, x, y):
    return [(x, -y), (-x, y), (y, x), (-y, -x)][flip]


def mirror_point(flip, x, y):
    dx, dy = mirror_vector(flip, x - CENTRE[0], y - CENTRE[1])
    return CENTRE[0] + dx, CENTRE[1] + dy


def mirror_angle(flip, angle):
    return [math.pi, 0.0, -math.pi / 2, math.pi / 2][flip] - angle


def mirror_action(action):
    """A mirrored body goes left where the body goes right."""
    swapped = {"left": "right", "right": "left"}
    return re.sub("left|right", lambda found: swapped[found.group()], action)


# Names.

def parse_name(name):
    """Layout, flip, goals by colour, and lists by colour, as far as the name has them."""
    found = re.search(r"_E(\d+)(?:\.(\d))?_", name)
    if not found:
        raise Unusable("its name does not say which layout it has (…_E<layout>_…)")
    pair = lambda key: [int(n) for n in re.search(rf"_{key}(-?\d+)_(-?\d+)", name).groups()] \
        if re.search(rf"_{key}(-?\d+)_(-?\d+)", name) else None
    places = re.search(r"_P(\d+)_(\d+)_(\d+)_(\d+)", name)
    goals = re.search(r"_G(.*?)_ST", name)
    return {
        "layout": int(found.group(1)),
        "flip": None if found.group(2) is None else int(found.group(2)),
        "goals": parse_goals(goals.group(1)) if goals else [],
        "strength_levels": pair("ST"),
        "alphas": pair("R"),
        "starts": [int(place) for place in places.groups()] if places else None,
    }


def parse_goals(text):
    """Goals such as LMO_0_2_1: kind, subject, target and sign, with anything between the digits."""
    pattern = r"(LMA|LMO|TE)[^\d-]*(\d)[^\d-]*(\d)[^\d-]*(-?1)(?!\d)"
    return [(kind, int(a), int(b), int(sign)) for kind, a, b, sign in re.findall(pattern, text)]


def swaps(code):
    """Whether agents and whether objects have exchanged colours. In older recordings the keys collide and three
    entries are left of four."""
    if not code:
        return False, False
    return code.get(0) == 1, code.get(3 if len(code) == 4 else 1) == 3


def internal(pair, swapped):
    return pair[::-1] if pair and swapped else pair


def internal_goal(goal, agents_swapped, objects_swapped):
    """A goal by colour as one by internal numbers."""
    kind, subject, target, sign = goal
    if kind == "LMO":
        return kind, 1 - subject if objects_swapped else subject, target, sign
    if agents_swapped:
        subject = 1 - subject
        if kind == "TE" and target < 2:
            target = 1 - target
    if kind == "TE" and target >= 2 and objects_swapped:
        target = 5 - target
    return kind, subject, target, sign


def goals_of(record, name, code):
    agents_swapped, objects_swapped = swaps(code)
    goals = [internal_goal(goal, agents_swapped, objects_swapped) for goal in name["goals"]]
    if len(goals) == 2:
        return internal(goals, agents_swapped)
    for key in ("physical_goals", "flipped_goals", "goals"):
        stored = [tuple(goal) for goal in plain(record.get(key) or [])]
        if len(stored) == 2 and all(len(goal) == 4 for goal in stored):
            # These are in internal order, but the older records number entities by colour.
            if code and len(code) == 3:
                stored = [internal_goal(goal, agents_swapped, objects_swapped) for goal in stored]
            return stored
    raise Unusable("neither its name nor its fields tell the two goals")


def goal_object(goal):
    kind, subject, target, sign = goal
    if kind == "LMA":
        return {"kind": "agent_on_landmark", "agent": subject, "landmark": target, "sign": sign}
    if kind == "LMO":
        return {"kind": "object_on_landmark", "object": subject, "landmark": target, "sign": sign}
    if target >= 2:
        raise Unusable("a goal is to touch an object, which phase-events/1 does not know")
    return {"kind": "touch", "agent": subject, "other": target, "sign": sign}


def kind_and_relation(goals, alpha):
    """What the scene was made to show."""
    (kind, subject, target, _), (kind_1, subject_1, target_1, _) = goals
    if alpha:
        return ("helping", "friendly") if alpha > 0 else ("hindering", "adversarial")
    if kind == "TE" and kind_1 == "TE":
        return "chasing", "adversarial"
    if kind == kind_1 == "LMO" and subject == subject_1:
        return ("collaborating", "friendly") if target == target_1 else ("competing", "adversarial")
    return "independent", "neutral"


# Trajectories.

def mean(rows):
    return [sum(column) / len(rows) for column in zip(*rows)]


def steps_from_substeps(rows):
    return [rows[0]] + [mean(rows[k:k + SUBSTEPS]) for k in range(1, len(rows) - SUBSTEPS + 1, SUBSTEPS)]


def unwrapped(angles):
    """Angles without jumps by full turns. A row is the mean over five substeps; where m of them lie beyond the jump, it
    is off by m fifths of a turn. Agents of mirrored recordings turn clockwise alone, and less than a fifth of a
    turn in a step, so which m it was can be told."""
    turn = 2 * math.pi
    result = angles[:1]
    for angle in angles[1:]:
        last = result[-1]
        nearest = angle + turn * round((last - angle) / turn)
        if not -FASTEST_TURN <= nearest - last <= PUSHED:
            fifths = [nearest + turn * m / SUBSTEPS for m in range(-4, 5)]
            # Only near the jump can a row span it.
            near_jump = lambda value: abs(value - turn * round(value / turn)) <= FASTEST_TURN
            fits = [value for value in fifths if -FASTEST_TURN <= value - last <= PUSHED and near_jump(value)]
            nearest = fits[0] if fits else nearest
        result.append(nearest)
    return result


def mirror_rows(rows, flip):
    """Rows of the world as it was simulated, mirrored whole."""
    return [[*mirror_point(flip, x, y), *mirror_vector(flip, vx, vy), mirror_angle(flip, angle)]
            for x, y, vx, vy, angle in rows]


def mend_mirrored(rows, flip, is_agent):
    """Rows that were mirrored when they were recorded, made consistent."""
    if not is_agent:
        return [[x, y, *mirror_vector(flip, vx, vy), mirror_angle(flip, angle)] for x, y, vx, vy, angle in rows]
    still = mirror_point(flip, 0.0, 0.0)
    angles = [row[4] for row in rows]
    if flip >= 2:
        angles = unwrapped(angles)
    return [[x, y, vx - still[0], vy - still[1], angle] for (x, y, vx, vy, _), angle in zip(rows, angles)]


def is_mirrored(tracks, name, agents_swapped):
    """Whether the rows of a mirrored recording are mirrored already: the agents start where the name says, or at
    its mirror image."""
    if not name["starts"]:
        return True
    starts = [STARTS[place] for place in internal(name["starts"][:2], agents_swapped)]
    images = [mirror_point(name["flip"], *start) for start in starts]
    off = lambda places: sum(math.dist(track[0][:2], place) for track, place in zip(tracks, places))
    return off(images) <= off(starts)


def trajectory_of(record, name, agents_swapped):
    tracks = [[[float(number) for number in row] for row in track] for track in plain(record["trajectories"])]
    if not 2 <= len(tracks) <= 4 or any(len(row) != 5 for track in tracks for row in track):
        raise Unusable("`trajectories` must hold rows of five numbers for two to four entities")
    rows = min(len(track) for track in tracks[:2])
    if rows == 0 or any(len(track) < rows for track in tracks):
        raise Unusable("`trajectories` must hold as many rows of every entity as of the agents, and at least one")
    tracks = [track[:rows] for track in tracks]
    steps = steps_of_actions(record)
    # A row a substep, if there are far more rows than steps.
    if steps and rows > steps + 1:
        tracks = [steps_from_substeps(track) for track in tracks]
    flip = name["flip"]
    mirrored = flip is not None and is_mirrored(tracks, name, agents_swapped)
    if mirrored:
        tracks = [mend_mirrored(track, flip, k < 2) for k, track in enumerate(tracks)]
    elif flip is not None:
        tracks = [mirror_rows(track, flip) for track in tracks]
    return tracks, mirrored


def actions_by_step(record):
    """Pairs of action numbers by step, or nothing; they may be kept by agent or by step."""
    actions = plain(record.get("actions"))
    if not actions:
        return []
    by_agent = len(actions) == 2 and all(isinstance(agent, list) for agent in actions)
    # Two steps of two actions look the same either way; no recording is that short.
    if by_agent:
        return [list(pair) for pair in zip(*actions)]
    return actions


def steps_of_actions(record):
    return len(actions_by_step(record))


def recovered_actions(record, name, rows):
    pairs = []
    for pair in actions_by_step(record)[:rows]:
        try:
            names = [action if action in ACTIONS else ACTIONS[int(action)] for action in pair]
        except (TypeError, ValueError, IndexError):
            # An action we do not know ends what is known.
            break
        pairs.append([mirror_action(action) for action in names] if name["flip"] is not None else names)
    return pairs


# Records.

def level(value, table, what):
    nearest = min(range(len(table)), key=lambda k: abs(table[k] - value))
    if abs(table[nearest] - value) > 1e-3 * table[-1]:
        raise Unusable(f"{what} {value} is none of {table}")
    return nearest


def convert(record, record_name, event_id):
    """One record as an event of a phase-events/1 file."""
    name = parse_name(record_name)
    code = record.get("entity_color_code") or {}
    agents_swapped, _ = swaps(code)
    sizes = next((plain(record[key]) for key in ("sizes", "entity_sizes") if record.get(key) is not None), None)
    if sizes is None:
        raise Unusable("there are no `sizes`")
    tracks, mirrored = trajectory_of(record, name, agents_swapped)
    objects = len(tracks) - 2
    size_levels = [level(size, RADII, "size") for size in sizes[:2 + objects]]
    strengths = plain(record.get("strengths"))
    if strengths:
        strength_levels = [level(strength * SUBSTEPS, FORCES, "strength") for strength in strengths[:2]]
    else:
        strength_levels = internal(name["strength_levels"], agents_swapped)
    if not strength_levels:
        raise Unusable("neither its name nor its fields tell the strengths")
    goals = goals_of(record, name, code)
    alphas = internal(name["alphas"], agents_swapped) or [0, 0]
    # The planner of the recordings looked at agent 0's alpha alone; a helper or hinderer has the other's goal.
    alpha = (alphas[0] > 0) - (alphas[0] < 0)
    if alpha:
        goals = [(*goals[1][:3], alpha * goals[1][3]), goals[1]]
    kind, relation = kind_and_relation(goals, alpha)
    agents = [{
        "radius": RADII[size_levels[k]], "size_level": size_levels[k],
        "max_force": FORCES[strength_levels[k]], "strength_level": strength_levels[k],
        "goal": goal_object(goals[k]), "alpha": alpha if k == 0 else 0,
    } for k in range(2)]
    event = {"id": event_id, "layout": {"base": name["layout"], "flip": name["flip"]}}
    if record.get("wall_segs") is not None and (mirrored or name["flip"] is None):
        event["walls"] = plain(record["wall_segs"])
    event.update({
        "landmarks": LANDMARKS,
        "agents": agents,
        "objects": [{"radius": RADII[size], "size_level": size} for size in size_levels[2:]],
        "event": kind, "relation": relation,
    })
    human = record.get("social_goals")
    if human in ("friendly", "adversarial", "neutral"):
        event["relation_human"] = human
    length = re.search(r"_L(\d+)_", record_name)
    event.update({
        "step_seconds": 0.25,
        "row_0": "after 1/60 s" if mirrored else "initial state",
        "recorded_steps": int(length.group(1)) if length else len(tracks[0]) - 1,
        "trajectory": {"columns": ["x", "y", "vx", "vy", "angle"], "agents": tracks[:2], "objects": tracks[2:]},
    })
    actions = recovered_actions(record, name, len(tracks[0]) - 1)
    if actions:
        event["recovered_actions"] = {"steps": actions, "note": "recorded"}
    return event


def records_of(content, stem):
    """Records with their names."""
    def named(record, default):
        keys = ("name", "video_name", "file_name")
        return next((record[key] for key in keys if isinstance(record.get(key), str)), default), record
    if isinstance(content, dict) and "trajectories" in content:
        return [named(content, stem)]
    if isinstance(content, dict):
        entries = [(str(key), record) for key, record in content.items()]
    elif isinstance(content, (list, tuple)):
        entries = [(stem, record) for record in content]
    else:
        raise Unusable("holds no records")
    # An entry may be empty, where recordings were left out.
    entries = [(default, record) for default, record in entries if record is not None]
    if not entries:
        raise Unusable("holds no records")
    for default, record in entries:
        if not isinstance(record, dict):
            raise Unusable(f"holds something else than records ({type(record).__name__})")
    return [named(record, default) for default, record in entries]


def convert_file(path):
    """The events of a file; runs in the reading process."""
    stem = re.sub(r"\.\w+$", "", re.split(r"[/\\]", path)[-1])
    records = records_of(content_of(path, LARGEST_FILE_BYTES), stem)
    events = []
    short = re.sub(r"[^A-Za-z0-9]+", "-", stem).strip("-")[:60] or "recording"
    for k, (name, record) in enumerate(records):
        event_id = short if len(records) == 1 else f"{short}-{k:04d}"
        try:
            events.append(convert(record, name, event_id))
        except Unusable as error:
            raise Unusable(f"record {k}: {error}") from error
        except (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError, RecursionError) as error:
            # A record from elsewhere may lack any field or have one of another form.
            raise Unusable(f"record {k}: a field is missing or malformed ({shown(repr(error))})") from error
    return events


def write(events, out):
    ids = [event["id"] for event in events]
    twice = next((name for name in ids if ids.count(name) > 1), None)
    if twice:
        raise Unusable(f"two recordings would have the id {twice}; convert them apart")
    save({"format": "phase-events/1", "events": events}, out)


# Self-test.

def made_up(flip, mirror_as_published):
    """A record of six steps with a row a substep, or of means mirrored with the published defects; and what it should
    become."""
    def row(k, t):
        return [10.0 + 3 * k + 0.02 * t, 14.0 - 0.01 * t, 1.2 + k, -0.6, 0.3 * k + 0.11 * t]
    substeps = [[row(k, t) for t in range(31)] for k in range(4)]
    truth = [steps_from_substeps(track) for track in substeps]
    if flip is None:
        return {"trajectories": substeps}, truth
    if not mirror_as_published:
        return {"trajectories": substeps}, [mirror_rows(track, flip) for track in truth]
    stored = []
    for k, track in enumerate(substeps):
        rows = []
        for x, y, vx, vy, angle in track:
            if k < 2:
                seen = mirror_angle(flip, angle)
                if flip >= 2:
                    seen = -((-seen) % (2 * math.pi))
                rows.append([*mirror_point(flip, x, y), *mirror_point(flip, vx, vy), seen])
            else:
                rows.append([*mirror_point(flip, x, y), vx, vy, angle])
        stored.append(steps_from_substeps(rows))
    # The published objects' rows run on after the agents' end.
    stored = stored[:2] + [track + track[-1:] * 3 for track in stored[2:]]
    return {"trajectories": stored}, [mirror_rows(track, flip) for track in truth]


def self_test(out):
    name = "D010121_1021040_0_0_0_F8_E{}_GLMO_0_2_1_LMO_0_2_1_ST0_2_SZ0_1_2_3_P1_5_2_4_A0_0_C0_0_AN0.1_0.2_MCTS_L100" \
           "_R{}_{}_PL1_EL1_0_0_s1000_r10_cI1.25_cB1000_e3"
    events = []
    for flip in (None, 0, 1, 2, 3):
        for published in ((True, False) if flip is not None else (False,)):
            record, truth = made_up(flip, published)
            # The agents start on the places that the name gives, colours exchanged.
            starts = [STARTS[5], STARTS[1]]
            for k in range(2):
                start = mirror_point(flip, *starts[k]) if published else starts[k]
                aim = mirror_point(flip, *starts[k]) if flip is not None else starts[k]
                for rows, to in ((record["trajectories"][k], start), (truth[k], aim)):
                    dx, dy = to[0] - rows[0][0], to[1] - rows[0][1]
                    rows[:] = [[row[0] + dx, row[1] + dy, *row[2:]] for row in rows]
            record.update({"sizes": [0.8, 1.2, 1.6, 1.01], "strengths": [90, 30],
                           "entity_color_code": {0: 1, 1: 0, 2: 3, 3: 2}})
            if not published:
                record["actions"] = [[0, 2, 2, 12, 9, 13], [2, 2, 4, 10, 11, 1]]
            stream = io.BytesIO(pickle.dumps(record))
            layout = "2" if flip is None else f"2.{flip}"
            event_id = f"made-up-{flip}-{'mirrored' if published else 'raw'}"
            event = convert(load(stream), name.format(layout, 0, 10), event_id)
            tracks = event["trajectory"]["agents"] + event["trajectory"]["objects"]
            assert [len(track) for track in tracks] == [7] * 4, event_id
            for k, (track, expected) in enumerate(zip(tracks, truth)):
                for t, (found, wanted) in enumerate(zip(track, expected)):
                    turn = round((found[4] - wanted[4]) / (2 * math.pi)) * 2 * math.pi
                    wanted = [*wanted[:4], wanted[4] + turn]
                    assert all(abs(a - b) < 1e-9 for a, b in zip(found[:4], wanted)), (event_id, k, t)
                    assert abs(found[4] - wanted[4]) < 1e-9, (event_id, k, t, found, wanted)
            first, second = event["agents"]
            assert (first["strength_level"], second["strength_level"]) == (2, 0)
            # Colours were exchanged: the helper of the name's second place is agent 0, blue is object 0 only if
            # code[3] is not 3.
            assert (first["alpha"], second["alpha"], event["event"]) == (1, 0, "helping")
            assert first["goal"] == {"kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": 1}
            if not published:
                third = ["left", "up"] if flip is None else ["right", "up"]
                assert event["recovered_actions"]["steps"][2] == ["up", third[0]], event_id
            events.append(event)
    goals = [("TE", 0, 1, 1), ("TE", 1, 0, -1)]
    assert kind_and_relation(goals, 0) == ("chasing", "adversarial")
    assert swaps({0: 1, 1: 3, 2: 0}) == (True, True) and swaps({0: 0, 1: 1, 2: 2, 3: 3}) == (False, True)
    assert internal_goal(("LMO", 0, 3, 1), False, True) == ("LMO", 1, 3, 1)
    assert internal_goal(("TE", 0, 1, -1), True, False) == ("TE", 1, 0, -1)
    assert parse_goals("['LMA', 0, 3, -1]_['TE', 1, 0, 1]") == [("LMA", 0, 3, -1), ("TE", 1, 0, 1)]
    for bad in (pickle.dumps(print), b"", b"no pickle", pickle.dumps({"trajectories": []})[:-4]):
        try:
            load(io.BytesIO(bad))
        except Exception:
            continue
        raise AssertionError(f"{bad!r} was loaded")
    if out:
        write(events, out)
    print(f"self-test passed: {len(events)} made-up recordings")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", metavar="FILE", help="recordings (.pik)")
    parser.add_argument("--out", metavar="FILE", help="the phase-events/1 file to write")
    parser.add_argument("--self-test", action="store_true", help="convert made-up recordings and check the result")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test(arguments.out)
    if not arguments.files or not arguments.out:
        parser.error("give recordings and --out, or --self-test")
    try:
        events = [event for path in arguments.files for event in ask(__file__, path)]
        if not events:
            raise Unusable("there are no records in these files")
        write(events, arguments.out)
    except Unusable as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(EXIT_BAD_INPUT)
    except Failure as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(EXIT_FAILURE)
    print(f"{len(events)} events in {arguments.out}")


if __name__ == "__main__":
    if is_reading(sys.argv):
        answer(convert_file, *sys.argv[2:])
    else:
        main()
