"""What the importers beside this file share: what names and records of the published simulator mean.

A record is a dictionary:

    trajectories       [4 entities][rows][x, y, vx, vy, angle]: agents 0 and 1, objects 0 and 1
    entity_sizes       radii of the four entities (also sizes)
    entity_color_code  which colours the entities had; the name lists entities by colour, the record does not
    social_goals       what human viewers said: friendly, adversarial or neutral; may be absent
    wall_segs          inner walls, after the mirroring; may be absent
    landmark_centers   centres of the four landmarks; may be absent
    strengths          of the agents, 30, 60, 90 or 120 (150 to 600 N in the world); may be absent
    actions            one index from 0 to 13, or a name, for each agent and step; may be absent

and its name looks like

    D...E<layout>[.<flip>]_G<goal>_<goal>_ST<a>_<b>_SZ<a>_<b>_<c>_<d>_P<a>_<b>_<c>_<d>_..._L<steps>_R<alpha>_<alpha>_...

A `_AN<angle>_<angle>_` among the other fields gives the agents' first angles (rad), before the mirroring.

Name and record are understood whole or refused: what cannot be read, or is told in two ways, is never replaced by a
usual value. Goals, attitudes, the layout and the number of steps are only in the name: `physical_goals` numbers
entities in one way in some records and in another way in others, so it is not read.

What is mended. Lists of the name are brought into the order of the record. Rows that were kept for every substep of
1/60 s become means over five. Objects' rows end where the agents' do. In recordings that were mirrored for the data
set, agents' velocities were mirrored as if they were points, objects' velocities and angles were not mirrored, and with
the two diagonal mirrors agents' angles jump by a full turn; a row that is a mean over such a jump is off by fifths of a
turn. All of these are put right; how angles are is told by `angles`:

    one-way      every step is a turn by -1.107 to 0.15 rad, whatever number of fifths that takes. This is the usual
                 one, since recordings converted earlier have such angles. An agent that was pushed the other way
                 by more than 0.15 rad is off by fifths from then on.
    consistent   only rows near the jump may be off by fifths, and the angles of all rows are chosen together
"""

import math
import re

from importer import Unusable, import_numpy, shown

RADII = [0.8, 1.2, 1.6, 1.01]
FORCES = [150.0, 300.0, 450.0, 600.0]
RELATIONS = ["friendly", "neutral", "adversarial"]
ACTIONS = ["turnleft", "turnright", "up", "down", "left", "right", "upleft", "upright", "downleft", "downright",
           "stop", "noforce", "attach", "detach"]
COLUMNS = ["x", "y", "vx", "vy", "angle"]
LANDMARKS = [[8.5, 19.5], [23.5, 19.5], [23.5, 4.5], [8.5, 4.5]]
CENTRE = (16.0, 12.0)
# Start positions by their number in names, before the mirroring.
STARTS = [(8, 20), (8, 14), (8, 10), (8, 4), (24, 20), (24, 14), (24, 10), (24, 4), (16, 16), (16, 8),
          (14, 16), (14, 8), (18, 16), (18, 8), (14, 20), (14, 4), (18, 20), (18, 4), (16, 12), (18, 14)]
LAYOUTS = 22
AGENTS = 2
ENTITIES = 4
SUBSTEPS = 5
TURN = 2 * math.pi
FIFTH = TURN / SUBSTEPS
# No place (u), speed (u/s) or angle (rad) of a recording is as large.
LARGEST_NUMBER = 1e4
# Centres of landmarks are where they are in every recording, to within this (u).
LANDMARK_TOLERANCE = 1e-3
# Names of trials that show whether a rater looked, in place of an event.
CATCH_ENDING = "_mm"
# Written numbers of trajectories are whole multiples of 1e-5 u, u/s or rad.
PARTS_OF_UNIT = 1e5
# A size or strength is the level whose value is this near to it, as a part of the largest value.
LEVEL_TOLERANCE = 1e-3

# Names have angles with two digits after the point (rad).
ANGLE_ROUNDING = 0.006

# The published recordings have at most 101 rows, and 6 walls.
MOST_ROWS = 2000
MOST_WALLS = 16

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

# What a record from elsewhere may cause that lacks a field or has one of another form.
MALFORMED = (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError, RecursionError)


# Checks. What is in a pickle may have any type and any size.

def plain(value):
    """Arrays as lists, numpy's numbers as Python's."""
    numpy = import_numpy()
    if numpy is not None and isinstance(value, (numpy.ndarray, numpy.generic)):
        return value.tolist()
    if type(value) in (list, tuple):
        return [plain(element) for element in value]
    return value


