#!/usr/bin/env python3
"""Turns the published PHASE test recordings into a phase-events/1 file, and the raters' sheets into phase-ratings/1.

    python3 data/import_socialgnn.py Videos_Test_humanratings recordings.json
    python3 data/import_socialgnn.py Videos_Test_humanratings recordings.json \\
        --raters responses_genset --ratings ratings.json
    python3 data/import_socialgnn.py Videos_humanratings recordings.json --set main \\
        --counted human_rating_labels_all --ratings ratings.json \\
        --predictions Outputs/Predictions/*_SocialGNN_E --predicted socialgnn.json

    python3 data/import_socialgnn.py Videos_Test_humanratings recordings.json \\
        --posterior Outputs/Activations/SIMPLE_probabilities_test --table published-simple.csv

All inputs are in the repository Isik-lab/SocialGNN (MIT licence): the files PHASE/Videos_Test_humanratings and
PHASE/Videos_humanratings; in PHASE/Human_Experiment_Files the raters' sheets (responses_genset, responses) and the
answers counted (human_rating_labels_all_genset, human_rating_labels_all); what networks answered, in the folder
Outputs/Predictions; and the posteriors of the published SIMPLE, in Outputs/Activations. docs/reference/formats/overview.md
describes the results. Python 3.9 or later and numpy are needed.

What is read. The file is a pickle: a list whose entry k becomes the event `phase-test-k`, or with `--set main`, for the
400 other recordings (PHASE/Videos_humanratings), `phase-main-k`; empty entries and catch trials (names that end in `_mm`)
are skipped.
An entry is a record with its `name`; recordings.py beside this file says what names and records mean, and what is mended.
The pickle has no actions.
Counted answers are a table of pandas, which is read without pandas: a count for each relation by the names of videos.
A file of a network's answers has two pickles: the right relations by the names of videos, which are not read, and a
network's. Each file counts as one rater of phase-ratings/1. A posterior begins with a pickle of pairs, a relation and its probability, by
the names of videos; it becomes a table for `rdm`, CSV with a row an event.

The pickle is read in a process of its own, with limits on memory and time; only numpy arrays and plain data are
admitted.
"""

import argparse
import os
import re
import sys

from importer import (Failure, Unusable, answer, ask, column_of, content_of, contents_of, import_numpy, is_reading, main_of,
                      open_regular, read_json, save, save_text, shown, tell)
from recordings import RELATIONS, add_angles_option, converted, is_catch, text

# The published file has 100 entries of at most 101 rows and 1.5 MB.
LARGEST_FILE_BYTES = 64 << 20
MOST_ENTRIES = 1000

LARGEST_SHEET_BYTES = 1 << 20
MOST_RATERS = 1000
ANSWERS_PER_SHEET = 23
# The date, time and place in a set, with which the name of a recording begins.
DISTINCT_CHARACTERS = 23
# Catch trials of each set by layout, and the only right answer to each.
CATCH_TRIALS = {
    "test": {"4": "adversarial", "12": "friendly", "0": "neutral"},
    "main": {"12.1": "adversarial", "13.2": "friendly", "4": "neutral"},
}


# Reading.

def whole(path):
    if import_numpy() is None:
        raise Failure("numpy is needed to read the recordings")
    return content_of(path, LARGEST_FILE_BYTES)


def entries_of(path):
    content = whole(path)
    if type(content) is not list or not 0 < len(content) <= MOST_ENTRIES:
        raise Unusable(f"must hold a list of 1 to {MOST_ENTRIES} entries")
    return content


def converted_entries(path, angles, which):
    """What the reading process has to tell: events, their ids by the names of videos, and the numbers of entries and of
    catch trials among them."""
    content = entries_of(path)
    events, names, catch = [], {}, 0
    for k, entry in enumerate(content):
        if entry is None:
            continue
        event_id = f"phase-{which}-{k:03d}"
        if type(entry) is not dict:
            raise Unusable(f"entry {k}: is no dictionary")
        name = text(entry.get("name"), f"entry {k}: `name`")
        if is_catch(name):
            catch += 1
            continue
        event = converted(entry, name, event_id, angles, f"entry {k}", published=True)
        names.setdefault(name, []).append(event_id)
        events.append(event)
    return {"events": events, "names": names, "entries": len(content), "catch": catch}


def predictions_of(path):
    """What a network answered, by the names of videos."""
    _, answers = contents_of(path, LARGEST_SHEET_BYTES, 2)
    if type(answers) is not dict or not 0 < len(answers) <= MOST_ENTRIES:
        raise Unusable(f"must hold answers to 1 to {MOST_ENTRIES} videos in its second pickle")
    for name, relation in answers.items():
        if text(relation, "an answer") not in RELATIONS:
            raise Unusable(f"must hold the relations {', '.join(RELATIONS)}, not {shown(relation)}")
        text(name, "the name of a video")
    return answers


