import os

import numpy as np
import pytest

import phase_events as phase

# Windows need no screen.
os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
QUICK = {"simulations": 50, "particles": 10}


@pytest.fixture(scope="session")
def scene():
    return phase.sample_scene("helping", seed=1)


@pytest.fixture(scope="session")
def event(scene):
    """A short event, with less search than in the paper."""
    return phase.simulate(scene, seed=7, max_steps=45, parameters=QUICK)


def same(found, wanted):
    """Whether two answers of environments are equal, bit for bit."""
    if isinstance(wanted, dict):
        return found.keys() == wanted.keys() and all(same(found[name], wanted[name]) for name in wanted)
    if isinstance(wanted, tuple):
        return len(found) == len(wanted) and all(map(same, found, wanted))
    if isinstance(wanted, np.ndarray) and wanted.dtype == object:
        return len(found) == len(wanted) and all(map(same, found, wanted))
    return np.array_equal(found, wanted)
