"""Events: simulated, read from files and datasets, as arrays."""

import json
import operator
from collections.abc import Sequence
from functools import cached_property

import numpy as np

from . import _native
from ._check import path_of, seed_of, text, to_json, whole
from ._native import ACTIONS, PhaseError
from .scenes import scene as as_scene

MOST_STEPS = 10_000
"""The greatest length of an event (steps of 0.25 s)."""
SIDES = (64, 2000)
"""The least and the greatest side of a picture (pixels)."""


class Event:
    """A scene and the motion in it: made by :func:`simulate`, or an element of :func:`load_events`.

    >>> event = simulate(sample_scene("chasing", seed=1), seed=1, max_steps=40)   # doctest: +SKIP
    >>> event.trajectory[-1, 0, :2]    # where agent 0 is at the end (u)           # doctest: +SKIP

    An event is either a simulation, which has substeps, actions and thoughts, or a recording, which may have none of them. It does not
    change. It can be copied and pickled, as can :class:`Events`.
    """

    def __init__(self, native):
        self._native = native

    def __reduce__(self):
        # Without the arrays, which are made again.
        return Event, (self._native,)

    def __repr__(self):
        return f"<Event {self.id}: {self.kind}, {self.steps} steps>"

    @property
    def native(self):
        """The event of the native module, which methods and renderers take."""
        return self._native

    @property
    def id(self):
        """The name of the event, which no other event of its file has."""
        return self._native.id

    @property
    def kind(self):
        """``helping``, ``hindering``, ``chasing``, ``competing``, ``collaborating`` or ``independent``."""
        return self._native.kind

    @property
    def relation(self):
        """``friendly``, ``adversarial`` or ``neutral``."""
        return self._native.relation

    @property
    def steps(self):
        """The number of steps, each of 0.25 s."""
        return self._native.steps

    @property
    def scene(self):
        """The :class:`Scene` that it happened in."""
        return self._native.scene

    @cached_property
    def trajectory(self):
        """The motion as methods observe it: (steps + 1, entities, 5) 32-bit floats, columns x, y (u), vx, vy (u/s), angle (rad).

        Entities are agents, then objects. Row 0 is the initial state, every other the mean over the five substeps of its step.
        """
        return self._native.trajectory()

    @cached_property
    def substeps(self):
        """The true state after each of the five substeps of every step: (5 · steps, entities, 6) 32-bit floats, columns x, y (u), angle
        (rad), vx, vy (u/s), angular velocity (rad/s); ``None`` for a recording."""
        return self._native.substeps()

    @cached_property
    def actions(self):
        """Both agents' actions: (steps, 2), indices of ``ACTIONS``. For a recording those recovered from its motion, or ``None``."""
        return self._native.actions()

    @cached_property
    def thoughts(self):
        """The reasons of both agents at each step, as :attr:`Mind.thought` gives them; ``None`` for a recording."""
        text = self._native.thoughts()
        return None if text is None else json.loads(text)

    @property
    def goals(self):
        """Both agents' goals, as dicts of the members of ``goal`` in docs/reference/formats/events.md."""
        return [agent["goal"] for agent in json.loads(self.scene.to_json())["agents"]]

    @property
    def attitudes(self):
        """Both agents' attitudes: 1 helps, -1 hinders, 0 neither."""
        return [agent["alpha"] for agent in json.loads(self.scene.to_json())["agents"]]

    def to_json(self):
        """A document of the format ``phase-events/1`` with this event."""
        return self._native.to_json()

    def save(self, path):
        """Writes :meth:`to_json` to a file, whole or not at all.

        Raises:
            PhaseError: if it cannot be written; an older file of that name is unchanged then.
        """
        _native.write_text(path_of(path), self.to_json())

    def picture(self, row=-1, side=480):
        """A picture of the event at a row of its trajectory.

        Args:
            row: 0 for the initial state to ``steps``; negative numbers count from the end.
            side: the side of the picture (pixels), 64 to 2000.

        Returns:
            (side, side, 3) 8-bit numbers: red, green, blue, the first row at the top.

        Raises:
            PhaseError: for a row that the event does not have, and a side outside 64 to 2000.
        """
        row = whole("row", row, -self.steps - 1, self.steps)
        return _native.Renderer(whole("side", side, *SIDES)).event(self._native, row % (self.steps + 1))

    def save_video(self, path, side=480):
        """Writes the event as an .mp4 (H.264) of 20 frames a second, five a step.

        Args:
            path: the file. One that exists is replaced.
            side: the side of the video (pixels), 64 to 2000, even.

        Raises:
            PhaseError: for another side, and if the file cannot be written; an older file of that name is unchanged then.
        """
        if whole("side", side, *SIDES) % 2:
            raise PhaseError(f"the side of a video is even, not {side}")
        _native.Renderer(side).video(self._native, path_of(path))