def numbers(values, count, what):
    """Numbers, none of them larger than those of recordings, from a list of a known length."""
    values = plain(values)
    if type(values) is not list or len(values) != count:
        raise Unusable(f"{what} must hold {count} values")
    if any(type(value) not in (int, float) for value in values):
        raise Unusable(f"{what} must hold numbers")
    result = [float(value) for value in values]
    if not all(math.isfinite(value) for value in result):
        raise Unusable(f"{what} must hold finite numbers")
    if any(abs(value) > LARGEST_NUMBER for value in result):
        raise Unusable(f"{what} must hold numbers from {-LARGEST_NUMBER:g} to {LARGEST_NUMBER:g}")
    return result


def points(values, count, what):
    values = plain(values)
    if type(values) is not list or len(values) != count:
        raise Unusable(f"{what} must hold {count} points")
    return [numbers(value, 2, what) for value in values]


def text(value, what):
    if type(value) is not str:
        raise Unusable(f"{what} must be a text")
    return value


def required(record, key):
    if record.get(key) is None:
        raise Unusable(f"`{key}` is missing")
    return record[key]


def table_rows(table):
    """Rows of a trajectory, from an array or a list."""
    shape = getattr(table, "shape", None)
    if shape is not None and (len(shape) != 2 or shape[0] > MOST_ROWS):
        raise Unusable(f"`trajectories` must have 1 to {MOST_ROWS} rows of {len(COLUMNS)} numbers")
    rows = plain(table)
    if type(rows) is not list or not 0 < len(rows) <= MOST_ROWS:
        raise Unusable(f"`trajectories` must have 1 to {MOST_ROWS} rows of {len(COLUMNS)} numbers")
    return [numbers(row, len(COLUMNS), "a row of `trajectories`") for row in rows]


def level(value, table, what):
    nearest = min(range(len(table)), key=lambda k: abs(table[k] - value))
    if abs(table[nearest] - value) > LEVEL_TOLERANCE * max(table):
        raise Unusable(f"the {what} {value} is none of {table}")
    return nearest


# Names.

NUMBER = r"-?\d{1,8}(?:\.\d{1,8})?"
GOAL = r"[\[(]?'?(?:LMA|LMO|TE)'?(?:, ?|_)\d(?:, ?|_)\d(?:, ?|_)-?1[\])]?"
# Fields that say nothing of what an event has: a word, numbers, or both.
OTHER_FIELDS = rf"(?:_(?!(?:E|G|ST|SZ|P|L|R)[\d\[('-])(?:[A-Za-z]{{1,8}}(?:{NUMBER})?|{NUMBER})){{0,20}}"
FIELDS = {
    "layout": r"_E(?P<base>\d{1,2})(?:\.(?P<flip>[0-3]))?",
    "goals": rf"_G(?P<goals>{GOAL}_{GOAL})",
    "strengths": r"_ST(?P<strengths>\d_\d)",
    "sizes": r"_SZ(?P<sizes>\d_\d_\d_\d)",
    "places": r"_P(?P<starts>\d{1,2}(?:_\d{1,2}){3})",
    "steps": r"_L(?P<steps>\d{1,4})",
    "alphas": rf"_R(?P<alphas>{NUMBER}_{NUMBER})",
}
NAME = re.compile(
    rf"(?:D?{NUMBER}|D)?{OTHER_FIELDS}" + "".join(list(FIELDS.values())[:5])
    # A further number after the attitudes would be a third one.
    + OTHER_FIELDS + FIELDS["steps"] + FIELDS["alphas"] + rf"(?!_{NUMBER}(?:[_.]|$))" + OTHER_FIELDS + r"(?:\.[A-Za-z]\w{0,5})?", re.ASCII)
# Kind, subject, target and sign, as in ['LMO', 0, 2, 1].
GOAL_PARTS = re.compile(r"(LMA|LMO|TE)\D+?(\d)\D+?(\d)[^\d-]+(-?1)", re.ASCII)


