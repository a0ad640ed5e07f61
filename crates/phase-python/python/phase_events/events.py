"""Events: simulated, read from files and datasets, as arrays."""

import json
import numbers
import operator
import os
import warnings
from collections.abc import Sequence
from functools import cached_property

import numpy as np

from . import _native
from ._check import choice, floats, path_of, seed_of, text, to_json, whole
from ._native import ACTIONS, LANDMARKS, MOST_STEPS, PhaseError
from .scenes import KINDS
from .scenes import scene as as_scene

SIDES = (64, 2000)
"""The least and the greatest side of a picture (pixels)."""
PALETTES = ("paper", "accessible")
"""The colours of pictures: the paper's, and colours that people with a colour vision deficiency can tell apart."""
RELATIONS = ("friendly", "adversarial", "neutral")
"""The relations of two agents, by their indices in arrays."""
MOST_WALLS = 4
"""The greatest number of inner walls of a layout."""
FRAMES_PER_STEP = 5


class _Seen:
    """Pictures of what can be seen. A subclass has ``native``, ``observed`` and ``steps``."""

    def picture(self, row=-1, side=480, palette="paper"):
        """A picture at a row of the trajectory.

        Args:
            row: 0 for the initial state to ``steps``; negative numbers count from the end.
            side: the side of the picture (pixels), 64 to 2000.
            palette: ``paper`` or ``accessible`` (docs/reference/commands.md).

        Returns:
            (side, side, 3) 8-bit numbers: red, green, blue, the first row at the top.

        Raises:
            PhaseError: for a row that the event does not have, a side outside 64 to 2000, and an unknown palette.
        """
        return self.frames([row], side, palette)[0]

    def frames(self, rows=None, side=480, palette="paper"):
        """Pictures at several rows of the trajectory, which are 0.25 s of video apart.

        >>> event.frames(8).shape     # the frames that a model with a budget of eight sees   # doctest: +SKIP
        (8, 480, 480, 3)

        Args:
            rows: a number of rows, at least 1, evenly spaced from the first to the last (of a single one: the last); a list of rows,
                as of :meth:`picture`; or ``None`` for all.
            side: the side of a picture (pixels), 64 to 2000.
            palette: ``paper`` or ``accessible``.

        Returns:
            (N, side, side, 3) 8-bit numbers, as of :meth:`picture`.

        Raises:
            PhaseError: as of :meth:`picture`, and for pictures of more than 4 GiB.
        """
        if rows is None:
            rows = range(self.steps + 1)
        elif isinstance(rows, (list, tuple, range, np.ndarray)) and np.ndim(rows) == 1:
            rows = [whole("a row", row, -self.steps - 1, self.steps) % (self.steps + 1) for row in rows]
        else:
            count = whole("rows", rows, 1, MOST_STEPS)
            rows = [self.steps] if count == 1 else np.linspace(0, self.steps, count).round().astype(int).tolist()
        return self._renderer(side, palette).rows(self.observed.native, list(rows))

    def clip(self, start=0, stop=None, side=480, palette="paper"):
        """Frames of the video of :meth:`save_video` as an array: 20 a second, so that frame 5 t is that after step t.

        Args:
            start: the first frame, from 0.
            stop: the frame after the last; ``None`` for all.
            side: the side of a frame (pixels), 64 to 2000.
            palette: ``paper`` or ``accessible``.

        Returns:
            (N, side, side, 3) 8-bit numbers, as of :meth:`picture`; fewer frames than asked for where the video ends.

        Raises:
            PhaseError: for a stop before the start, as of :meth:`picture`, and for frames of more than 4 GiB.
        """
        most = FRAMES_PER_STEP * (MOST_STEPS + 1)
        start = whole("start", start, 0, most)
        stop = most if stop is None else whole("stop", stop, start, most)
        return self._renderer(side, palette).clip(self.native, start, stop - start)

    def save_video(self, path, side=480, palette="paper"):
        """Writes an .mp4 (H.264) of 20 frames a second, five a step. Where there are no substeps, bodies go straight from row to row.

        Args:
            path: the file. One that exists is replaced.
            side: the side of the video (pixels), 64 to 2000, even.
            palette: ``paper`` or ``accessible``.

        Raises:
            PhaseError: for another side or palette, and if the file cannot be written; an older file of that name is unchanged then.
        """
        if whole("side", side, *SIDES) % 2:
            raise PhaseError(f"the side of a video is even, not {side}")
        self._renderer(side, palette).video(self.native, path_of(path))

    @staticmethod
    def _renderer(side, palette):
        return _native.Renderer(whole("side", side, *SIDES), choice("palette", palette, PALETTES))


