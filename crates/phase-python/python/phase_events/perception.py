"""Inference: goals, relation and roles from motion, and forecasts."""

import json

import numpy as np

from . import _native
from ._check import choice, floats, seed_of, to_json, whole
from ._native import MOST_STEPS, PhaseError
from .events import RELATIONS, Event, ObservedEvent
from .scenes import scene as as_scene

GOALS = tuple(json.loads(_native.GOALS))
"""The 34 goals that methods tell apart, as dicts: agent 0 and 1 on each landmark, object 0 and 1 on each landmark, the agents touching each
other; then the same 17 with ``sign`` -1, to be avoided."""

ROUNDING = 1e-3
"""By how much probabilities of 32 bits may exceed 1 in sum."""
MOST_DECISIONS = 1_000_000
"""The greatest number of decisions that :meth:`Observer.push` may simulate: hours."""


def methods():
    """The names of the methods that this package has.

    Returns:
        a dict: ``goals``, the methods of :func:`infer`, and ``trajectories``, those of :func:`forecast`. The networks ``two-level-lstm``,
        ``arg``, ``socialgnn``, ``social-lstm`` and ``stgat`` are among them if the package was built with them
        (``MATURIN_PEP517_ARGS="--features networks" pip install ./crates/phase-python``).
    """
    recognisers, forecasters = _native.methods()
    return {"goals": recognisers, "trajectories": forecasters}


def infer(event, *, method="simple", seed=0, steps=None):
    """Infers goals, relation and roles from the trajectories of an event; labels, actions and thoughts are not looked at.

    >>> answer = infer(event, steps=40)                       # after 10 s   # doctest: +SKIP
    >>> answer["goals"][0][0], answer["relation"]["friendly"]               # doctest: +SKIP

    Args:
        event: an :class:`Event` of at least one step, or an :class:`ObservedEvent`.
        method: ``simple``, guided inverse planning, or another of :func:`methods`.
        seed: a whole number from 0 to 2**64 - 1, for the method's random draws.
        steps: the number of steps to watch, at least 1; ``None`` for all.

    Returns:
        a dict: ``watched_steps``, the number of steps that were watched; ``goals``, for each agent a list of ``{"goal": …, "p": …}``, most likely first; ``relation``, the probabilities of
        ``friendly``, ``adversarial`` and ``neutral``; ``roles``, the probabilities that either agent ``helps`` or ``hinders``;
        ``reported``, the shares of people who would report each relation; ``strengths``, for each agent a dict from levels of strength to
        their probabilities, over the most likely hypotheses; ``details`` as in docs/reference/formats/evaluation.md. What a method does not say is ``None``.

    Raises:
        PhaseError: for an unknown method, and an event without motion.
        KeyboardInterrupt: between two simulations.
    """
    watched = _observed(event)
    if steps is not None:
        watched = watched.prefix(whole("steps", steps, 1, MOST_STEPS))
    if event.steps < 1:
        raise PhaseError(f"the event {event.id} has no step to infer from")
    method = choice("method", method, methods()["goals"])
    return {**_answer(_native.infer(watched.native, method, seed_of(seed))), "watched_steps": watched.steps}


def goal_index(goal):
    """The index of a goal in ``GOALS``. Touching is one goal, whichever agent is named first.

    Args:
        goal: a dict of the members of ``goal`` in docs/reference/formats/events.md.

    Raises:
        PhaseError: for anything else.
    """
    return _native.goal_index(to_json("goal", goal))


def answer(goals, relation, roles=None):
    """An answer in the form of :func:`infer` from arrays, such as the softmax of a network.

    >>> mine = {event.id: answer(goals, relation) for event, goals, relation in found}   # doctest: +SKIP
    >>> evaluate(mine, events)["goal"]["top1"]                                           # doctest: +SKIP

    Args:
        goals: (2, 34), for each agent the probabilities of ``GOALS``.
        relation: (3,), the probabilities of ``friendly``, ``adversarial`` and ``neutral``.
        roles: (2, 2), the probabilities that agent 0 and agent 1 help, and that they hinder; or ``None``.

    Returns:
        a dict: ``goals``, most likely first and without those of probability 0, ``relation``, and ``roles`` if they are given.

    Raises:
        PhaseError: for another shape, and for numbers that are not probabilities.
    """
    goals, relation = _probabilities("goals", goals, (2, len(GOALS))), _probabilities("relation", relation, (3,))
    ranked = [[int(k) for k in np.argsort(-shares, kind="stable") if shares[k] > 0] for shares in goals]
    found = {
        "goals": [[{"goal": GOALS[k], "p": float(shares[k])} for k in order] for shares, order in zip(goals, ranked, strict=True)],
        "relation": dict(zip(RELATIONS, relation.tolist(), strict=True)),
    }
    if roles is not None:
        found["roles"] = dict(zip(("helps", "hinders"), _probabilities("roles", roles, (2, 2)).tolist(), strict=True))
    return found


