"""The command line from within Python: datasets and evaluations."""

import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

from . import _native
from ._check import choice, path_of, seed_of, text, to_json, whole
from ._native import PhaseError
from .events import save_events
from .perception import methods

MOST_JOBS = 1024
"""The greatest number of events that are worked on at once."""


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
        arguments.append(f"--events={whole('events', events, 1, 2**32 - 1)}")
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
        arguments.append(f"--jobs={whole('jobs', jobs, 1, MOST_JOBS)}")
    if quiet:
        arguments.append("--quiet")
    if not isinstance(options, (tuple, list)):
        raise PhaseError(f"options is a list of options and their values, not {options!r}")
    _run([*arguments, *options], silent=quiet)
    return Path(os.fsdecode(out))


def evaluate(predictions, events, *, task="goals", split=None, ratings=None, seed=1, name="predictions", out=None):
    """Scores answers with the metrics of the benchmark (docs/how-to/benchmark.md).

    >>> answers = {event.id: infer(event) for event in events}   # doctest: +SKIP
    >>> evaluate(answers, events)["goal"]["top1"]                # doctest: +SKIP

    Args:
        predictions: a dict from ids of events to answers: for ``goals`` as :func:`infer` gives them, for ``trajectories`` as
            :func:`forecast` does; or the name of one of PHASE's methods, which is asked then.
        events: the path of a file or a dataset, or a list of events.
        task: ``goals`` or ``trajectories``.
        split: ``train``, ``validation`` or ``test`` of a dataset; ``None`` for all of its events.
        ratings: a file in the format ``phase-ratings/1``, to compare the answers with people's.
        seed: a whole number from 0 to 2**64 - 1, for the random draws of the intervals and of a method.
        name: the name of the predictions in the report.
        out: a folder that keeps results and report; ``None`` keeps nothing.

    Returns:
        the document ``phase-eval-goals/1`` or ``phase-eval-trajectories/1`` as a dict (docs/reference/formats/evaluation.md): ``goal``, ``relation``,
        ``roles``, ``calibration``, … or ``agents``, ``entities``, …, and every answer in ``events``.

    Raises:
        PhaseError: if an event has no answer, an answer is invalid, or a file cannot be read.
    """
    choice("task", task, tuple(methods()))
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        if isinstance(events, (str, bytes, os.PathLike)):
            events = path_of(events)
        else:
            # What a file is called here is not what a caller calls anything.
            file = folder / "events.json"
            save_events(events, file)
            events = os.fspath(file)
        kept = Path(path_of(out)) if out is not None else folder / "results"
        arguments = ["eval", task, f"--events={events}", f"--out={kept}", f"--seed={seed_of(seed)}", "--quiet"]
        if isinstance(predictions, str):
            arguments.append(f"--method={text('predictions', predictions)}")
        else:
            file = folder / "predictions.json"
            _native.write_text(os.fspath(file), _document(predictions, text("name", name)))
            arguments.append(f"--predictions={file}")
        if split is not None:
            arguments.append(f"--split={text('split', split)}")
        if ratings is not None:
            arguments.append(f"--ratings={path_of(ratings)}")
        _run(arguments, silent=True)
        return json.loads((kept / "results.json").read_text(encoding="utf-8"))


def _document(predictions, name):
    """Predictions as the command line reads them."""
    if not isinstance(predictions, Mapping):
        raise PhaseError(f"predictions are a dict from ids to answers, or the name of a method, not {type(predictions).__name__}")
    wrong = next((id for id, answer in predictions.items() if not isinstance(answer, Mapping)), None)
    if wrong is not None:
        raise PhaseError(f"predictions: the answer for {wrong!r} is a dict, not {type(predictions[wrong]).__name__}")
    events = [dict(answer, id=id) for id, answer in predictions.items()]
    return to_json("predictions", {"method": name, "events": events})
