#!/usr/bin/env python3
"""Turns the published PHASE test recordings into a phase-events/1 file, and the raters' sheets into phase-ratings/1.

    python3 data/import_socialgnn.py Videos_Test_humanratings recordings.json
    python3 data/import_socialgnn.py Videos_Test_humanratings recordings.json \\
        --raters responses_genset --ratings ratings.json

Both inputs are in the repository Isik-lab/SocialGNN (MIT licence): the file PHASE/Videos_Test_humanratings and the
folder PHASE/Human_Experiment_Files/responses_genset. docs/reference/formats/overview.md describes both results. Python 3.9 or later and
numpy are needed.

What is read. The file is a pickle: a list whose entry k becomes the event `phase-test-k`; empty entries are skipped.
An entry is a dictionary:

    name               D...E<layout>[.<flip>]_G<goal>_<goal>_ST<a>_<b>_SZ...P...L<steps>_R<alpha>_<alpha>_...
    trajectories       [4 entities][rows][x, y, vx, vy, angle]: agents 0 and 1, objects 0 and 1
    entity_sizes       radii of the four entities
    entity_color_code  which colours the entities had; the name lists entities by colour, the record does not
    wall_segs          inner walls, after the mirroring
    landmark_centers   centres of the four landmarks
    social_goals       what human viewers said: friendly, adversarial or neutral

Strengths, goals, attitudes, the layout and the number of steps are only in the name (`physical_goals` numbers entities
in one way in some entries and in another way in others, so it is not read). The pickle has no actions.

What is mended. Lists of the name are brought into the order of the record. Objects' rows end where the agents' do. In
mirrored recordings agents' velocities were mirrored as if they were points, objects' velocities and angles were not
mirrored, and with the two diagonal mirrors agents' angles jump by a full turn; a row that is a mean over such a jump is
off by fifths of a turn. All of these are put right; how angles are is told by --angles:

    one-way      every step is a turn by -1.107 to 0.15 rad, whatever number of fifths that takes. This is the
                 default, since recordings converted earlier have such angles. An agent that was pushed the other way
                 by more than 0.15 rad is off by fifths from then on.
    consistent   only rows near the jump may be off by fifths, and the angles of all rows are chosen together

The pickle is read in a process of its own, with limits on memory and time; only numpy arrays and plain data are
admitted.
"""

import argparse
import json
import math
import os
import re
import sys

from importer import (EXIT_BAD_INPUT, EXIT_FAILURE, Failure, Unusable, answer, ask, content_of, import_numpy, is_reading,
                      open_regular, save, shown)

RADII = [0.8, 1.2, 1.6, 1.01]
FORCES = [150.0, 300.0, 450.0, 600.0]
RELATIONS = ["friendly", "neutral", "adversarial"]
COLUMNS = ["x", "y", "vx", "vy", "angle"]
CENTRE = (16.0, 12.0)
LAYOUTS = 22
LANDMARKS = 4
AGENTS = 2
ENTITIES = 4
SUBSTEPS = 5
TURN = 2 * math.pi
FIFTH = TURN / SUBSTEPS
# Written numbers of trajectories are whole multiples of 1e-5 u, u/s or rad.
PARTS_OF_UNIT = 1e5

# How far an agent that turns clockwise alone may be pushed the other way in a step (rad).
PUSHED = 0.15
# No agent turns farther than this in a step (rad), a little rounded up.
FASTEST_TURN = 1.12
# A row can span the jump only if its mean is as near to it (rad): the farthest of five substeps is so far from their
# mean at the fastest turn.
JUMP_REACH = 0.57
# Costs of an explanation of a step: of its turn (per rad), of a mean that differs from the stored one (per rad, at most
# 1 rad), of a turn against the clock beyond PUSHED, and of one that is too fast.
COST_TURN = 1.0
COST_MEAN = 3.0
COST_AGAINST = 1.0
COST_TOO_FAST = 10.0

# The published file has 100 entries of at most 101 rows and 1.5 MB.
LARGEST_FILE_BYTES = 64 << 20
MOST_ENTRIES = 1000
MOST_ROWS = 2000
MOST_WALLS = 16

LARGEST_SHEET_BYTES = 1 << 20
ANSWERS_PER_SHEET = 23
# Catch trials by layout, and the only right answer to each.
CATCH_ENDING = "_mm"
CATCH_TRIALS = {4: "adversarial", 12: "friendly", 0: "neutral"}


# Reading.

def entries_of(path):
    if import_numpy() is None:
        raise Failure("numpy is needed to read the recordings")
    content = content_of(path, LARGEST_FILE_BYTES)
    if type(content) is not list or not 0 < len(content) <= MOST_ENTRIES:
        raise Unusable(f"must hold a list of 1 to {MOST_ENTRIES} entries")
    return content


