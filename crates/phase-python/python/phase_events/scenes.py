"""Scenes: walls, bodies, goals and attitudes."""

import json
from collections.abc import Mapping

from ._native import PhaseError, Scene


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
        try:
            description = json.dumps(description)
        except (TypeError, ValueError) as error:
            raise PhaseError(f"the scene is no JSON: {error}") from error
    if not isinstance(description, str):
        raise PhaseError(f"a scene is a Scene, a dict or JSON text, not {type(description).__name__}")
    return Scene.from_json(description)


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
        return Scene.sample(kind, variant, seed)
    if kind is not None or variant is not None:
        raise PhaseError("a preset draws the kind and the variant itself; give either a preset or these")
    return Scene.sample_preset(str(preset), seed)


def seed_of(seed):
    """A seed as an ``int``.

    Args:
        seed: a whole number from 0 to 2**64 - 1, of any type.

    Raises:
        PhaseError: for anything else.
    """
    try:
        number = int(seed)
        exact = number == seed
    except (TypeError, ValueError, OverflowError):
        exact = False
    if not exact or not 0 <= number < 2**64:
        raise PhaseError(f"a seed is a whole number from 0 to 2**64 - 1, not {seed!r}")
    return number


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
    kinds = ("helping", "hindering", "chasing", "competing", "collaborating", "independent")
    if scenes is None:
        return lambda seed: sample_scene(seed=seed)
    if isinstance(scenes, str) and scenes in kinds:
        return lambda seed: sample_scene(scenes, seed=seed)
    if isinstance(scenes, str) and (scenes.startswith("preset:") or scenes.endswith(".json")):
        name = scenes.removeprefix("preset:")
        return lambda seed: sample_scene(preset=name, seed=seed)
    if callable(scenes):
        return lambda seed: scene(scenes(seed))
    if isinstance(scenes, (list, tuple)):
        if not scenes:
            raise PhaseError("the list of scenes is empty")
        listed = [scene(one) for one in scenes]
        return lambda seed: listed[seed % len(listed)]
    fixed = scene(scenes)
    return lambda seed: fixed
