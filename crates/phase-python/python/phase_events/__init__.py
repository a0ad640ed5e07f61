"""PHASE: physically grounded social events, the minds that make them, and inference that perceives them.

>>> import phase_events
>>> event = phase_events.simulate(phase_events.sample_scene("helping", seed=1), seed=1)   # doctest: +SKIP
>>> phase_events.infer(event)["relation"]                                                # doctest: +SKIP

Two agents with bodies, limited views, beliefs, goals and attitudes act in a 2D physical world (:func:`simulate`), and methods infer from
their motion what they want (:func:`infer`).

Lengths are in arena units (u): the arena is the square from (6, 2) to (26, 22). A step is 0.25 s of video and
1/12 s of physics. Velocities are in u, and angular velocities in radians, per second of physics: a body with
the velocity v moves by about v/12 in a step. Angles are in radians, and an agent at angle 0 faces up. Arrays
have agents first, then objects, both by number. Whatever is invalid raises :class:`PhaseError`, a
``ValueError`` whose text names the argument and the rule. Environments need ``phase-events[env]``; they are
imported with :mod:`phase_events.env`.
"""

from ._native import ACTIONS, OBSERVATION_SIZE, PhaseError, Scene
from ._native import VERSION as __version__
from .command import evaluate, generate, run, submit
from .events import RELATIONS, Event, Events, ObservedEvent, load_events, load_observed, simulate, track
from .observation import split_observation
from .perception import GOALS, Observer, answer, forecast, goal_index, infer, methods
from .policies import HeuristicPolicy, Mind, RandomPolicy, ReplayPolicy, StillPolicy
from .scenes import KINDS, sample_scene, scene

__all__ = [
    "ACTIONS",
    "GOALS",
    "KINDS",
    "OBSERVATION_SIZE",
    "RELATIONS",
    "Event",
    "Events",
    "HeuristicPolicy",
    "Mind",
    "ObservedEvent",
    "Observer",
    "PhaseError",
    "RandomPolicy",
    "ReplayPolicy",
    "Scene",
    "StillPolicy",
    "__version__",
    "answer",
    "evaluate",
    "forecast",
    "generate",
    "goal_index",
    "infer",
    "load_events",
    "load_observed",
    "methods",
    "run",
    "sample_scene",
    "scene",
    "simulate",
    "split_observation",
    "submit",
    "track",
]

_ENVIRONMENTS = {"PhaseEnv": "env", "PhaseParallelEnv": "env", "PhaseVectorEnv": "vector"}


def __getattr__(name):
    # Environments need gymnasium and pettingzoo, which the rest does not. They are not in `__all__`, so that a star import works
    # without.
    if name in _ENVIRONMENTS:
        from importlib import import_module

        return getattr(import_module(f"{__name__}.{_ENVIRONMENTS[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
