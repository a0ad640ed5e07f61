"""The command line from within Python: datasets and evaluations."""

import contextlib
import json
import os
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path

from . import _native
from ._check import choice, path_of, seed_of, text, to_json, whole
from ._native import MOST_EVENTS, MOST_THREADS, PhaseError
from .events import save_events
from .perception import methods

SPLITS = ("train", "validation", "test")
"""The parts of a dataset."""
MEASURES = {
    "phase-eval-goals/1": {"goal": ("goal", "top1"), "relation": ("relation", "accuracy")},
    "phase-eval-trajectories/1": {"ade": ("ade", "all"), "fde": ("fde", "all")},
}
"""The measures by which methods are compared, and where results of each format have them."""


def run(*arguments):
    """Runs a command of the program ``phase``. Progress goes to stderr, results to stdout.

    >>> run("verify", "out/demo-seed1")   # doctest: +SKIP

    Args:
        arguments: the command and its options, each as text, a number or a path.

    Raises:
        PhaseError: if the command fails, with the sentence of the command line; its attribute ``exit_code`` is that of the program.
        KeyboardInterrupt: after the current step; what is finished is kept, and the same command goes on.
    """
    _run(arguments, silent=False)


def _run(arguments, silent):
    """Runs a command, with its results on stdout or without them."""
    _native.run([path_of(one) if isinstance(one, (bytes, os.PathLike)) else str(one) for one in arguments], silent)


def generate(preset="demo", events=None, out=None, *, shard=None, seed=None, video=True, jobs=None, quiet=True, options=()):
    """Generates a dataset in a folder, as ``phase gen-dataset`` does.

    >>> generate("demo", 6, "out/demo", video=False)   # doctest: +SKIP

    One preset, seed and number of events make the same bytes on every machine, with any number of jobs and shards.

    Args:
        preset: ``demo``, ``phase-500``, ``phase-pairs``, ``phase-training``, or a file in the format ``phase-preset/3``.
        events: the number of events, at least 1; ``None`` for the preset's.
        out: the folder of the dataset. It is made; an interrupted run in it goes on.
        shard: ``(k, n)`` for the k-th of n parts, from 1, to be combined by ``run("merge", …)``.
        seed: a whole number from 0 to 2**64 - 1; ``None`` for the preset's.
        video: whether to write videos and the page.
        jobs: the number of events that are simulated at once; ``None`` for one a core.
        quiet: whether to print neither progress nor results.
        options: further options of the command line, such as ``["--particles", "50"]``.

    Returns:
        the folder, a ``pathlib.Path``.

    Raises:
        PhaseError: for an invalid argument, and if files cannot be written, with the sentence of the command line.
        KeyboardInterrupt: what is finished is kept.
    """
    if out is None:
        raise PhaseError("out: a folder for the dataset is needed")
    arguments = ["gen-dataset", f"--preset={path_of(preset)}", f"--out={path_of(out)}"]
    if events is not None:
        arguments.append(f"--events={whole('events', events, 1, MOST_EVENTS)}")
    if seed is not None:
        arguments.append(f"--seed={seed_of(seed)}")
    if shard is not None:
        if not isinstance(shard, (tuple, list)) or len(shard) != 2:
            raise PhaseError(f"shard is (k, n), the k-th of n parts, not {shard!r}")
        parts = whole("n of shard", shard[1], 1, 2**32 - 1)
        arguments.append(f"--shard={whole('k of shard', shard[0], 1, parts)}/{parts}")
    if not video:
        arguments.append("--no-video")
    if jobs is not None:
        arguments.append(f"--jobs={whole('jobs', jobs, 1, MOST_THREADS)}")
    if quiet:
        arguments.append("--quiet")
    if not isinstance(options, (tuple, list)):
        raise PhaseError(f"options is a list of options and their values, not {options!r}")
    with _pythons_words(("preset", "events", "out", "shard", "seed", "jobs")):
        _run([*arguments, *options], silent=quiet)
    return Path(os.fsdecode(out))