class ObservedEvent(_Seen):
    """An event as a method may see it: walls, sizes and motion, without labels, actions and strengths.

    >>> seen = event.observed                                                     # doctest: +SKIP
    >>> mine = ObservedEvent((0, None), [0, 3], [1], trajectory, id="mine")       # doctest: +SKIP
    >>> infer(mine)["relation"]                                                   # doctest: +SKIP

    :attr:`Event.observed` and :func:`load_observed` make it, or motion of one's own. It does not change, and can be copied and pickled.

    Args:
        layout: base, 0 to 21, and reflection, 0 to 3 or ``None`` (docs/reference/formats/events.md has a picture of all).
        agent_size_levels: two numbers, 0 to 3: radius 0.8, 1.2, 1.6 and 1.01 u.
        object_size_levels: up to two of them.
        trajectory: (steps + 1, entities, 5): x, y (u), vx, vy (u/s of physics), angle (rad) of each entity,
            agents first. A row is 0.25 s of video and 1/12 s of physics after the one before it; velocities
            of another unit are warned of.
        id: its name.

    Raises:
        PhaseError: naming the argument and the rule.
    """

    def __init__(self, layout, agent_size_levels, object_size_levels, trajectory, id="event"):
        base, flip = _pair("layout", layout)
        layout = whole("the base of layout", base, 0, 21), None if flip is None else whole("the reflection of layout", flip, 0, 3)
        agents = [whole("a size level", level, 0, 3) for level in _pair("agent_size_levels", agent_size_levels)]
        objects = [whole("a size level", level, 0, 3) for level in _items("object_size_levels", object_size_levels)]
        self._native = _native.Observed(text("id", id), layout, agents, objects, floats("trajectory", trajectory, (-1, -1, 5)))
        self._warn(stacklevel=3)

    def _warn(self, stacklevel):
        for sentence in self._native.warnings:
            warnings.warn(f"event {self.id}: {sentence}", stacklevel=stacklevel)

    @classmethod
    def of_native(cls, native):
        """One of the native module."""
        made = cls.__new__(cls)
        made._native = native
        return made

    def __reduce__(self):
        # Without the arrays, which are made again.
        return ObservedEvent.of_native, (self._native,)

    def __repr__(self):
        return f"<ObservedEvent {self.id}: {len(self.radii)} entities, {self.steps} steps>"

    @property
    def native(self):
        """The event of the native module, which methods and renderers take."""
        return self._native

    @property
    def observed(self):
        """This event: where a method takes an :class:`Event`, either will do."""
        return self

    @property
    def id(self):
        """The name of the event, which is no evidence."""
        return self._native.id

    @property
    def noise(self):
        """Standard deviations of positions (u), velocities (u/s of physics) and angles (rad), if it was
        tracked, or else ``None``."""
        return self._native.noise

    @property
    def not_judged(self):
        """What nobody can judge, because the video did not show it, each as a sentence."""
        return self._native.not_judged

    @property
    def steps(self):
        """The number of steps, each of 0.25 s of video."""
        return self._native.steps

    @property
    def layout(self):
        """Base, 0 to 21, and reflection, 0 to 3 or ``None``, of the walls."""
        return self._native.layout

    @cached_property
    def walls(self):
        """The inner walls: (walls, 2, 2) 32-bit floats, both ends of each, x and y (u)."""
        return self._native.walls

    @property
    def landmarks(self):
        """The centres of the four landmarks, (4, 2), x and y (u). They are the same in every event; a landmark is 5 u wide."""
        return LANDMARKS.copy()

    @cached_property
    def size_levels(self):
        """The size level of each entity, 0 to 3: (entities,)."""
        return self._native.size_levels

    @cached_property
    def radii(self):
        """The radius of each entity (u), agents first: (entities,) 32-bit floats. An agent is 3 radii wide and 2 high."""
        return self._native.radii

    @cached_property
    def trajectory(self):
        """The motion: (steps + 1, entities, 5) 32-bit floats, columns x, y (u), vx, vy (u/s of physics),
        angle (rad).

        Entities are agents, then objects. Row 0 is the initial state, every other the mean over the five
        substeps of its step.
        """
        return self._native.trajectory()

    def prefix(self, steps):
        """The first steps of the event, all of which a forecast may look at.

        Args:
            steps: the number of steps, at least 0. An event that is shorter is returned whole.

        Raises:
            PhaseError: for another number.
        """
        return ObservedEvent.of_native(self._native.prefix(whole("steps", steps, 0, MOST_STEPS)))