def parse_name(name):
    """What a name says, in the order of colours."""
    found = NAME.fullmatch(name)
    if not found:
        untold = next((what for what, field in FIELDS.items() if not re.search(field + "(?=[_.]|$)", name, re.ASCII)), None)
        problem = f"does not tell its {untold}" if untold else "has something that names of recordings do not have"
        raise Unusable(f"its name {problem}: {shown(name)}")
    base, flip = int(found["base"]), found["flip"]
    if base >= LAYOUTS:
        raise Unusable(f"its name gives the layout {base}, which does not exist")
    starts = [int(place) for place in found["starts"].split("_")]
    if max(starts) >= len(STARTS):
        raise Unusable(f"its name gives the place {max(starts)}, which does not exist")
    angles = re.findall(r"_AN([^_]*)(?:_([^_]*))?", name)
    if len(angles) > 1 or any(not is_angle(angle) for pair in angles for angle in pair):
        raise Unusable(f"its name gives start angles that are not two numbers from -2 pi to 2 pi: {shown(name)}")
    return {
        "base": base,
        "flip": None if flip is None else int(flip),
        "goals": [(kind, int(a), int(b), int(sign)) for kind, a, b, sign in GOAL_PARTS.findall(found["goals"])],
        "strength_levels": levels(found["strengths"], FORCES),
        "size_levels": levels(found["sizes"], RADII),
        "starts": starts,
        "angles": [float(angle) for angle in angles[0]] if angles else None,
        "steps": int(found["steps"]),
        "alphas": [float(alpha) for alpha in found["alphas"].split("_")],
    }


def is_angle(text):
    return re.fullmatch(NUMBER, text, re.ASCII) is not None and abs(float(text)) <= TURN


def levels(digits, table):
    result = [int(digit) for digit in digits.split("_")]
    if any(number >= len(table) for number in result):
        raise Unusable(f"its name has a level above {len(table) - 1}")
    return result


def swaps(code):
    """Whether agents and whether objects have exchanged colours. In older recordings the keys collide and three entries
    are left of four."""
    if type(code) is not dict or len(code) not in (3, 4):
        raise Unusable("`entity_color_code` must have three or four entries")
    code = {plain(key): plain(value) for key, value in code.items()}
    agent, item = code.get(0), code.get(3 if len(code) == 4 else 1)
    if type(agent) is not int or agent not in (0, 1) or type(item) is not int or item not in (2, 3):
        raise Unusable("`entity_color_code` must give agents the colours 0 and 1, and objects 2 and 3")
    return agent == 1, item == 3


def internal(pair, swapped):
    return pair[::-1] if swapped else pair


def internal_goal(goal, agents_swapped, objects_swapped):
    """A goal by colour as one by internal numbers. Landmarks of mirrored recordings are mirrored in the name."""
    kind, subject, target, sign = goal
    swap_agent = lambda agent: 1 - agent if agents_swapped else agent
    if subject >= AGENTS or target >= len(LANDMARKS):
        raise Unusable("a goal names an entity or landmark that does not exist")
    if kind == "LMO":
        return kind, 1 - subject if objects_swapped else subject, target, sign
    if kind == "LMA":
        return kind, swap_agent(subject), target, sign
    if target >= AGENTS:
        raise Unusable("a goal is to touch an object, which phase-events/1 does not know")
    if subject == target:
        raise Unusable("a goal is that an agent touches itself")
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


def mirror_angle(flip, is_agent, angle):
    # An object is a disc without a front, so only the sense in which it turns is mirrored.
    return [math.pi, 0.0, -math.pi / 2, math.pi / 2][flip] - angle if is_agent else -angle


def mirror_action(action):
    """A mirrored body goes left where the body goes right."""
    swapped = {"left": "right", "right": "left"}
    return re.sub("left|right", lambda found: swapped[found.group()], action)


def mirror_rows(rows, flip, is_agent):
    """Rows of the world as it was simulated, mirrored whole."""
    return [[*mirror_point(flip, x, y), *mirror_vector(flip, vx, vy), mirror_angle(flip, is_agent, angle)]
            for x, y, vx, vy, angle in rows]


def mend_mirrored(rows, flip, is_agent, angles):
    """Rows that were mirrored when they were recorded, made consistent."""
    if not is_agent:
        return [[x, y, *mirror_vector(flip, vx, vy), mirror_angle(flip, is_agent, angle)]
                for x, y, vx, vy, angle in rows]
    still = mirror_point(flip, 0.0, 0.0)
    turned = [row[4] for row in rows]
    if flip >= 2:
        turned = UNWRAP[angles](turned)
    return [[x, y, vx - still[0], vy - still[1], angle] for (x, y, vx, vy, _), angle in zip(rows, turned)]


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
USUAL_ANGLES = "one-way"


def add_angles_option(parser):
    parser.add_argument("--angles", choices=sorted(UNWRAP), default=USUAL_ANGLES,
                        help=f"how jumps in angles of diagonally mirrored agents are mended (default: {USUAL_ANGLES})")


def mean(rows):
    return [sum(column) / len(rows) for column in zip(*rows)]


def steps_from_substeps(rows):
    return [rows[0]] + [mean(rows[k:k + SUBSTEPS]) for k in range(1, len(rows) - SUBSTEPS + 1, SUBSTEPS)]