def _probabilities(name, values, shape):
    """Probabilities as 64-bit floats. The softmax of 32-bit numbers adds up to a little more than 1: it is scaled to 1."""
    values = floats(name, values.detach().cpu() if hasattr(values, "detach") else values, shape).astype(np.float64)
    if not ((values >= 0) & (values <= 1)).all():
        raise PhaseError(f"{name} are probabilities, 0 to 1")
    total = values.sum(axis=-1, keepdims=True)
    if name != "roles" and (total > 1 + ROUNDING).any():
        raise PhaseError(f"{name} add up to at most 1, not {total.max():g}")
    return values if name == "roles" else values / np.maximum(total, 1)


def forecast(event, *, method="simple", watched=20, steps=20, seed=0):
    """Predicts where every entity will be (Task 2 of the paper).

    Args:
        event: an :class:`Event` or :class:`ObservedEvent`, of which only the first ``watched`` steps are looked at.
        method: one of ``methods()["trajectories"]``.
        watched: the number of steps to watch (0.25 s of video each), 1 to the number that the event has.
        steps: the number of further steps to predict, 1 to 10000.
        seed: a whole number from 0 to 2**64 - 1, for the method's random draws.

    Returns:
        a dict: ``watched_steps``, as given; ``forecast`` (entities, steps, 2), the expected positions x, y (u), and ``futures`` (samples, entities, steps, 2),
        equally likely ones; no sample for methods that predict one future only.

    Raises:
        PhaseError: for an unknown method or an invalid number of steps.
        KeyboardInterrupt: between two simulations.
    """
    seen = _observed(event)
    watched, steps = whole("watched", watched, 1, MOST_STEPS), whole("steps", steps, 1, MOST_STEPS)
    if watched > event.steps:
        raise PhaseError(f"the event {event.id} has {event.steps} steps; {watched} cannot be watched")
    method = choice("method", method, methods()["trajectories"])
    answer = json.loads(_native.forecast(seen.prefix(watched).native, method, steps, seed_of(seed)))
    entities = len(seen.radii)
    futures = np.array(answer["futures"], dtype=np.float32).reshape(-1, entities, steps, 2)
    forecast = np.array(answer["forecast"], dtype=np.float32)
    return {"watched_steps": watched, "forecast": forecast, "futures": futures}


class Observer:
    """SIMPLE while an event is watched (docs/explanation/simple.md): the posterior after every row.

    >>> observer = Observer(event.scene, event.trajectory[0])   # doctest: +SKIP
    >>> for row in event.trajectory[1:]:                        # doctest: +SKIP
    ...     answer = observer.push(row)

    Args:
        scene: a scene, as of :func:`phase_events.scene`, or an event, of which only walls and sizes are looked at.
        row: the first row, (entities, 5): x, y (u), vx, vy (u/s of physics), angle (rad) of each entity,
            agents first; ``None`` for that of the event.
        seed: a whole number from 0 to 2**64 - 1, for its random draws.
        decisions: the number of decisions of minds that :meth:`push` may simulate for a row, at least 0; each takes some milliseconds. ``None``
            for 20, which takes less than the 0.25 s for which a video shows a step.

    Raises:
        PhaseError: for a row of the wrong shape, or with numbers that are not finite.
    """

    def __init__(self, scene, row=None, *, seed=0, decisions=None):
        if decisions is not None:
            decisions = whole("decisions", decisions, 0, MOST_DECISIONS)
        if isinstance(scene, (Event, ObservedEvent)):
            seen = scene.observed
            row = seen.trajectory[0] if row is None else floats("a row", row, (-1, 5))
            levels = seen.size_levels.tolist()
            start = ObservedEvent(seen.layout, levels[:2], levels[2:], row[None], seen.id).native
        elif row is None:
            raise PhaseError("row: an observer of a scene needs its first row")
        else:
            start = _native.Observed.in_scene(as_scene(scene), floats("a row", row, (-1, 5))[None])
        self._native = _native.Observer(start, seed_of(seed), decisions)

    def push(self, row):
        """Watches the next row, 0.25 s of video later, and answers with limited effort.

        Args:
            row: (entities, 5), columns as of the first row.

        Returns:
            a dict as of :func:`infer`, without ``details`` and ``watched_steps``.

        Raises:
            PhaseError: for a row of another shape, or with numbers that are not finite.
        """
        return _answer(self._native.push(floats("a row", row, (-1, 5))))

    def inference(self):
        """The answer of :func:`infer` for the rows seen so far, with as much effort as it takes.

        Returns:
            a dict as of :func:`infer`, without ``details`` and ``watched_steps``.
        """
        return _answer(self._native.inference())


def _observed(event):
    if not isinstance(event, (Event, ObservedEvent)):
        raise PhaseError(f"an event is an Event or ObservedEvent, not {type(event).__name__}")
    return event.observed


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