class Event(_Seen):
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
        """The number of steps, each of 0.25 s of video."""
        return self._native.steps

    @property
    def scene(self):
        """The :class:`Scene` that it happened in."""
        return self._native.scene

    @cached_property
    def observed(self):
        """What a method may see of it, an :class:`ObservedEvent`: walls, landmarks, sizes and motion, without labels."""
        return ObservedEvent.of_native(_native.Observed.of_event(self._native))

    @property
    def trajectory(self):
        """The motion as methods observe it, as :attr:`ObservedEvent.trajectory`: (steps + 1, entities, 5)."""
        return self.observed.trajectory

    @cached_property
    def substeps(self):
        """The true state after each of the five substeps of every step: (5 · steps, entities, 6) 32-bit
        floats, columns x, y (u), angle (rad), vx, vy (u/s of physics), angular velocity (rad/s of physics);
        ``None`` for a recording."""
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
    def goal_indices(self):
        """Both agents' goals, as indices of ``GOALS``: (2,)."""
        return self._native.goal_indices

    @property
    def attitudes(self):
        """Both agents' attitudes: 1 helps, -1 hinders, 0 neither: (2,)."""
        return self._native.attitudes

    @property
    def strength_levels(self):
        """Both agents' levels of strength, 0 to 3, for a force of 150, 300, 450 or 600 N: (2,)."""
        return self._native.strength_levels

    def to_json(self):
        """A document of the format ``phase-events/1`` with this event."""
        return self._native.to_json()

    def save(self, path):
        """Writes :meth:`to_json` to a file, whole or not at all.

        Raises:
            PhaseError: if it cannot be written; an older file of that name is unchanged then.
        """
        _native.write_text(path_of(path), self.to_json())


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


def load_observed(path):
    """What a method may see of the events of a file, which need not have labels.

    Args:
        path: a file of the form ``phase-events/1`` in which ``event``, ``relation``, and ``goal``, ``alpha`` and ``strength_level`` of
            agents may be absent; they are not looked at.

    Returns:
        a list of :class:`ObservedEvent`.

    Raises:
        PhaseError: naming file, event, field and rule.
    """
    path = path_of(path)
    observed = [ObservedEvent.of_native(one) for one in _native.Observed.read(path)]
    for one in observed:
        one._warn(stacklevel=3)
    return observed