def counts_of(path):
    """How many people gave each answer, by the names of videos."""
    table = whole(path)
    counted = column_of(table, "videos", "relationship", dict)
    result = {}
    for name, counts in counted:
        name = text(name, "the name of a video")
        if name in result:
            raise Unusable(f"has the video {shown(name)} twice")
        known = all(relation in RELATIONS and type(count) is int and 0 <= count <= MOST_RATERS
                    for relation, count in counts.items())
        if not known:
            raise Unusable(f"video {shown(name)}: must count {', '.join(RELATIONS)}, each 0 to {MOST_RATERS}, "
                           f"not {shown(dict(counts))}")
        result[name] = {relation: counts.get(relation, 0) for relation in RELATIONS}
    return result


def read_counted(path, names):
    """A phase-ratings/1 file's content, and a word about it."""
    counts = {}
    for video, given in ask(__file__, path, "counts").items():
        for event_id in names.get(video, []):
            counts[event_id] = given
    if not counts:
        raise Unusable(f"{path}: has no answers about these recordings")
    return {"format": "phase-ratings/1", "ratings": {name: counts[name] for name in sorted(counts)}}, "as counted"


def posterior_of(path):
    """The probabilities of relations, by the names of videos."""
    content = content_of(path, LARGEST_FILE_BYTES)
    if type(content) is not dict or not 0 < len(content) <= MOST_ENTRIES:
        raise Unusable(f"must begin with the relations of 1 to {MOST_ENTRIES} videos")
    result = {}
    for name, pairs in content.items():
        name = os.path.basename(text(name, "the name of a video"))
        sound = type(pairs) in (list, tuple) and all(type(pair) in (list, tuple) and len(pair) == 2 for pair in pairs)
        given = {text(relation, "a relation"): float(p) for relation, p in pairs} if sound else {}
        # Rounded ones may not add up.
        if not sound or len(given) < len(pairs) or not set(given) <= set(RELATIONS) or abs(sum(given.values()) - 1) > 0.01:
            raise Unusable(f"video {shown(name)}: must have probabilities of {', '.join(RELATIONS)} that add up to 1")
        result[name] = given
    return result


def posterior_table(path, names):
    """The lines of a table of probabilities, a row an event."""
    # The clips of later studies have other endings.
    begun = {}
    for name, ids in names.items():
        # Where a beginning is that of two recordings, it names neither.
        begun[name[:DISTINCT_CHARACTERS]] = [] if name[:DISTINCT_CHARACTERS] in begun else ids
    rows = {}
    for video, given in ask(__file__, path, "posterior").items():
        for event_id in names.get(video, begun.get(video[:DISTINCT_CHARACTERS], [])):
            rows[event_id] = [f"{given.get(relation, 0.0):.6f}" for relation in RELATIONS]
    if not rows:
        raise Unusable(f"{path}: has no answers about these recordings")
    head = ["id", *(f"relation_{relation}" for relation in RELATIONS)]
    return "".join(",".join(row) + "\n" for row in [head, *([event_id, *rows[event_id]] for event_id in sorted(rows))]), len(rows)


def count_predictions(paths, names):
    """A phase-ratings/1 file's content, in which each file is a rater."""
    counts = {}
    for path in paths:
        known = 0
        for video, relation in ask(__file__, path, "predictions").items():
            for event_id in names.get(video, []):
                counts.setdefault(event_id, dict.fromkeys(RELATIONS, 0))[relation] += 1
                known += 1
        if not known:
            raise Unusable(f"{path}: has no answers about these recordings")
    return {"format": "phase-ratings/1", "ratings": {name: counts[name] for name in sorted(counts)}}


# Raters.

def answer_of(line, where):
    """A line of a sheet as a dictionary, empty where the line has no answer."""
    try:
        fields = read_json(line)
    except Unusable as error:
        raise Unusable(f"{where} {error}") from error
    is_pair = lambda field: type(field) is list and len(field) == 2 and type(field[0]) is str
    if type(fields) is not list or not all(is_pair(field) for field in fields):
        raise Unusable(f"{where} is no list of names and values")
    result = dict(fields)
    if len(result) < len(fields):
        raise Unusable(f"{where} gives a name twice")
    return result


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


def is_complete(answers, which):
    """Whether a sheet has all answers, each to a video and one of the three. `[]` stands in sheets about the test set
    for a recording that is not in the file."""
    if len(answers) != ANSWERS_PER_SHEET or which == "main" and not all(answers):
        return False
    given = [answer for answer in answers if answer]
    return all(type(video) is str and said in RELATIONS for video, said in given) \
        and set(catch_answers(given)) == set(CATCH_TRIALS[which])


