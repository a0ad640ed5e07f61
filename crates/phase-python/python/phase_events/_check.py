"""Checks of what callers give. Whatever fails raises :class:`PhaseError`."""

import json
import operator
import os
from collections.abc import Mapping

import numpy as np

from ._native import ACTIONS, PhaseError

MOST_STEPS = 10**9
"""The greatest length of an episode (steps). A world keeps two bytes a step."""


def whole(name, number, low, high):
    """A whole number of any type, numpy's and PyTorch's too, as an ``int``; ``True`` and 1.0 are none."""
    try:
        found = operator.index(number)
    except TypeError:
        found = None
    is_bool = isinstance(number, bool) or "bool" in str(getattr(number, "dtype", ""))
    if found is None or is_bool or not low <= found <= high:
        raise PhaseError(f"{name} is a whole number from {low} to {high}, not {number!r}")
    return found


def seed_of(seed):
    """A seed as an ``int``.

    Args:
        seed: a whole number from 0 to 2**64 - 1, of any type.

    Raises:
        PhaseError: for anything else.
    """
    return whole("a seed", seed, 0, 2**64 - 1)


def as_action(action):
    """The number of an action as an ``int``.

    Args:
        action: a whole number from 0 to 13, of any type.

    Raises:
        PhaseError: for anything else.
    """
    return whole("an action", action, 0, len(ACTIONS) - 1)


def text(name, value):
    """Text that can be written in UTF-8."""
    if not isinstance(value, str):
        raise PhaseError(f"{name} is text, not {value!r}")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise PhaseError(f"{name} is no text: {error}") from error
    return str(value)


def choice(name, value, options):
    """One of some names."""
    if not isinstance(value, str) or value not in options:
        raise PhaseError(f"{name} must be one of {', '.join(options)}, not {value!r}")
    return value


def path_of(path):
    """A path as text, in which bytes that are none are kept as Python keeps them."""
    try:
        name = os.fsdecode(path)
    except TypeError:
        raise PhaseError(f"a path is text or a pathlib.Path, not {path!r}") from None
    if not name:
        raise PhaseError("a path must not be empty")
    return name


def floats(name, values, shape):
    """32-bit floats in C's order. In ``shape``, -1 is any length."""
    try:
        array = np.ascontiguousarray(values, dtype=np.float32)
    except (TypeError, ValueError) as error:
        raise PhaseError(f"{name}: {error}") from error
    # `ascontiguousarray` makes a vector of a single number.
    found = np.shape(values)
    if len(found) != len(shape) or any(want not in (-1, have) for want, have in zip(shape, found, strict=True)):
        wanted = ", ".join("any" if want < 0 else str(want) for want in shape)
        raise PhaseError(f"{name} has the shape ({wanted}), not {found}")
    return array


def to_json(name, value):
    """JSON, in which numpy's numbers and arrays are numbers and lists."""

    def plain(value):
        if hasattr(value, "tolist"):
            return value.tolist()
        if isinstance(value, Mapping):
            return dict(value)
        raise TypeError(f"{type(value).__name__} has no form in JSON")

    try:
        return json.dumps(value, default=plain)
    except (TypeError, ValueError, RecursionError) as error:
        raise PhaseError(f"{name}: {error}") from error
