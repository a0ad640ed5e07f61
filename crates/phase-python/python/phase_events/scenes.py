"""Scenes: walls, bodies, goals and attitudes."""

from collections.abc import Mapping

from ._check import path_of, seed_of, text, to_json
from ._native import PhaseError, Scene

KINDS = ("helping", "hindering", "chasing", "competing", "collaborating", "independent")


def scene(description):
    """A scene from a dict, JSON text, or a :class:`Scene`.

    >>> found = sample_scene("helping", seed=1)
    >>> scene(found.to_dict()).kind
    'helping'

    Args:
        description: its members are those of ``scene`` in a ``phase-events/1`` file (docs/reference/formats/events.md): ``layout``, ``objects``,
            ``event`` and ``agents``.

    Returns:
        a valid :class:`Scene`.

    Raises:
        PhaseError: naming the field and the rule, if the description is no valid scene.
    """
    if isinstance(description, Scene):
        return description
    if isinstance(description, Mapping):
        description = to_json("the scene", dict(description))
    if not isinstance(description, str):
        raise PhaseError(f"a scene is a Scene, a dict or JSON text, not {type(description).__name__}")
    return Scene.from_json(text("a scene", description))


def sample_scene(kind=None, *, variant=None, preset=None, seed=0):
    """Draws a scene in which no goal holds at the start and the agents can do what its kind requires.

    Args:
        kind: ``helping``, ``hindering``, ``chasing``, ``competing``, ``collaborating`` or ``independent``; any of them if ``None``.
        variant: a variant of the kind, such as ``fetch`` or ``block`` (docs/reference/dataset.md).
        preset: draw as a preset does instead, such as ``phase-500`` or ``phase-pairs``, or a file in the format ``phase-preset/3``.
        seed: a whole number from 0 to 2**64 - 1. One seed gives one scene, on every machine.

    Returns:
        a :class:`Scene`.

    Raises:
        PhaseError: for unknown names, and if no scene was found.
    """
    seed = seed_of(seed)
    if preset is None:
        kind = None if kind is None else text("kind", kind)
        variant = None if variant is None else text("variant", variant)
        return Scene.sample(kind, variant, seed)
    if kind is not None or variant is not None:
        raise PhaseError("a preset draws the kind and the variant itself; give either a preset or these")
    return Scene.sample_preset(text("preset", path_of(preset)), seed)


def as_source(scenes):
    """A function from a seed to a :class:`Scene`, as environments draw the scenes of their episodes.

    >>> as_source("chasing")(7).kind
    'chasing'

    Args:
        scenes: a scene or a description of one, a kind, a preset (``"preset:phase-500"`` or a path that ends in ``.json``), a list of
            scenes, one of which the seed chooses, a function of the seed, or ``None`` for scenes of all kinds.

    Raises:
        PhaseError: for an empty list, and for anything that is not a scene.
    """
    if scenes is None or isinstance(scenes, str) and scenes in KINDS:
        return _Sampled(kind=scenes)
    if isinstance(scenes, str) and (scenes.startswith("preset:") or scenes.endswith(".json")):
        return _Sampled(preset=scenes.removeprefix("preset:"))
    if callable(scenes):
        return _Made(scenes)
    if isinstance(scenes, str) and not scenes.lstrip().startswith("{"):
        raise PhaseError(f"kind must be one of {', '.join(KINDS)}, not {scenes!r}; scenes may also be preset:NAME, a file of a preset, or scenes")
    if isinstance(scenes, (list, tuple)):
        if not scenes:
            raise PhaseError("the list of scenes is empty")
        return _Listed([scene(one) for one in scenes])
    return _Listed([scene(scenes)])


# Classes, not functions within a function, which could not be pickled.


class _Sampled:
    def __init__(self, **drawn):
        self._drawn = drawn

    def __call__(self, seed):
        return sample_scene(seed=seed, **self._drawn)


class _Made:
    def __init__(self, make):
        self._make = make

    def __call__(self, seed):
        return scene(self._make(seed))


class _Listed:
    def __init__(self, scenes):
        self._scenes = scenes

    def __call__(self, seed):
        return self._scenes[seed % len(self._scenes)]