def track(source, *, frame_rate=20, id="video", map=None):
    """What a video shows, as an event without labels.

    Args:
        source: the path of a video (.mp4, .gif, others through the program ffmpeg), of a folder of PNG pictures, or of a table with
            columns ``time`` (s), ``body``, ``x``, ``y`` and perhaps ``angle`` (.csv, .jsonl); or the frames of a video, (frames, height,
            width, 3), ``uint8``.
        frame_rate: frames a second, 4 to 240, of an array or of a folder of pictures; files of other kinds know theirs.
        id: the name of the event, for an array.
        map: of a file, the bodies that are agent 0, agent 1 and the objects, by colour or number, such as ``"green,red"`` or
            ``"3,1,2"``.

    Returns:
        an :class:`ObservedEvent`. Its ``noise`` has the root mean square errors of positions (u), velocities
        (u/s of physics) and angles (rad).

    Raises:
        PhaseError: naming the file and what the pictures lack (docs/how-to/track.md).
    """
    if not (isinstance(frame_rate, numbers.Real) and 4 <= frame_rate <= 240):
        raise PhaseError(f"frame_rate must be 4 to 240, not {frame_rate!r}")
    if isinstance(source, (str, os.PathLike)):
        map = None if map is None else text("map", map)
        return ObservedEvent.of_native(_native.Observed.track(path_of(source), float(frame_rate), map))
    frames = np.asarray(source)
    if frames.dtype != np.uint8 or frames.ndim != 4 or frames.shape[-1] != 3:
        raise PhaseError(f"frames must be uint8 of shape (frames, height, width, 3), not {frames.dtype} of {frames.shape}")
    return ObservedEvent.of_native(_native.Observed.track_frames(text("id", id), np.ascontiguousarray(frames), float(frame_rate)))


