"""Inference: goals, relation and roles from motion, and forecasts."""

import json

import numpy as np

from . import _native
from ._check import floats, seed_of, text, whole
from ._native import PhaseError
from .events import MOST_STEPS, Event
from .scenes import scene as as_scene


MOST_DECISIONS = 1_000_000
"""The greatest number of decisions that :meth:`Observer.push` may simulate: hours."""


def methods():
    """The names of the methods that there are.

    Returns:
        a dict: ``goals``, the methods of :func:`infer`, and ``trajectories``, those of :func:`forecast`. Neural baselines need a
        package that was built with them.
    """
    recognisers, forecasters = _native.methods()
    return {"goals": recognisers, "trajectories": forecasters}


def infer(event, *, method="simple", seed=0, steps=None):
    """Infers goals, relation and roles from the trajectories of an event; labels, actions and thoughts are not looked at.

    >>> answer = infer(event, steps=40)                       # after 10 s   # doctest: +SKIP
    >>> answer["goals"][0][0], answer["relation"]["friendly"]               # doctest: +SKIP

    Args:
        event: an :class:`Event` of at least one step.
        method: ``simple``, guided inverse planning, or another of :func:`methods`.
        seed: a whole number from 0 to 2**64 - 1, for the method's random draws.
        steps: the number of steps to watch, at least 1; ``None`` for all.

    Returns:
        a dict: ``goals``, for each agent a list of ``{"goal": …, "p": …}``, most likely first; ``relation``, the probabilities of
        ``friendly``, ``adversarial`` and ``neutral``; ``roles``, the probabilities that either agent ``helps`` or ``hinders``;
        ``reported``, the shares of people who would report each relation; ``strengths``, for each agent a dict from levels of strength to
        their probabilities, over the most likely hypotheses; ``details`` as in docs/reference/formats/evaluation.md. What a method does not say is ``None``.

    Raises:
        PhaseError: for an unknown method, and an event without motion.
        KeyboardInterrupt: between two simulations.
    """
    _check_event(event)
    if steps is not None:
        steps = whole("steps", steps, 1, MOST_STEPS)
    if event.steps < 1:
        raise PhaseError(f"the event {event.id} has no step to infer from")
    return _answer(_native.infer(event.native, text("method", method), seed_of(seed), steps))


def forecast(event, *, method="simple", watched=20, steps=20, seed=0):
    """Predicts where every entity will be (Task 2 of the paper).

    Args:
        event: an :class:`Event`, of which only the first ``watched`` steps are looked at.
        method: one of ``methods()["trajectories"]``.
        watched: the number of steps to watch (0.25 s each), 1 to the number that the event has.
        steps: the number of further steps to predict, 1 to 10000.
        seed: a whole number from 0 to 2**64 - 1, for the method's random draws.

    Returns:
        a dict: ``forecast`` (entities, steps, 2), the expected positions x, y (u), and ``futures`` (samples, entities, steps, 2),
        equally likely ones; no sample for methods that predict one future only.

    Raises:
        PhaseError: for an unknown method or an invalid number of steps.
        KeyboardInterrupt: between two simulations.
    """
    _check_event(event)
    watched, steps = whole("watched", watched, 1, MOST_STEPS), whole("steps", steps, 1, MOST_STEPS)
    if watched > event.steps:
        raise PhaseError(f"the event {event.id} has {event.steps} steps; {watched} cannot be watched")
    answer = json.loads(_native.forecast(event.native, text("method", method), watched, steps, seed_of(seed)))
    entities = event.trajectory.shape[1]
    futures = np.array(answer["futures"], dtype=np.float32).reshape(-1, entities, steps, 2)
    return {"forecast": np.array(answer["forecast"], dtype=np.float32), "futures": futures}


class Observer:
    """SIMPLE while an event is watched (docs/explanation/simple.md): the posterior after every row.

    >>> observer = Observer(event.scene, event.trajectory[0])   # doctest: +SKIP
    >>> for row in event.trajectory[1:]:                        # doctest: +SKIP
    ...     answer = observer.push(row)

    Args:
        scene: a scene, as of :func:`phase_events.scene`, of which only walls and sizes are looked at.
        row: the first row, (entities, 5): x, y (u), vx, vy (u/s), angle (rad) of each entity, agents first.
        seed: a whole number from 0 to 2**64 - 1, for its random draws.
        decisions: the number of decisions of minds that :meth:`push` may simulate for a row, at least 0; each takes some milliseconds. ``None``
            for 20, which is less than the 0.25 s that a step lasts.

    Raises:
        PhaseError: for a row of the wrong shape, or with numbers that are not finite.
    """

    def __init__(self, scene, row, *, seed=0, decisions=None):
        if decisions is not None:
            decisions = whole("decisions", decisions, 0, MOST_DECISIONS)
        self._native = _native.Observer(as_scene(scene), floats("a row", row, (-1, 5)), seed_of(seed), decisions)

    def push(self, row):
        """Watches the next row, 0.25 s later, and answers with limited effort.

        Args:
            row: (entities, 5), columns as of the first row.

        Returns:
            a dict as of :func:`infer`, without ``details``.

        Raises:
            PhaseError: for a row of another shape, or with numbers that are not finite.
        """
        return _answer(self._native.push(floats("a row", row, (-1, 5))))

    def inference(self):
        """The answer of :func:`infer` for the rows seen so far, with as much effort as it takes.

        Returns:
            a dict as of :func:`infer`, without ``details``.
        """
        return _answer(self._native.inference())


def _check_event(event):
    if not isinstance(event, Event):
        raise PhaseError(f"an event is an Event, not {type(event).__name__}")


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