def is_mirrored(tracks, name, agents_swapped):
    """Whether the rows of a mirrored recording are mirrored already: the agents start where the name says, or at
    its mirror image. Where both are one place, agents that were mirrored have velocities of points."""
    flip = name["flip"]
    starts = [STARTS[place] for place in internal(name["starts"][:AGENTS], agents_swapped)]
    images = [mirror_point(flip, *start) for start in starts]
    off = lambda places, column: sum(math.dist(track[0][column:column + 2], place)
                                     for track, place in zip(tracks, places))
    if images != starts:
        return off(images, 0) <= off(starts, 0)
    return off([mirror_point(flip, 0.0, 0.0)] * AGENTS, 2) <= off([(0.0, 0.0)] * AGENTS, 2)


def trajectory_of(record, name, steps, agents_swapped, angles, published):
    """Tracks of the entities, and whether the record had them mirrored; `steps` is the number of actions, if there are
    any."""
    tables = required(record, "trajectories")
    if getattr(tables, "shape", None) is None and type(tables) not in (list, tuple) or len(tables) != ENTITIES:
        raise Unusable(f"`trajectories` must have {ENTITIES} entities")
    tracks = [table_rows(table) for table in tables]
    # Objects' rows run on after the agents' end.
    (rows, other), objects = ([len(track) for track in part] for part in (tracks[:AGENTS], tracks[AGENTS:]))
    if rows != other:
        raise Unusable(f"`trajectories` must have as many rows of one agent as of the other, not {rows} and {other}")
    if len(set(objects)) > 1 or objects[0] < rows:
        raise Unusable(f"`trajectories` must have as many rows of both objects, and at least the agents' {rows}, "
                       f"not {objects[0]} and {objects[1]}")
    angles_told = name["angles"] and internal(name["angles"], agents_swapped)
    if name["flip"] is None and angles_told:
        for track, angle in zip(tracks, angles_told):
            if abs(track[0][4] - angle) > ANGLE_ROUNDING:
                raise Unusable(f"its name lets an agent start at {angle} rad, its row 0 at {track[0][4]:.2f} rad")
    tracks = [track[:rows] for track in tracks]
    if steps and rows > steps + 1:
        if rows > SUBSTEPS * steps + 1 or (rows - 1) % SUBSTEPS:
            raise Unusable(f"`trajectories` must have at most a row for each of {steps} steps or of their substeps")
        tracks = [steps_from_substeps(track) for track in tracks]
    flip = name["flip"]
    mirrored = flip is not None and (published or is_mirrored(tracks, name, agents_swapped))
    if mirrored:
        tracks = [mend_mirrored(track, flip, k < AGENTS, angles) for k, track in enumerate(tracks)]
    elif flip is not None:
        tracks = [mirror_rows(track, flip, k < AGENTS) for k, track in enumerate(tracks)]
    rounded = [[[round(number * PARTS_OF_UNIT) / PARTS_OF_UNIT for number in row] for row in track] for track in tracks]
    return rounded, mirrored


def actions_by_step(record):
    """Pairs of names of actions by step, or nothing; they may be kept by agent or by step."""
    actions = plain(record.get("actions"))
    if actions is None or actions == []:
        return []
    if type(actions) is not list or any(type(row) is not list for row in actions):
        raise Unusable("`actions` must have a list for each agent, or for each step")
    # Two steps of two actions look the same either way; no recording is that short.
    if len(actions) == AGENTS:
        if len(actions[0]) != len(actions[1]):
            raise Unusable("`actions` must have as many actions of one agent as of the other")
        actions = [list(pair) for pair in zip(*actions)]
    if any(len(pair) != AGENTS for pair in actions):
        raise Unusable("`actions` must have one action of each agent for every step")
    return [[action_name(action) for action in pair] for pair in actions]


def action_name(action):
    if type(action) is str and action in ACTIONS:
        return action
    if type(action) is int and 0 <= action < len(ACTIONS):
        return ACTIONS[action]
    raise Unusable(f"`actions` has the action {shown(action)}, which does not exist")


# Records.

def is_catch(name):
    return re.sub(r"\.[A-Za-z0-9]{1,5}$", "", name).endswith(CATCH_ENDING)


def sizes_of(record):
    """Radii of the entities; the field has either of two names."""
    given = [numbers(record[key], ENTITIES, f"`{key}`")
             for key in ("entity_sizes", "sizes") if record.get(key) is not None]
    if not given:
        raise Unusable("`entity_sizes` is missing")
    if given[0] != given[-1]:
        raise Unusable("`sizes` and `entity_sizes` differ")
    return given[0]