def converted_entries(path, angles):
    """What the reading process has to tell: events, their ids by the names of videos, and the number of entries."""
    content = entries_of(path)
    events, names = [], {}
    for k, entry in enumerate(content):
        if entry is None:
            continue
        event_id = f"phase-test-{k:03d}"
        try:
            event = convert(entry, event_id, angles)
        except Unusable as error:
            raise Unusable(f"entry {k}: {error}") from error
        except (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError, RecursionError) as error:
            # A record from elsewhere may lack any field or have one of another form.
            raise Unusable(f"entry {k}: a field is missing or malformed ({shown(repr(error))})") from error
        names.setdefault(entry["name"], []).append(event_id)
        events.append(event)
    return {"events": events, "names": names, "entries": len(content)}


# Checks. What is in a pickle may have any type and any size.

def numbers(values, count, what):
    """Finite numbers from a list or tuple of a known length."""
    if type(values) not in (list, tuple) or len(values) != count:
        raise Unusable(f"{what} must hold {count} values")
    if any(type(value) not in (int, float) for value in values):
        raise Unusable(f"{what} must hold numbers")
    result = [float(value) for value in values]
    if not all(math.isfinite(value) for value in result):
        raise Unusable(f"{what} must hold finite numbers")
    return result


def points(values, count, what):
    if type(values) not in (list, tuple) or len(values) != count:
        raise Unusable(f"{what} must hold {count} points")
    return [numbers(value, 2, what) for value in values]


def text(value, what):
    if type(value) is not str:
        raise Unusable(f"{what} must be a text")
    return value


def array_rows(array):
    numpy = import_numpy()
    if type(array) is not numpy.ndarray or array.ndim != 2 or array.dtype.kind != "f":
        raise Unusable("`trajectories` must hold arrays of numbers with rows and columns")
    rows, columns = array.shape
    if columns != len(COLUMNS) or not 0 < rows <= MOST_ROWS:
        raise Unusable(f"`trajectories` must have 1 to {MOST_ROWS} rows of {len(COLUMNS)} numbers")
    if not numpy.isfinite(array).all():
        raise Unusable("`trajectories` must hold finite numbers")
    return array.astype(float).tolist()


# Names.

NAME = re.compile(r"_E(?P<base>\d{1,2})(?:\.(?P<flip>[0-3]))?_G(?P<goals>.{1,80})_ST(?P<strengths>\d_\d)"
                  r"_SZ(?P<sizes>\d_\d_\d_\d)_P.{1,200}_L(?P<steps>\d{1,4})"
                  r"_R(?P<alphas>-?\d{1,3}(?:\.\d{1,3})?_-?\d{1,3}(?:\.\d{1,3})?)_", re.ASCII)
# Kind, subject, target and sign, as in ['LMO', 0, 2, 1].
GOAL = re.compile(r"(LMA|LMO|TE)[^\d-]{1,5}(\d)[^\d-]{1,3}(\d)[^\d-]{1,3}(-?1)(?!\d)", re.ASCII)


def parse_name(name):
    """What a name says, in the order of colours."""
    found = NAME.search(name)
    if not found:
        raise Unusable("its name does not tell layout, goals, strengths, sizes, steps and alphas")
    base, flip = int(found["base"]), found["flip"]
    goals = [(kind, int(a), int(b), int(sign)) for kind, a, b, sign in GOAL.findall(found["goals"])]
    if base >= LAYOUTS:
        raise Unusable(f"its name gives the layout {base}, which does not exist")
    if len(goals) != AGENTS:
        raise Unusable("its name does not tell two goals")
    return {
        "base": base,
        "flip": None if flip is None else int(flip),
        "goals": goals,
        "strength_levels": levels(found["strengths"], FORCES),
        "size_levels": levels(found["sizes"], RADII),
        "steps": int(found["steps"]),
        "alphas": [float(alpha) for alpha in found["alphas"].split("_")],
    }


def levels(digits, table):
    result = [int(digit) for digit in digits.split("_")]
    if any(level >= len(table) for level in result):
        raise Unusable(f"its name has a level above {len(table) - 1}")
    return result


def swaps(code):
    """Whether agents and whether objects have exchanged colours. In older recordings the keys collide and three entries
    are left of four."""
    if type(code) is not dict or len(code) not in (3, 4):
        raise Unusable("`entity_color_code` must have three or four entries")
    return code.get(0) == 1, code.get(3 if len(code) == 4 else 1) == 3