def catch_answers(given):
    """What a rater said of the catch trials, by layout."""
    result = {}
    for video, said in given:
        layout = re.search(r"_E(\d{1,2}(\.\d)?)_", video, re.ASCII)
        if layout and is_catch(video):
            result[layout[1]] = said
    return result


def count_ratings(folder, names, which):
    """A phase-ratings/1 file's content, and what became of the sheets."""
    try:
        sheets = sorted(entry for entry in os.listdir(folder) if not entry.startswith("."))
    except OSError as error:
        raise Unusable(f"{folder}: cannot be read: {error.strerror}") from error
    counts, used, incomplete, failed = {}, 0, 0, 0
    for sheet in sheets:
        answers = read_sheet(os.path.join(folder, sheet))
        if not is_complete(answers, which):
            incomplete += 1
            continue
        given = [answer for answer in answers if answer]
        if catch_answers(given) != CATCH_TRIALS[which]:
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
    return ratings, f"by {used} raters ({incomplete} sheets are incomplete, {failed} failed a catch trial)"


# The program.

def run(arguments):
    files = [arguments.file, arguments.out, *arguments.predictions]
    others = (arguments.counted, arguments.ratings, arguments.predicted, arguments.posterior, arguments.table)
    files += [path for path in others if path]
    if len({os.path.realpath(path) for path in files}) < len(files):
        raise Unusable("the files to read and to write must be different")
    recordings = ask(__file__, arguments.file, "recordings", arguments.angles, arguments.set)
    events = recordings["events"]
    if not events:
        raise Unusable(f"{arguments.file}: all entries are empty")
    ratings = None
    if arguments.raters:
        ratings, raters = count_ratings(arguments.raters, recordings["names"], arguments.set)
    elif arguments.counted:
        ratings, raters = read_counted(arguments.counted, recordings["names"])
    predicted = count_predictions(arguments.predictions, recordings["names"]) if arguments.predictions else None
    posterior = posterior_table(arguments.posterior, recordings["names"]) if arguments.posterior else None
    save({"format": "phase-events/1", "events": events}, arguments.out)
    catch = recordings["catch"]
    empty = recordings["entries"] - len(events) - catch
    left = [f"{what}: {count}" for what, count in (("empty entries", empty), ("catch trials", catch)) if count]
    tell(f"{len(events)} events in {arguments.out}" + (f" ({', '.join(left)})" if left else ""))
    if ratings:
        save(ratings, arguments.ratings)
        tell(f"ratings of {len(ratings['ratings'])} events in {arguments.ratings}, {raters}")
    if posterior:
        save_text(posterior[0], arguments.table)
        tell(f"probabilities of {posterior[1]} events in {arguments.table}")
    if predicted:
        save(predicted, arguments.predicted)
        tell(f"{len(arguments.predictions)} files of answers to {len(predicted['ratings'])} events in {arguments.predicted}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", metavar="FILE", help="the recordings (PHASE/Videos_Test_humanratings)")
    parser.add_argument("out", metavar="EVENTS", help="the phase-events/1 file to write")
    people = parser.add_mutually_exclusive_group()
    people.add_argument("--raters", metavar="FOLDER", help="the raters' sheets (responses_genset, responses)")
    people.add_argument("--counted", metavar="FILE",
                        help="the raters' answers as counted (human_rating_labels_all_genset, human_rating_labels_all)")
    parser.add_argument("--ratings", metavar="FILE", help="the phase-ratings/1 file to write")
    parser.add_argument("--set", choices=["test", "main"], default="test",
                        help="the recordings of the test set, or the 400 others (PHASE/Videos_humanratings)")
    parser.add_argument("--predictions", metavar="FILE", nargs="+", default=[], help="networks' answers (Outputs/Predictions)")
    parser.add_argument("--predicted", metavar="FILE", help="the phase-ratings/1 file to write of them")
    parser.add_argument("--posterior", metavar="FILE",
                        help="the published SIMPLE's (Outputs/Activations/SIMPLE_probabilities_test)")
    parser.add_argument("--table", metavar="FILE", help="the CSV file to write of it")
    add_angles_option(parser)
    arguments = parser.parse_args()
    if bool(arguments.raters or arguments.counted) != bool(arguments.ratings):
        parser.error("--raters or --counted, and --ratings, go together")
    if bool(arguments.predictions) != bool(arguments.predicted):
        parser.error("--predictions and --predicted go together")
    if bool(arguments.posterior) != bool(arguments.table):
        parser.error("--posterior and --table go together")
    main_of(run, arguments)


if __name__ == "__main__":
    if is_reading(sys.argv):
        path, what, *options = sys.argv[2:]
        convert = {"recordings": converted_entries, "predictions": predictions_of, "counts": counts_of, "posterior": posterior_of}
        answer(convert[what], path, *options)
    else:
        main()