def size_levels_of(record, name, agents_swapped, objects_swapped):
    """Levels of the record's sizes. Those of the name must be the same, which is how we notice a wrong order."""
    stored = [level(size, RADII, "size") for size in sizes_of(record)]
    named = internal(name["size_levels"][:AGENTS], agents_swapped) \
        + internal(name["size_levels"][AGENTS:], objects_swapped)
    if stored != named:
        raise Unusable("its name and its field of sizes differ")
    return stored


def strength_levels_of(record, name, agents_swapped):
    named = internal(name["strength_levels"], agents_swapped)
    if record.get("strengths") is None:
        return named
    given = numbers(record["strengths"], AGENTS, "`strengths`")
    stored = [level(strength * SUBSTEPS, FORCES, "force") for strength in given]
    if stored != named:
        raise Unusable("its name and `strengths` differ")
    return stored


def walls_of(record):
    walls = plain(record["wall_segs"])
    if type(walls) is not list or len(walls) > MOST_WALLS:
        raise Unusable(f"`wall_segs` must have at most {MOST_WALLS} walls")
    return [points(wall, 2, "a wall") for wall in walls]


def convert(record, name, event_id, angles, published=False):
    """A record as an event of a phase-events/1 file; `published` if it is known to be one of the published data set,
    whose mirrored recordings all have their rows mirrored."""
    name = parse_name(name)
    agents_swapped, objects_swapped = swaps(required(record, "entity_color_code"))
    sizes = size_levels_of(record, name, agents_swapped, objects_swapped)
    strengths = strength_levels_of(record, name, agents_swapped)
    goals, alpha = goals_and_alpha(name, agents_swapped, objects_swapped)
    kind, relation = kind_and_relation(goals, alpha)
    actions = actions_by_step(record)
    tracks, mirrored = trajectory_of(record, name, len(actions), agents_swapped, angles, published)
    agents = [{
        "radius": RADII[sizes[k]], "max_force": FORCES[strengths[k]],
        "strength_level": strengths[k], "size_level": sizes[k],
        "goal": goal_object(goals[k]), "alpha": alpha if k == 0 else 0,
    } for k in range(AGENTS)]
    event = {"id": event_id, "layout": {"base": name["base"], "flip": name["flip"]}}
    # Walls of a recording that is mirrored only here follow from its layout.
    if record.get("wall_segs") is not None and (mirrored or name["flip"] is None):
        event["walls"] = walls_of(record)
    if record.get("landmark_centers") is not None:
        centres = points(record["landmark_centers"], len(LANDMARKS), "`landmark_centers`")
        if any(math.dist(found, known) > LANDMARK_TOLERANCE for found, known in zip(centres, LANDMARKS)):
            raise Unusable("`landmark_centers` has other places than the four of every recording")
    if len(tracks[0]) - 1 > name["steps"]:
        raise Unusable(f"its name gives {name['steps']} steps, but `trajectories` has {len(tracks[0]) - 1}")
    event.update({
        "landmarks": LANDMARKS,
        "agents": agents,
        "objects": [{"radius": RADII[size], "size_level": size} for size in sizes[AGENTS:]],
        "event": kind, "relation": relation,
    })
    if record.get("social_goals") is not None:
        if text(record["social_goals"], "`social_goals`") not in RELATIONS:
            raise Unusable("`social_goals` must be friendly, neutral or adversarial")
        event["relation_human"] = record["social_goals"]
    event.update({
        "step_seconds": 0.25,
        # Mirrored recordings were replayed, and their first row was kept after the first substep.
        "row_0": "after 1/60 s" if mirrored else "initial state",
        "recorded_steps": name["steps"],
        "trajectory": {"columns": COLUMNS, "agents": tracks[:AGENTS], "objects": tracks[AGENTS:]},
    })
    if actions:
        known = actions[:len(tracks[0]) - 1]
        if name["flip"] is not None:
            known = [[mirror_action(action) for action in pair] for pair in known]
        event["recovered_actions"] = {"steps": known, "note": "recorded"}
    return event


def converted(record, name, event_id, angles, what, published=False):
    """`convert`, whose errors begin with `what`, such as `record 3`."""
    if type(record) is not dict:
        raise Unusable(f"{what}: is no dictionary")
    try:
        return convert(record, name, event_id, angles, published)
    except Unusable as error:
        raise Unusable(f"{what}: {error}") from error
    except MALFORMED as error:
        raise Unusable(f"{what}: a field is missing or malformed ({shown(repr(error))})") from error