def simulate(scene, seed=0, *, id="event", engine="world", max_steps=100, parameters=None):
    """Lets two PHASE minds play a scene (Algorithm 1 of the paper).

    Args:
        scene: a :class:`Scene`, a dict or JSON text.
        seed: a whole number from 0 to 2**64 - 1. One seed gives one event, on every machine.
        id: the name of the event.
        engine: ``world`` (rapier2d), ``forward`` (the kernel that minds plan in) or ``original`` (the published simulator's world, bit for bit).
        max_steps: the greatest length (steps of 0.25 s of video), 1 to 10000. The event ends earlier once
            nothing happens any more.
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


def arrays(event):
    """What a method may see of an event, and its labels, as arrays.

    Args:
        event: an :class:`Event`, or an :class:`ObservedEvent`, which has no labels.

    Returns:
        a dict; T is the number of steps, E that of entities, W that of inner walls.

        =================  =====================  ==================================================================
        ``id``             text                   the name of the event
        ``trajectory``     (T + 1, E, 5) float32  x, y (u), vx, vy (u/s of physics), angle (rad)
        ``radii``          (E,) float32           u, agents first
        ``walls``          (W, 2, 2) float32      both ends of each inner wall, x and y (u)
        ``landmarks``      (4, 2) float32         centres, x and y (u)
        =================  =====================  ==================================================================

        and of an :class:`Event` also what only training may look at:

        ====================  ================  ===========================================================================
        ``goals``             (2,) int64        indices of ``GOALS``
        ``relation``          int64             index of ``RELATIONS``
        ``kind``              int64             index of ``KINDS``
        ``attitudes``         (2,) int64        1 helps, -1 hinders, 0 neither
        ``strength_levels``   (2,) int64        0 to 3
        ``actions``           (T, 2) int64      indices of ``ACTIONS``, -1 where none is known
        ====================  ================  ===========================================================================

    Raises:
        PhaseError: for anything but an event.
    """
    (event,) = _list([event], (Event, ObservedEvent))
    seen = event.observed
    found = {
        "id": event.id,
        "trajectory": seen.trajectory.copy(),
        "radii": seen.radii.copy(),
        "walls": seen.walls.copy(),
        "landmarks": seen.landmarks,
    }
    if isinstance(event, Event):
        actions = np.full((event.steps, 2), -1, dtype=np.int64)
        if event.actions is not None:
            actions[: len(event.actions)] = event.actions
        found |= {
            "goals": event.goal_indices,
            "relation": np.int64(RELATIONS.index(event.relation)),
            "kind": np.int64(KINDS.index(event.kind)),
            "attitudes": event.attitudes,
            "strength_levels": event.strength_levels,
            "actions": actions,
        }
    return found


def pad(items):
    """A batch of what :func:`arrays` gives.

    Args:
        items: at least one dict of :func:`arrays`, all with labels or all without.

    Returns:
        a dict of the same members with a first dimension of N, padded with 0 (``actions`` with -1) to the longest event, four entities and
        four walls; ``id`` is a list. ``mask`` (N, T + 1), ``entities`` (N, 4) and ``wall_mask`` (N, 4) are true where there is a row, an
        entity and a wall.

    Raises:
        PhaseError: without items, and if some have labels and some have none.
    """
    items = list(items)
    if not items:
        raise PhaseError("there are no events")
    names = items[0].keys()
    if any(item.keys() != names for item in items):
        raise PhaseError("some events have labels and some have none; take .observed of all of them")
    count, longest = len(items), max(len(item["trajectory"]) for item in items)
    whole_shapes = {
        "trajectory": (longest, 4, 5),
        "radii": (4,),
        "walls": (MOST_WALLS, 2, 2),
        "actions": (longest - 1, 2),
    }
    found = {"id": [item["id"] for item in items]}
    for name in (name for name in names if name != "id"):
        shape = whole_shapes.get(name, np.shape(items[0][name]))
        found[name] = np.full((count, *shape), -1 if name == "actions" else 0, dtype=items[0][name].dtype)
        for k, item in enumerate(items):
            place = tuple(slice(length) for length in np.shape(item[name]))
            found[name][(k, *place)] = item[name]
    lengths = {"mask": ("trajectory", longest), "entities": ("radii", 4), "wall_mask": ("walls", MOST_WALLS)}
    for mask, (name, length) in lengths.items():
        found[mask] = np.arange(length) < np.array([len(item[name]) for item in items])[:, None]
    return found


def tensors(events):
    """Events as padded arrays: what :func:`arrays` gives of each, in one batch of :func:`pad`.

    >>> batch = tensors(events)                                     # doctest: +SKIP
    >>> batch["trajectory"].shape, batch["goals"].shape             # doctest: +SKIP
    ((12, 101, 4, 5), (12, 2))

    Args:
        events: at least one :class:`Event`, or :class:`ObservedEvent`, which have no labels.

    Returns:
        a dict as of :func:`pad`.

    Raises:
        PhaseError: if there are no events.
    """
    return pad(map(arrays, _list(events, (Event, ObservedEvent))))


def to_pandas(events):
    """Events as one table. It needs ``phase-events[data]``.

    Args:
        events: at least one :class:`Event`.

    Returns:
        a ``pandas.DataFrame`` with a row for each entity at each row of a trajectory. Its columns are ``event``, ``kind``, ``relation``,
        ``step``, ``entity``, ``x``, ``y`` (u), ``vx``, ``vy`` (u/s of physics), ``angle`` (rad) and
        ``action``, the name of the agent's action from that row on.

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


def _list(events, kinds=(Event,)):
    """Events as a list; those of :class:`Events` are read."""
    names = " or ".join(kind.__name__ for kind in kinds)
    events = _items("events", events)
    wrong = next((one for one in events if not isinstance(one, kinds)), None)
    if wrong is not None:
        raise PhaseError(f"events are a sequence of {names}, not of {type(wrong).__name__}")
    return events


def _items(name, values):
    """The items of a sequence."""
    try:
        return list(values)
    except TypeError:
        raise PhaseError(f"{name} is a sequence, not {type(values).__name__}") from None


def _pair(name, values):
    """The two items of a sequence of two."""
    values = _items(name, values)
    if len(values) != 2:
        raise PhaseError(f"{name} has two members, not {len(values)}")
    return values
