"""Datasets and evaluations on a Ray cluster. It needs ``phase-events[ray]``.

Every shard is made by an actor of its own, in a folder that all machines share. One whose worker is killed is made again and
goes on where it was; the parts are merged to the bytes of one machine's run. Use more shards than workers: events differ in cost.
"""

import json
import os
import shutil
from pathlib import Path

import ray

from . import command
from ._check import choice, path_of, seed_of, text, whole
from ._native import PhaseError
from .perception import methods

RETRIES = 5
MOST_RETRIES = 1000
MOST_SHARDS = 100_000
# Seconds that the other shards have to end by themselves after a failure, as they do where the input is at fault. To kill takes longer.
GRACE = 1.0


def generate(preset="demo", events=None, out=None, *, shards=None, seed=None, video=True, options=(), retries=RETRIES):
    """Generates a dataset as :func:`phase_events.generate`, one shard an actor.

    Args:
        preset, events, seed, video, options: as of :func:`phase_events.generate`.
        out: the folder of the dataset, on a file system that all workers share; the shards are in ``OUT.shards`` and are kept until
            they are merged.
        shards: the number of shards; ``None`` for four a core of the cluster, at most one an event.
        retries: how often a shard is made again after its worker died.

    Returns:
        the folder.

    Raises:
        PhaseError: with the sentence of the command line.
    """
    if out is None:
        raise PhaseError("out: a folder for the dataset is needed")
    out = Path(path_of(out))
    retries = whole("retries", retries, 0, MOST_RETRIES)
    events = None if events is None else whole("events", events, 1, 2**32 - 1)
    count = _shards(shards, events)

    def make(k):
        folder = _parts(out) / f"{k:05d}"
        command.generate(
            preset, events, folder, shard=(k, count), seed=seed, video=video, jobs=1, options=options
        )
        return str(folder)

    folders = _run(make, count, retries)
    _merge(["merge", *folders, "--out", os.fspath(out), "--quiet"], out)
    return out


def evaluate(method, events, out, *, task="goals", split=None, shards=None, seed=1, retries=RETRIES):
    """Evaluates one of PHASE's methods as :func:`phase_events.evaluate`, one shard an actor.

    Args:
        method: the name of the method, one of :func:`phase_events.methods`.
        events: a file or a dataset on a file system that all workers share.
        out: a folder for results and report there.
        task, split, seed: as of :func:`phase_events.evaluate`.
        shards: the number of shards; ``None`` for four a core of the cluster.
        retries: how often a shard is made again after its worker died.

    Returns:
        the document of results.

    Raises:
        PhaseError: with the sentence of the command line.
    """
    out, events = Path(path_of(out)), path_of(events)
    retries = whole("retries", retries, 0, MOST_RETRIES)
    choice("task", task, tuple(methods()))
    count = _shards(shards, None)
    common = ["eval", task, "--method", text("method", method), "--events", events, "--seed", seed_of(seed), "--quiet"]
    if split is not None:
        common += ["--split", text("split", split)]

    def make(k):
        folder = _parts(out) / f"{k:05d}"
        command._run([*common, "--out", folder, "--shard", f"{k}/{count}", "--jobs", "1"], silent=True)
        return str(folder)

    folders = _run(make, count, retries)
    _merge([*common, "--merge", *folders, "--out", os.fspath(out)], out)
    return json.loads((out / "results.json").read_text(encoding="utf-8"))


def _parts(out):
    return out.with_name(out.name + ".shards")


def _shards(shards, events):
    if not ray.is_initialized():
        ray.init()
    count = shards if shards is not None else 4 * int(ray.cluster_resources().get("CPU", 1))
    count = whole("shards", count, 1, MOST_SHARDS)
    return count if events is None else min(count, events)


def _run(make, count, retries):
    # An actor for each shard, not a task: actors can be killed, while cancelling a task just as it ends, as all do at once where the
    # input is at fault, can crash this process (https://github.com/ray-project/ray/pull/54798). What a killed one has made is kept.
    class Shard:
        def make(self, k):
            return make(k)

    # A failure of the input is the same every time; only a shard whose worker died is made again.
    actor = ray.remote(num_cpus=1, max_restarts=retries, max_task_retries=retries)(Shard)
    actors = [actor.remote() for _ in range(count)]
    results = [one.make.remote(k) for k, one in enumerate(actors, 1)]
    running = dict(zip(results, actors, strict=True))
    del actors
    try:
        while running:
            # Without its handle an actor ends, and the next has its place.
            (ended,), _ = ray.wait(list(running), num_returns=1)
            ray.get(ended)
            del running[ended]
        return ray.get(results)
    except ray.exceptions.RayTaskError as error:
        raise (error.cause if isinstance(error.cause, PhaseError) else PhaseError(str(error.cause))) from error
    except ray.exceptions.RayActorError as error:
        raise PhaseError(f"retries: the worker of a shard died, and {retries} retries were not enough") from error
    finally:
        _, unfinished = ray.wait(results, num_returns=count, timeout=GRACE)
        for one in unfinished:
            ray.kill(running[one])
        # The error's traceback has this frame, whose handles would keep the actors of ended shards, and their cores.
        running.clear()


def _merge(arguments, out):
    command._run(arguments, silent=True)
    shutil.rmtree(_parts(out), ignore_errors=True)