class Events(Sequence):
    """A sequence of events that are read when they are asked for. :func:`load_events` makes it.

    An index gives an :class:`Event`, a slice a list of them; ``len`` reads none. An event that cannot be read raises
    :class:`PhaseError`, an index that there is not ``IndexError``.
    """

    def __init__(self, source):
        self._source = source

    def __len__(self):
        return len(self._source)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        index = operator.index(index)
        index = index + len(self) if index < 0 else index
        if not 0 <= index < len(self):
            raise IndexError(f"there are {len(self)} events")
        return Event(self._source.load(index))

    def tensors(self):
        """All events as padded arrays, as :func:`tensors` makes them."""
        return tensors(self)

    def to_pandas(self):
        """All events as one table, as :func:`to_pandas` makes it."""
        return to_pandas(self)


def load_events(path):
    """The events of a file or a folder, as a sequence.

    >>> events = load_events("out/demo")             # doctest: +SKIP
    >>> [event.relation for event in events[:3]]     # doctest: +SKIP

    Args:
        path: a file in the format ``phase-events/1``, or the folder of a dataset or of simulations.

    Returns:
        :class:`Events`, which read each event when it is asked for.

    Raises:
        PhaseError: naming file, field and rule, if there are none or they cannot be read.
    """
    return Events(_native.EventSource(path_of(path)))


def simulate(scene, seed=0, *, id="event", engine="world", max_steps=100, parameters=None):
    """Lets two PHASE minds play a scene (Algorithm 1 of the paper).

    Args:
        scene: a :class:`Scene`, a dict or JSON text.
        seed: a whole number from 0 to 2**64 - 1. One seed gives one event, on every machine.
        id: the name of the event.
        engine: ``world`` (rapier2d) or ``forward`` (the kernel that minds plan in).
        max_steps: the greatest length (steps of 0.25 s), 1 to 10000. The event ends earlier once nothing happens any more.
        parameters: a dict of the parameters of both minds that differ from the defaults of their kind (docs/explanation/minds.md), such as
            ``{"simulations": 200}`` or ``{"kind": "published"}``.

    Returns:
        the :class:`Event`.

    Raises:
        PhaseError: for an invalid argument, naming it and the rule.
        KeyboardInterrupt: within a step.
    """
    parameters = None if parameters is None else to_json("parameters", parameters)
    max_steps = whole("max_steps", max_steps, 1, MOST_STEPS)
    id, engine = text("id", id), text("engine", engine)
    return Event(_native.simulate(as_scene(scene), seed_of(seed), id, engine, max_steps, parameters))