def internal(pair, swapped):
    return pair[::-1] if swapped else pair


def internal_goal(goal, agents_swapped, objects_swapped):
    """A goal by colour as one by internal numbers. Landmarks of mirrored recordings are mirrored in the name."""
    kind, subject, target, sign = goal
    swap_agent = lambda agent: 1 - agent if agents_swapped else agent
    if subject >= 2 or target >= LANDMARKS:
        raise Unusable("a goal names an entity or landmark that does not exist")
    if kind == "LMO":
        return kind, 1 - subject if objects_swapped else subject, target, sign
    if kind == "LMA":
        return kind, swap_agent(subject), target, sign
    if target >= AGENTS:
        raise Unusable("a goal is to touch an object, which phase-events/1 does not know")
    return kind, swap_agent(subject), swap_agent(target), sign


def goal_object(goal):
    kind, subject, target, sign = goal
    if kind == "LMA":
        return {"kind": "agent_on_landmark", "agent": subject, "landmark": target, "sign": sign}
    if kind == "LMO":
        return {"kind": "object_on_landmark", "object": subject, "landmark": target, "sign": sign}
    return {"kind": "touch", "agent": subject, "other": target, "sign": sign}


def goals_and_alpha(name, agents_swapped, objects_swapped):
    """Both agents' goals and the alpha of agent 0: the planner of the recordings looked at that one alone."""
    alpha, _ = internal(name["alphas"], agents_swapped)
    alpha = (alpha > 0) - (alpha < 0)
    goals = [internal_goal(goal, agents_swapped, objects_swapped) for goal in name["goals"]]
    goals = internal(goals, agents_swapped)
    if alpha:
        # A helper has the other's goal, and a hinderer its opposite.
        goals = [(*goals[1][:3], alpha * goals[1][3]), goals[1]]
    return goals, alpha


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


# Trajectories. Mirrors: up and down, left and right, the two diagonals.

def mirror_vector(flip, x, y):
    return [(x, -y), (-x, y), (y, x), (-y, -x)][flip]


def mirror_point(flip, x, y):
    dx, dy = mirror_vector(flip, x - CENTRE[0], y - CENTRE[1])
    return CENTRE[0] + dx, CENTRE[1] + dy


def one_way_angles(angles):
    """Angles without jumps, if every step is a turn from PUSHED - FIFTH to PUSHED."""
    result = angles[:1]
    for angle in angles[1:]:
        step = angle - result[-1]
        result.append(result[-1] + step - FIFTH * math.ceil((step - PUSHED) / FIFTH))
    return result


def candidates(angle):
    """What a row may mean: itself, or, near the jump, itself with the jump of one to four substeps taken away."""
    shifted = [angle - FIFTH * spanned for spanned in range(1, SUBSTEPS)]
    return [angle] + [value for value in shifted if abs(math.remainder(value, TURN)) <= JUMP_REACH]


