"""The command line from within Python: datasets and evaluations."""

import json
import os
import tempfile
from pathlib import Path

from . import _native
from ._native import PhaseError
from .events import save_events


def run(*arguments):
    """Runs a command of the program ``phase``. Progress goes to stderr, results to stdout.

    >>> run("verify", "out/demo-seed1")   # doctest: +SKIP

    Args:
        arguments: the command and its options, each as text, a number or a path.

    Raises:
        PhaseError: if the command fails, with the sentence of the command line.
        KeyboardInterrupt: after the current step; what is finished is kept, and the same command goes on.
    """
    _native.run([os.fspath(argument) if isinstance(argument, os.PathLike) else str(argument) for argument in arguments])


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
    arguments = ["gen-dataset", "--preset", str(preset), "--out", os.fspath(out)]
    if events is not None:
        arguments += ["--events", str(events)]
    if seed is not None:
        arguments += ["--seed", str(seed)]
    if shard is not None:
        arguments += ["--shard", "{}/{}".format(*shard)]
    if not video:
        arguments.append("--no-video")
    if jobs is not None:
        arguments += ["--jobs", str(jobs)]
    if quiet:
        arguments.append("--quiet")
    with _silent_output(quiet):
        run(*arguments, *options)
    return Path(out)


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
    if task not in ("goals", "trajectories"):
        raise PhaseError(f"task is goals or trajectories, not {task!r}")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        if not isinstance(events, (str, os.PathLike)):
            path = folder / "events.json"
            save_events(events, path)
            events = path
        kept = Path(out) if out is not None else folder / "results"
        arguments = ["eval", task, "--events", os.fspath(events), "--out", os.fspath(kept), "--seed", str(seed), "--quiet"]
        if isinstance(predictions, str):
            arguments += ["--method", predictions]
        else:
            file = folder / f"{name}.json"
            file.write_text(json.dumps(_document(predictions, name)), encoding="utf-8")
            arguments += ["--predictions", os.fspath(file)]
        if split is not None:
            arguments += ["--split", split]
        if ratings is not None:
            arguments += ["--ratings", os.fspath(ratings)]
        with _silent_output(True):
            run(*arguments)
        return json.loads((kept / "results.json").read_text(encoding="utf-8"))


def _document(predictions, name):
    events = [dict(_plain(answer), id=id) for id, answer in predictions.items()]
    return {"method": name, "events": events}


def _plain(answer):
    """An answer without arrays."""
    return {key: value.tolist() if hasattr(value, "tolist") else value for key, value in answer.items()}


class _silent_output:
    """Leaves out what a command prints on stdout."""

    def __init__(self, silent):
        self._silent = silent
        self._kept = None

    def __enter__(self):
        if self._silent:
            import sys

            sys.stdout.flush()
            self._kept = os.dup(1)
            null = os.open(os.devnull, os.O_WRONLY)
            os.dup2(null, 1)
            os.close(null)

    def __exit__(self, *_):
        if self._kept is not None:
            os.dup2(self._kept, 1)
            os.close(self._kept)