def save_events(events, path):
    """Writes events as one file in the format ``phase-events/1``, as every command reads them.

    Args:
        events: at least one :class:`Event`.
        path: the file. One that exists is replaced.

    Raises:
        PhaseError: if there are no events, two have the same id, or the file cannot be written; an older file of that name is unchanged
            then.
    """
    events = _list(events)
    if len({event.id for event in events}) < len(events):
        raise PhaseError("two events have the same id")
    documents = [json.loads(event.to_json()) for event in events]
    if not documents:
        raise PhaseError("there are no events")
    document = dict(documents[0], events=[event for one in documents for event in one["events"]])
    _native.write_text(path_of(path), json.dumps(document))


def tensors(events):
    """Events as padded arrays.

    Args:
        events: at least one :class:`Event`.

    Returns:
        a dict of ``trajectory`` (N, T + 1, 4, 5), ``mask`` (N, T + 1) that is true where an event has a row, ``entities`` (N, 4) that
        is true where it has an entity, ``actions`` (N, T, 2) with -1 where there is none, ``kind`` and ``relation`` (N,) as text,
        ``attitudes`` (N, 2), and ``id``; T is the length of the longest event. Padding is 0.

    Raises:
        PhaseError: if there are no events.
    """
    events = _list(events)
    if not events:
        raise PhaseError("there are no events")
    longest = max(event.steps for event in events)
    count = len(events)
    trajectory = np.zeros((count, longest + 1, 4, 5), dtype=np.float32)
    mask = np.zeros((count, longest + 1), dtype=bool)
    entities = np.zeros((count, 4), dtype=bool)
    actions = np.full((count, longest, 2), -1, dtype=np.int64)
    for k, event in enumerate(events):
        rows = event.trajectory
        trajectory[k, : len(rows), : rows.shape[1]] = rows
        mask[k, : len(rows)] = True
        entities[k, : rows.shape[1]] = True
        if event.actions is not None:
            actions[k, : len(event.actions)] = event.actions
    return {
        "id": [event.id for event in events],
        "trajectory": trajectory,
        "mask": mask,
        "entities": entities,
        "actions": actions,
        "kind": np.array([event.kind for event in events]),
        "relation": np.array([event.relation for event in events]),
        "attitudes": np.array([event.attitudes for event in events], dtype=np.int64),
    }


def to_pandas(events):
    """Events as one table. It needs ``phase-events[data]``.

    Args:
        events: at least one :class:`Event`.

    Returns:
        a ``pandas.DataFrame`` with a row for each entity at each row of a trajectory. Its columns are ``event``, ``kind``, ``relation``,
        ``step``, ``entity``, ``x``, ``y`` (u), ``vx``, ``vy`` (u/s), ``angle`` (rad) and ``action``, the name of the agent's action
        from that row on.

    Raises:
        PhaseError: if there are no events.
    """
    import pandas

    names = ["agent 0", "agent 1", "object 0", "object 1"]
    frames = []
    for event in _list(events):
        rows = event.trajectory
        steps, entities, _ = rows.shape
        frame = pandas.DataFrame(rows.reshape(-1, 5), columns=["x", "y", "vx", "vy", "angle"])
        frame.insert(0, "entity", names[:entities] * steps)
        frame.insert(0, "step", np.repeat(np.arange(steps), entities))
        frame.insert(0, "relation", event.relation)
        frame.insert(0, "kind", event.kind)
        frame.insert(0, "event", event.id)
        action = np.full((steps, entities), None, dtype=object)
        if event.actions is not None:
            done = np.array(ACTIONS, dtype=object)[event.actions]
            action[: len(done), :2] = done
        frame["action"] = action.reshape(-1)
        frames.append(frame)
    if not frames:
        raise PhaseError("there are no events")
    return pandas.concat(frames, ignore_index=True)


def _list(events):
    """Events as a list; those of :class:`Events` are read."""
    try:
        events = list(events)
    except TypeError:
        raise PhaseError(f"events are a sequence of Event, not {type(events).__name__}") from None
    wrong = next((one for one in events if not isinstance(one, Event)), None)
    if wrong is not None:
        raise PhaseError(f"events are a sequence of Event, not of {type(wrong).__name__}")
    return events