def wrapped_mean(last, angle):
    """The row that five substeps about an angle would leave, which turn on at an even rate."""
    step = (angle - last) / SUBSTEPS
    values = [angle + step * (k - SUBSTEPS // 2) for k in range(SUBSTEPS)]
    # From -2 pi to 0, as they were stored.
    return sum(-(-value % TURN) for value in values) / SUBSTEPS


def step_cost(last, angle, stored):
    step = angle - last
    cost = COST_TURN * abs(step) + COST_MEAN * min(abs(wrapped_mean(last, angle) - stored), 1.0)
    if step > PUSHED:
        cost += COST_AGAINST
    if abs(step) > FASTEST_TURN:
        cost += COST_TOO_FAST
    return cost


def consistent_angles(angles):
    """Angles without jumps, chosen together: the sequence of candidates of least cost."""
    paths = [[(0.0, angles[0], None)]]
    for stored in angles[1:]:
        reached = []
        for candidate in candidates(stored):
            options = []
            for k, (cost, last, _) in enumerate(paths[-1]):
                angle = candidate + TURN * round((last - candidate) / TURN)
                options.append((cost + step_cost(last, angle, stored), angle, k))
            reached.append(min(options))
        paths.append(reached)
    k = min(range(len(paths[-1])), key=lambda k: paths[-1][k][0])
    result = []
    for reached in reversed(paths):
        _, angle, before = reached[k]
        result.append(angle)
        k = before
    return result[::-1]


UNWRAP = {"one-way": one_way_angles, "consistent": consistent_angles}


def mend_mirrored(rows, flip, is_agent, angles):
    """Rows that were mirrored when they were recorded, made consistent."""
    if not is_agent:
        # An object is a disc without a front, so only the sense in which it turns is mirrored.
        return [[x, y, *mirror_vector(flip, vx, vy), -angle] for x, y, vx, vy, angle in rows]
    still = mirror_point(flip, 0.0, 0.0)
    turned = [row[4] for row in rows]
    if flip >= 2:
        turned = UNWRAP[angles](turned)
    return [[x, y, vx - still[0], vy - still[1], angle] for (x, y, vx, vy, _), angle in zip(rows, turned)]


def trajectory_of(entry, flip, angles):
    arrays = entry["trajectories"]
    if type(arrays) not in (list, tuple) or len(arrays) != ENTITIES:
        raise Unusable(f"`trajectories` must have {ENTITIES} entities")
    tracks = [array_rows(array) for array in arrays]
    # Objects' rows run on after the agents' end.
    rows = min(len(track) for track in tracks[:AGENTS])
    if any(len(track) < rows for track in tracks):
        raise Unusable("`trajectories` must have as many rows of every object as of the agents")
    tracks = [track[:rows] for track in tracks]
    if flip is not None:
        tracks = [mend_mirrored(track, flip, k < AGENTS, angles) for k, track in enumerate(tracks)]
    return [[[round(number * PARTS_OF_UNIT) / PARTS_OF_UNIT for number in row] for row in track] for track in tracks]


# Entries.

def size_levels_of(entry, name, agents_swapped, objects_swapped):
    """Levels of the record's sizes. Those of the name must be the same, which is how we notice a wrong order."""
    stored = [nearest_level(size) for size in numbers(entry["entity_sizes"], ENTITIES, "`entity_sizes`")]
    named = internal(name["size_levels"][:AGENTS], agents_swapped) \
        + internal(name["size_levels"][AGENTS:], objects_swapped)
    if stored != named:
        raise Unusable("its name and `entity_sizes` give different sizes")
    return stored


def nearest_level(size):
    nearest = min(range(len(RADII)), key=lambda level: abs(RADII[level] - size))
    if abs(RADII[nearest] - size) > 1e-3:
        raise Unusable(f"the size {size} is none of {RADII}")
    return nearest


def walls_of(entry):
    walls = entry["wall_segs"]
    if type(walls) not in (list, tuple) or len(walls) > MOST_WALLS:
        raise Unusable(f"`wall_segs` must have at most {MOST_WALLS} walls")
    return [points(wall, 2, "a wall") for wall in walls]


def convert(entry, event_id, angles):
    """An entry as an event of a phase-events/1 file."""
    if type(entry) is not dict:
        raise Unusable("is no dictionary")
    name = parse_name(text(entry["name"], "`name`"))
    agents_swapped, objects_swapped = swaps(entry["entity_color_code"])
    sizes = size_levels_of(entry, name, agents_swapped, objects_swapped)
    strengths = internal(name["strength_levels"], agents_swapped)
    goals, alpha = goals_and_alpha(name, agents_swapped, objects_swapped)
    kind, relation = kind_and_relation(goals, alpha)
    human = text(entry["social_goals"], "`social_goals`")
    if human not in RELATIONS:
        raise Unusable("`social_goals` must be friendly, neutral or adversarial")
    tracks = trajectory_of(entry, name["flip"], angles)
    agents = [{
        "radius": RADII[sizes[k]], "max_force": FORCES[strengths[k]],
        "strength_level": strengths[k], "size_level": sizes[k],
        "goal": goal_object(goals[k]), "alpha": alpha if k == 0 else 0,
    } for k in range(AGENTS)]
    return {
        "id": event_id,
        "layout": {"base": name["base"], "flip": name["flip"]},
        "walls": walls_of(entry),
        "landmarks": points(entry["landmark_centers"], LANDMARKS, "`landmark_centers`"),
        "agents": agents,
        "objects": [{"radius": RADII[size], "size_level": size} for size in sizes[AGENTS:]],
        "event": kind, "relation": relation, "relation_human": human,
        "step_seconds": 0.25,
        # Mirrored recordings were replayed, and their first row was kept after the first substep.
        "row_0": "initial state" if name["flip"] is None else "after 1/60 s",
        "recorded_steps": name["steps"],
        "trajectory": {"columns": COLUMNS, "agents": tracks[:AGENTS], "objects": tracks[AGENTS:]},
    }


# Raters.

def answer_of(line, where):
    """A line of a sheet as a dictionary, empty where the line has no answer."""
    try:
        fields = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise Unusable(f"{where} is no JSON") from error
    is_pair = lambda field: type(field) is list and len(field) == 2 and type(field[0]) is str
    if type(fields) is not list or not all(is_pair(field) for field in fields):
        raise Unusable(f"{where} is no list of names and values")
    return dict(fields)


def read_sheet(path):
    """The answers of a sheet: pairs of a video's name and what the rater said; None where there is none."""
    try:
        with open_regular(path, LARGEST_SHEET_BYTES) as stream:
            lines = stream.read(LARGEST_SHEET_BYTES).decode("utf-8").splitlines()
    except Unusable as error:
        raise Unusable(f"{path}: {error}") from error
    except OSError as error:
        raise Unusable(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise Unusable(f"{path}: is no text") from error
    # The first line tells about the rater.
    answers = [answer_of(line, f"{path}: line {k}") for k, line in enumerate(lines[1:], start=2) if line.strip()]
    return [(answer.get("video_name"), answer.get("likert_response")) if answer else None for answer in answers]


def is_complete(answers):
    """Whether a sheet has all answers, each to a video and one of the three."""
    if len(answers) != ANSWERS_PER_SHEET:
        return False
    given = [answer for answer in answers if answer]
    return all(type(video) is str and said in RELATIONS for video, said in given) \
        and set(catch_answers(given)) == set(CATCH_TRIALS)


def catch_answers(given):
    """What a rater said of the catch trials, by layout."""
    result = {}
    for video, said in given:
        layout = re.search(r"_E(\d{1,2})_", video, re.ASCII)
        if layout and re.sub(r"\.\w{1,5}$", "", video).endswith(CATCH_ENDING):
            result[int(layout[1])] = said
    return result


def count_ratings(folder, names):
    """A phase-ratings/1 file's content, and what became of the sheets."""
    try:
        sheets = sorted(entry for entry in os.listdir(folder) if not entry.startswith("."))
    except OSError as error:
        raise Unusable(f"{folder}: cannot be read: {error.strerror}") from error
    counts, used, incomplete, failed = {}, 0, 0, 0
    for sheet in sheets:
        answers = read_sheet(os.path.join(folder, sheet))
        if not is_complete(answers):
            incomplete += 1
            continue
        given = [answer for answer in answers if answer]
        if catch_answers(given) != CATCH_TRIALS:
            failed += 1
            continue
        used += 1
        for video, said in given:
            for event_id in names.get(video, []):
                counts.setdefault(event_id, dict.fromkeys(RELATIONS, 0))[said] += 1
    if not used:
        raise Unusable(f"{folder}: has no complete sheet with all catch trials answered rightly")
    if not counts:
        raise Unusable(f"{folder}: has no answers about these recordings")
    ratings = {"format": "phase-ratings/1", "ratings": {name: counts[name] for name in sorted(counts)}}
    return ratings, f"{used} raters ({incomplete} sheets are incomplete, {failed} failed a catch trial)"


# The program.

def run(arguments):
    files = [path for path in (arguments.file, arguments.out, arguments.ratings) if path]
    if len({os.path.realpath(path) for path in files}) < len(files):
        raise Unusable("the files to read and to write must be different")
    recordings = ask(__file__, arguments.file, arguments.angles)
    events = recordings["events"]
    if not events:
        raise Unusable(f"{arguments.file}: all entries are empty")
    ratings = None
    if arguments.raters:
        ratings, raters = count_ratings(arguments.raters, recordings["names"])
    save({"format": "phase-events/1", "events": events}, arguments.out)
    empty = recordings["entries"] - len(events)
    print(f"{len(events)} events in {arguments.out}" + (f" (empty entries: {empty})" if empty else ""))
    if ratings:
        save(ratings, arguments.ratings)
        print(f"ratings of {len(ratings['ratings'])} events in {arguments.ratings} by {raters}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", metavar="FILE", help="the recordings (PHASE/Videos_Test_humanratings)")
    parser.add_argument("out", metavar="EVENTS", help="the phase-events/1 file to write")
    parser.add_argument("--raters", metavar="FOLDER", help="the raters' sheets (responses_genset)")
    parser.add_argument("--ratings", metavar="FILE", help="the phase-ratings/1 file to write")
    parser.add_argument("--angles", choices=sorted(UNWRAP), default="one-way",
                        help="how jumps in angles of diagonally mirrored agents are mended (default: one-way)")
    arguments = parser.parse_args()
    if bool(arguments.raters) != bool(arguments.ratings):
        parser.error("--raters and --ratings go together")
    try:
        run(arguments)
    except Unusable as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(EXIT_BAD_INPUT)
    except Failure as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(EXIT_FAILURE)


if __name__ == "__main__":
    if is_reading(sys.argv):
        answer(converted_entries, *sys.argv[2:])
    else:
        main()
