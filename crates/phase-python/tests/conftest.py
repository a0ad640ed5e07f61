import os

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
