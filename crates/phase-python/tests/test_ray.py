"""Shards on Ray, of which a worker is killed, merge to the bytes of one machine's run."""

import contextlib
import hashlib
import os
import signal
import subprocess
import threading
import time
from pathlib import Path

import pytest

import phase_events as phase

ray = pytest.importorskip("ray")
OPTIONS = ["--simulations", "100", "--max-steps", "40"]


@pytest.fixture(scope="module")
def cluster():
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


def digest(folder):
    files = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    total = hashlib.sha256()
    for path in files:
        total.update(str(path.relative_to(folder)).encode())
        total.update(path.read_bytes())
    return total.hexdigest()


def kill_workers(killed, finished, most):
    """Kills the first worker that has begun a shard, however long that takes to happen, until so many are killed."""
    while len(killed) < most and not finished.is_set():
        found = subprocess.run(["pgrep", "-f", r"^ray::Shard\.make"], capture_output=True, text=True, check=False)
        for process in found.stdout.split()[:1]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(process), signal.SIGKILL)
                killed.append(process)
        time.sleep(0.02)


@contextlib.contextmanager
def killed_workers(most=1):
    """Has workers killed while the block runs."""
    killed, finished = [], threading.Event()
    killer = threading.Thread(target=kill_workers, args=(killed, finished, most))
    killer.start()
    try:
        yield
    finally:
        finished.set()
        killer.join()
    assert killed, "a worker was killed on the way"


def test_shards_merge_to_the_same_bytes(cluster, tmp_path):
    from phase_events import ray as on_ray

    one = phase.generate("demo", 6, tmp_path / "one", video=False, options=OPTIONS)
    with killed_workers():
        many = on_ray.generate("demo", 6, tmp_path / "many", shards=6, video=False, options=OPTIONS)
    assert digest(one) == digest(many)
    assert not (tmp_path / "many.shards").exists()
    single = phase.evaluate("cue", many, seed=1)
    assert on_ray.evaluate("cue", many, tmp_path / "scores", shards=3) == single


def test_failures_are_phases(cluster, tmp_path):
    from phase_events import ray as on_ray

    # All shards fail at about the same time, which must not bring down this process.
    for _ in range(4):
        with pytest.raises(phase.PhaseError, match="preset"):
            on_ray.generate("none", 2, tmp_path / "out", shards=2)


def test_retries_end(cluster, tmp_path):
    from phase_events import ray as on_ray

    with killed_workers(most=1000), pytest.raises(phase.PhaseError, match="0 retries were not enough"):
        on_ray.generate("demo", 2, tmp_path / "out", shards=2, video=False, options=OPTIONS, retries=0)