def evaluate(
    predictions,
    events,
    *,
    task="goals",
    split=None,
    ratings=None,
    seed=1,
    name="predictions",
    out=None,
    compare=(),
    jobs=None,
    quiet=True,
):
    """Scores answers with the metrics of the benchmark (docs/how-to/benchmark.md), and compares them with others'.

    >>> answers = {event.id: infer(event) for event in events}                     # doctest: +SKIP
    >>> found = evaluate(answers, events, compare=["intent-network", "chance"])    # doctest: +SKIP
    >>> found["goal"]["top1"], found["comparison"][1]["difference"]                # doctest: +SKIP

    Args:
        predictions: a dict from ids of events to answers: for ``goals`` as :func:`infer` and :func:`answer` give them, for
            ``trajectories`` as :func:`forecast` does; or the name of one of PHASE's :func:`methods`, which is asked then.
        events: the path of a file or a dataset, or a list of events.
        task: ``goals`` or ``trajectories``.
        split: ``train``, ``validation`` or ``test`` of a dataset; ``None`` for all of its events.
        ratings: a file in the format ``phase-ratings/1``, to compare the answers with people's; of ``goals`` only.
        seed: a whole number from 0 to 2**64 - 1, for the random draws of the intervals and of a method.
        name: the name of the predictions in the report.
        out: a folder that keeps results and report; ``None`` keeps nothing.
        compare: others on the same events: a list of names of methods, or a dict from names to what ``predictions`` may be, or to the
            document of an earlier evaluation.
        jobs: the number of events that a method is asked about at once; ``None`` for one a core.
        quiet: whether to print neither progress (on stderr) nor the table of scores (on stdout).

    Returns:
        the document ``phase-eval-goals/1`` or ``phase-eval-trajectories/1`` as a dict (docs/reference/formats/evaluation.md): ``goal``,
        ``relation``, ``roles``, ``calibration``, … or ``ade``, ``fde``, …, and every answer in ``events``. With ``compare`` also
        ``comparison``, a list of rows, one for the predictions and one for each of the others: ``method``, the estimates (``value``,
        ``low``, ``high``) ``goal`` and ``relation``, or ``ade`` and ``fde``, and in ``difference`` the same of the predictions' scores less
        the other's, whose intervals are those of a paired bootstrap over events (``None`` in the first row).

    Raises:
        PhaseError: if events have no answer (it says which), an answer is invalid, or a file cannot be read.
    """
    choice("task", task, tuple(methods()))
    others = _others(compare)
    with tempfile.TemporaryDirectory() as folder, _pythons_words(("events", "out", "seed", "split", "ratings", "jobs"), folder):
        folder = Path(folder)
        if isinstance(events, (str, bytes, os.PathLike)):
            events = path_of(events)
        else:
            # What a file is called here is not what a caller calls anything.
            file = folder / "events.json"
            save_events(events, file)
            events = os.fspath(file)
        options = [f"--events={events}", f"--seed={seed_of(seed)}"]
        if quiet:
            options.append("--quiet")
        if split is not None:
            options.append(f"--split={choice('split', split, SPLITS)}")
        if ratings is not None:
            if task != "goals":
                raise PhaseError("ratings are of relations, which only the task goals is about")
            options.append(f"--ratings={path_of(ratings)}")
        if jobs is not None:
            options.append(f"--jobs={whole('jobs', jobs, 1, MOST_THREADS)}")

        def score(given, name, argument, kept):
            """The results of a method or of answers."""
            arguments = ["eval", task, f"--out={kept}", *options]
            if isinstance(given, str):
                arguments.append(f"--method={choice(argument, given, methods()[task])}")
            else:
                file = folder / f"{argument}.json"
                _native.write_text(os.fspath(file), _document(given, name, argument))
                arguments.append(f"--predictions={file}")
            _run(arguments, silent=quiet)
            return json.loads((kept / "results.json").read_text(encoding="utf-8"))

        results = score(predictions, text("name", name), "predictions", Path(path_of(out)) if out is not None else folder / "results")
        if others:
            rows = [_row(predictions if isinstance(predictions, str) else name, results, None)]
            for k, (other, given) in enumerate(others.items()):
                document = given
                if not (isinstance(given, Mapping) and "format" in given):
                    document = score(given, other, "compare", folder / f"other{k}")
                difference = _native.compare(task, json.dumps(results), to_json("compare", document), seed_of(seed))
                rows.append(_row(other, document, json.loads(difference)))
            results["comparison"] = rows
        return results


