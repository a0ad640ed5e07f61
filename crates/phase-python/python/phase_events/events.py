"""Events: simulated, read from files and datasets, as arrays."""

import json
import os
from collections.abc import Sequence
from functools import cached_property

import numpy as np

from . import _native
from ._native import ACTIONS, PhaseError
from .scenes import scene as as_scene
from .scenes import seed_of


class Event:
    """What happened in a scene: made by :func:`simulate`, or an element of :func:`load_events`."""

    def __init__(self, native):
        self._native = native

    def __repr__(self):
        return f"<Event {self.id}: {self.kind}, {self.steps} steps>"

    @property
    def native(self):
        """The event in Rust."""
        return self._native

    @property
    def id(self):
        """Its name in its file."""
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
        """Number of steps of 0.25 s."""
        return self._native.steps

    @property
    def scene(self):
        """The :class:`Scene` that it happened in."""
        return self._native.scene

    @cached_property
    def trajectory(self):
        """(steps + 1, entities, 5) 32-bit floats: x, y (u), vx, vy (u/s), angle (rad) of every entity, agents first. Row 0 is the
        initial state, every other the mean over the five substeps of its step, as methods observe them."""
        return self._native.trajectory()

    @cached_property
    def substeps(self):
        """(5 steps, entities, 6): x, y, angle, vx, vy, angular velocity after each substep of 1/60 s; ``None`` for a recording."""
        return self._native.substeps()

    @cached_property
    def actions(self):
        """(steps, 2): both agents' actions, indices of ``ACTIONS``. For a recording those recovered from its motion, or ``None``."""
        return self._native.actions()

    @cached_property
    def thoughts(self):
        """Of each step the reasons of both agents, as :attr:`Mind.thought`; ``None`` for a recording."""
        text = self._native.thoughts()
        return None if text is None else json.loads(text)

    @property
    def goals(self):
        """Both agents' goals, as dicts of the members of ``goal`` in docs/formats.md."""
        return [agent["goal"] for agent in json.loads(self.scene.to_json())["agents"]]

    @property
    def attitudes(self):
        """Both agents' attitudes: 1 helps, -1 hinders, 0 neither."""
        return [agent["alpha"] for agent in json.loads(self.scene.to_json())["agents"]]

    def to_json(self):
        """A document of the format ``phase-events/1`` with this event."""
        return self._native.to_json()

    def save(self, path):
        """Writes :meth:`to_json` to a file.

        Raises:
            PhaseError: if it cannot be written.
        """
        _write(path, self.to_json())

    def picture(self, row=-1, side=480):
        """The scene at a row of the trajectory: (side, side, 3), 0 to 255.

        Raises:
            PhaseError: for a row that the event does not have, and a side outside 64 to 2000.
        """
        row = row + self.steps + 1 if row < 0 else row
        if row < 0:
            raise PhaseError(f"the event has the rows 0 to {self.steps}")
        return _native.Renderer(side).event(self._native, row)

    def save_video(self, path, side=480):
        """Writes the event as an .mp4 (H.264) of 20 frames a second.

        Raises:
            PhaseError: if it cannot be written.
        """
        _native.Renderer(side).video(self._native, os.fspath(path))


class Events(Sequence):
    """Events, read when they are asked for."""

    def __init__(self, source):
        self._source = source

    def __len__(self):
        return len(self._source)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        index = index + len(self) if index < 0 else index
        if not 0 <= index < len(self):
            raise IndexError(f"there are {len(self)} events")
        return Event(self._source.load(index))

    def tensors(self):
        """See :func:`tensors`."""
        return tensors(self)

    def to_pandas(self):
        """See :func:`to_pandas`."""
        return to_pandas(self)


def load_events(path):
    """The events of a file in the format ``phase-events/1``, or of the folder of a dataset or of simulations: a sequence.

    Raises:
        PhaseError: naming file, field and rule, if there are none or they cannot be read.
    """
    return Events(_native.EventSource(os.fspath(path)))


def simulate(scene, seed=0, *, id="event", engine="world", max_steps=100, parameters=None):
    """Lets two PHASE minds play a scene (Algorithm 1 of the paper).

    Args:
        scene: a :class:`Scene`, a dict or JSON text.
        seed: the same seed gives the same event, on every machine.
        id: its name.
        engine: ``world`` (rapier2d) or ``forward`` (the kernel that minds plan in).
        max_steps: its length at most (steps of 0.25 s).
        parameters: of both minds; a dict of what differs from the defaults, such as ``{"kind": "published"}``.

    Raises:
        PhaseError: for an invalid argument.
        KeyboardInterrupt: within a step.
    """
    parameters = None if parameters is None else json.dumps(parameters)
    if not isinstance(max_steps, int) or not 1 <= max_steps <= 10_000:
        raise PhaseError(f"max_steps is a whole number from 1 to 10000, not {max_steps!r}")
    return Event(_native.simulate(as_scene(scene), seed_of(seed), id, engine, max_steps, parameters))


def save_events(events, path):
    """Writes events as one file in the format ``phase-events/1``, as every command reads them.

    Raises:
        PhaseError: if it cannot be written, or two have the same id.
    """
    events = list(events)
    if len({event.id for event in events}) < len(events):
        raise PhaseError("two events have the same id")
    documents = [json.loads(event.to_json()) for event in events]
    if not documents:
        raise PhaseError("there are no events")
    document = dict(documents[0], events=[event for one in documents for event in one["events"]])
    _write(path, json.dumps(document))


def tensors(events):
    """Events as padded arrays.

    Returns:
        a dict of ``trajectory`` (N, T + 1, 4, 5), ``mask`` (N, T + 1) that is true where an event has a row, ``entities`` (N, 4) that
        is true where it has an entity, ``actions`` (N, T, 2) with -1 where there is none, ``kind`` and ``relation`` (N,) as text,
        ``attitudes`` (N, 2), and ``id``; T is the length of the longest event. Padding is 0.

    Raises:
        PhaseError: if there are no events.
    """
    events = list(events)
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
    """Rows of all events as a ``pandas.DataFrame``: ``event``, ``kind``, ``relation``, ``step``, ``entity``, ``x``, ``y``, ``vx``,
    ``vy``, ``angle`` and ``action``, the name of what an agent did from that row on."""
    import pandas

    names = ["agent 0", "agent 1", "object 0", "object 1"]
    frames = []
    for event in events:
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


def _write(path, text):
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise PhaseError(f"{path}: {error.strerror or error}") from error
