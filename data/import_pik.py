#!/usr/bin/env python3
"""Turns recordings of the published PHASE simulator (.pik) into a phase-events/1 file.

    python3 data/import_pik.py recordings.pik [more.pik ...] --out events.json
    python3 data/import_pik.py --self-test [--out events.json]

The result is what `cargo xtask simulate`, `render` and `check-physics` read; docs/reference/formats/events.md describes it.
Python 3.9 or later is enough; numpy is needed only if the recordings hold numpy arrays.

A file holds one record, a list of records, or records by name. The name of a record is in `name`, `video_name` or
`file_name`, is its key, or is that of the file. recordings.py beside this file says what names and records mean, and what
is mended.
"""

import argparse
import io
import math
import os
import pickle
import re
import sys

from importer import Unusable, answer, ask, content_of, is_reading, load, main_of, save, tell
from recordings import (STARTS, USUAL_ANGLES, add_angles_option, convert, converted, internal_goal, is_catch,
                        kind_and_relation, mirror_angle, mirror_point, mirror_rows, parse_name, steps_from_substeps, swaps)

# The largest file that is read (bytes); the published recordings have less than a megabyte each.
LARGEST_FILE_BYTES = 256 << 20


def records_of(content, stem):
    """Records with their names."""
    def named(record, default):
        given = [record[key] for key in ("name", "video_name", "file_name") if record.get(key) is not None]
        if any(type(name) is not str or name != given[0] for name in given):
            raise Unusable("a record has a name that is no text, or several that differ")
        return given[0] if given else default, record
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


def convert_file(path, angles):
    """The events of a file, and how many catch trials it has; runs in the reading process."""
    stem = re.sub(r"\.\w+$", "", re.split(r"[/\\]", path)[-1])
    records = records_of(content_of(path, LARGEST_FILE_BYTES), stem)
    events, catch = [], 0
    short = re.sub(r"[^A-Za-z0-9]+", "-", stem).strip("-")[:60] or "recording"
    for k, (name, record) in enumerate(records):
        if is_catch(name):
            catch += 1
            continue
        event_id = short if len(records) == 1 else f"{short}-{k:04d}"
        events.append(converted(record, name, event_id, angles, f"record {k}"))
    return {"events": events, "catch": catch}


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
        return {"trajectories": substeps}, [mirror_rows(track, flip, k < 2) for k, track in enumerate(truth)]
    stored = []
    for k, track in enumerate(substeps):
        rows = []
        for x, y, vx, vy, angle in track:
            if k < 2:
                seen = mirror_angle(flip, True, angle)
                if flip >= 2:
                    seen = -((-seen) % (2 * math.pi))
                rows.append([*mirror_point(flip, x, y), *mirror_point(flip, vx, vy), seen])
            else:
                rows.append([*mirror_point(flip, x, y), vx, vy, angle])
        stored.append(steps_from_substeps(rows))
    # The published objects' rows run on after the agents' end.
    stored = stored[:2] + [track + track[-1:] * 3 for track in stored[2:]]
    return {"trajectories": stored}, [mirror_rows(track, flip, k < 2) for k, track in enumerate(truth)]


def self_test(out):
    name = "D010121_1021040_0_0_0_F8_E{}_GLMO_0_2_1_LMO_0_2_1_ST0_2_SZ1_0_2_3_P1_5_2_4_A0_0_C0_0_AN0.3_0.0_MCTS_L100" \
           "_R{}_PL1_EL1_0_0_s1000_r10_cI1.25_cB1000_e3"
    events = []
    # Written with a decimal point or without, the attitudes are the same.
    for flip, alphas in ((None, "0_10"), (0, "0.0_10.0"), (1, "0_10"), (2, "0.0_10.0"), (3, "0_10.5")):
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
            event = convert(load(stream), name.format(layout, alphas), event_id, USUAL_ANGLES)
            tracks = event["trajectory"]["agents"] + event["trajectory"]["objects"]
            assert [len(track) for track in tracks] == [7] * 4, event_id
            for k, (track, expected) in enumerate(zip(tracks, truth)):
                for t, (found, wanted) in enumerate(zip(track, expected)):
                    turn = round((found[4] - wanted[4]) / (2 * math.pi)) * 2 * math.pi
                    wanted = [*wanted[:4], wanted[4] + turn]
                    assert all(abs(a - b) < 1e-5 for a, b in zip(found[:4], wanted)), (event_id, k, t)
                    assert abs(found[4] - wanted[4]) < 1e-5, (event_id, k, t, found, wanted)
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
    told = parse_name(name.replace("GLMO_0_2_1_LMO_0_2_1", "G['LMA', 0, 3, -1]_['TE', 1, 0, 1]").format(4, "0.0_-10.0"))
    assert told["goals"] == [("LMA", 0, 3, -1), ("TE", 1, 0, 1)] and told["alphas"] == [0.0, -10.0]
    for bad in (pickle.dumps(print), b"", b"no pickle", pickle.dumps({"trajectories": []})[:-4]):
        try:
            load(io.BytesIO(bad))
        except Exception:
            continue
        raise AssertionError(f"{bad!r} was loaded")
    if out:
        write(events, out)
    tell(f"self-test passed: {len(events)} made-up recordings")


def run(arguments):
    if os.path.realpath(arguments.out) in map(os.path.realpath, arguments.files):
        raise Unusable(f"{arguments.out}: the files to read and to write must be different")
    read = [ask(__file__, path, arguments.angles) for path in arguments.files]
    events = [event for file in read for event in file["events"]]
    catch = sum(file["catch"] for file in read)
    if not events:
        raise Unusable("there are no records but catch trials in these files" if catch else "there are no records in these files")
    write(events, arguments.out)
    tell(f"{len(events)} events in {arguments.out}" + (f" ({catch} catch trials left out)" if catch else ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", metavar="FILE", help="recordings (.pik)")
    parser.add_argument("--out", metavar="FILE", help="the phase-events/1 file to write")
    parser.add_argument("--self-test", action="store_true", help="convert made-up recordings and check the result")
    add_angles_option(parser)
    arguments = parser.parse_args()
    if arguments.self_test:
        return main_of(self_test, arguments.out)
    if not arguments.files or not arguments.out:
        parser.error("give recordings and --out, or --self-test")
    main_of(run, arguments)


if __name__ == "__main__":
    if is_reading(sys.argv):
        answer(convert_file, *sys.argv[2:])
    else:
        main()