def submit(predictions, events, *, name, by, source, out="out/submission", sealed=None, questions=None):
    """Checks and scores answers for the leaderboard, and writes the files of a pull request (docs/how-to/method.md).

    >>> answers = {event.id: infer(event) for event in load_events("out/phase-500-seed1")}      # doctest: +SKIP
    >>> done = submit(answers, "out/phase-500-seed1", name="mine", by="N. N.", source="https://example.org")   # doctest: +SKIP
    >>> done["files"]                                                                           # doctest: +SKIP

    Args:
        predictions: a dict as of :func:`evaluate`, whose answers may be to both tasks at once; or the path of a file of predictions.
        events: the folder of PHASE-500 (its test events are scored) or of phase-pairs, or the file of the recordings.
        name: the name of the method: letters, digits, ``-``, ``_`` and ``.``.
        by: the authors.
        source: the address of the code, or of a description.
        out: a checkout of PHASE, or another folder, in which the files are made. Those of an earlier submission in it are kept.
        sealed: the folder that ``phase seal`` published, if the answers are to its events; ``events``
            is then the folder that was sealed.
        questions: the folder of the questions, if they were sealed, too.

    Returns:
        a dict: ``scores``, one for each task, as in ``phase-leaderboard/1``; ``files``, the paths to be committed; ``same_events``, whether
        the events are, byte for byte, those that the other scores of the leaderboard are of.

    Raises:
        PhaseError: if the events are none of the leaderboard's (it says which these are), they are
            not what was sealed, an event has no answer or an invalid one, or a name is invalid. Nothing is
            written then.
    """
    if questions is not None and sealed is None:
        raise PhaseError("questions are of a sealed dataset: sealed must be given, too")
    events, out = path_of(events), path_of(out)
    sealed, questions = (given if given is None else path_of(given) for given in (sealed, questions))
    name, by, source = text("name", name), text("by", by), text("source", source)
    with tempfile.TemporaryDirectory() as folder, _pythons_words((), folder):
        file = Path(folder) / "predictions.json"
        if isinstance(predictions, (str, bytes, os.PathLike)):
            file = path_of(predictions)
        else:
            _native.write_text(os.fspath(file), _document(predictions, name, "predictions"))
        return json.loads(_native.submit(os.fspath(file), events, name, by, source, out, sealed, questions))


def _others(compare):
    """What is compared, by name."""
    if isinstance(compare, Mapping):
        return {text("a name in compare", name): given for name, given in compare.items()}
    if isinstance(compare, (str, bytes)) or not hasattr(compare, "__iter__"):
        raise PhaseError(f"compare is a list of names of methods, or a dict, not {compare!r}")
    return {text("a name in compare", name): name for name in compare}


def _row(name, results, difference):
    """A row of a comparison: the scores of results, as estimates."""
    members = MEASURES[results["format"]]
    row = {"method": name}
    for measure, (group, member) in members.items():
        low, high = results["intervals"][group][member]
        row[measure] = {"value": results[group][member], "low": low, "high": high}
    return row | {"difference": difference}


@contextlib.contextmanager
def _pythons_words(arguments, folder=None):
    """Errors of the command line in the words of a function: its arguments are not options, and files of its own have no names."""
    try:
        yield
    except PhaseError as error:
        sentence = re.sub(r"--(\w+)", lambda option: option[1] if option[1] in arguments else option[0], str(error))
        if folder is not None:
            sentence = re.sub(re.escape(f"{folder}{os.sep}") + r"(\w+)\.json", r"\1", sentence)
        if sentence == str(error):
            raise
        mended = PhaseError(sentence)
        mended.__dict__.update(error.__dict__)
        raise mended from None


def _document(predictions, name, argument):
    """Predictions as the command line reads them."""
    if not isinstance(predictions, Mapping):
        raise PhaseError(f"{argument}: answers are a dict from ids to answers, or the name of a method, not {type(predictions).__name__}")
    wrong = next((id for id, answer in predictions.items() if not isinstance(answer, Mapping)), None)
    if wrong is not None:
        raise PhaseError(f"{argument}: the answer for {wrong!r} is a dict, not {type(predictions[wrong]).__name__}")
    events = [dict(answer, id=id) for id, answer in predictions.items()]
    return to_json(argument, {"method": name, "events": events})
