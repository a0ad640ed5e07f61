"""Inference: goals, relation and roles from motion, and forecasts."""

import json

import numpy as np

from . import _native
from ._native import PhaseError
from .scenes import scene as as_scene
from .scenes import seed_of


def methods():
    """Names of the methods for :func:`infer` and for :func:`forecast`: a dict of two lists. Those of neural baselines need a
    program that was built with them."""
    recognisers, forecasters = _native.methods()
    return {"goals": recognisers, "trajectories": forecasters}


def infer(event, *, method="simple", seed=0, steps=None):
    """Infers goals, relation and roles from the trajectories of an event; labels, actions and thoughts are not looked at.

    Args:
        event: an :class:`Event`.
        method: ``simple``, guided inverse planning, or another of :func:`methods`.
        seed: of the method's random draws.
        steps: watch only so many steps.

    Returns:
        a dict: ``goals``, for each agent a list of ``{"goal": …, "p": …}``, most likely first; ``relation``, the probabilities of
        ``friendly``, ``adversarial`` and ``neutral``; ``roles``, the probabilities that either agent ``helps`` or ``hinders``;
        ``reported``, the shares of people who would report each relation; ``strengths``, for each agent a dict from levels of strength to
        their probabilities, over the most likely hypotheses; ``details`` as in docs/formats.md. What a method does not say is ``None``.

    Raises:
        PhaseError: for an unknown method, and an event without motion.
        KeyboardInterrupt: between two simulations.
    """
    if steps is not None and (not isinstance(steps, int) or steps < 1):
        raise PhaseError(f"steps is a whole number of at least 1, not {steps!r}")
    if event.steps < 1:
        raise PhaseError(f"the event {event.id} has no step to infer from")
    return _answer(_native.infer(event.native, method, seed_of(seed), steps))


def forecast(event, *, method="simple", watched=20, steps=20, seed=0):
    """Predicts where every entity will be (Task 2 of the paper).

    Args:
        event: an :class:`Event`, of which only the first ``watched`` steps are looked at.
        steps: how many further steps to predict.

    Returns:
        ``forecast`` (entities, steps, 2), the expected positions (u), and ``futures`` (samples, entities, steps, 2), equally likely
        ones; no sample for methods that predict one future only.

    Raises:
        PhaseError: for an unknown method or an invalid number of steps.
    """
    for name, number in (("watched", watched), ("steps", steps)):
        if not isinstance(number, int) or not 1 <= number <= 10_000:
            raise PhaseError(f"{name} is a whole number from 1 to 10000, not {number!r}")
    if watched > event.steps:
        raise PhaseError(f"the event {event.id} has {event.steps} steps; {watched} cannot be watched")
    answer = json.loads(_native.forecast(event.native, method, watched, steps, seed_of(seed)))
    entities = event.trajectory.shape[1]
    futures = np.array(answer["futures"], dtype=np.float32).reshape(-1, entities, steps, 2)
    return {"forecast": np.array(answer["forecast"], dtype=np.float32), "futures": futures}


class Observer:
    """SIMPLE while an event is watched (docs/simple.md): the posterior after every row.

    Args:
        scene: of which only walls and sizes are looked at.
        row: the first row, (entities, 5): x, y (u), vx, vy (u/s), angle (rad) of each entity, agents first.
        seed: of its random draws.
        decisions: how many decisions of minds :meth:`push` may simulate for a row; each takes some milliseconds. ``None`` for
            20, which is less than the 0.25 s that a step lasts.

    Raises:
        PhaseError: for a row of the wrong shape, or with numbers that are not finite.
    """

    def __init__(self, scene, row, *, seed=0, decisions=None):
        row = np.ascontiguousarray(row, dtype=np.float32)
        self._native = _native.Observer(as_scene(scene), _two(row), seed_of(seed), decisions)

    def push(self, row):
        """Watches the next row; the answer as of :func:`infer`, with limited effort."""
        return _answer(self._native.push(_two(np.ascontiguousarray(row, dtype=np.float32))))

    def inference(self):
        """The answer of :func:`infer` for the rows seen so far, with as much effort as it takes."""
        return _answer(self._native.inference())


def _two(row):
    if row.ndim != 2:
        raise PhaseError(f"a row has the shape (entities, 5), not {row.shape}")
    return row


def _answer(text):
    document = json.loads(text)
    answer = document["answer"]
    details = document.get("details")
    answer["strengths"] = _strengths((details or {}).get("hypotheses"))
    if details is not None:
        answer["details"] = details
    return answer


def _strengths(hypotheses):
    """The probability of each level of strength of each agent."""
    if not hypotheses:
        return None
    total = sum(one["weight"] for one in hypotheses)
    strengths = [{}, {}]
    for one in hypotheses:
        for levels, level in zip(strengths, one["hypothesis"]["strengths"], strict=True):
            levels[level] = levels.get(level, 0.0) + one["weight"] / total
    return strengths
