"""Events as a PyTorch dataset. It needs ``phase-events[torch]``."""

import torch

from .events import RELATIONS, arrays, pad
from .scenes import KINDS

__all__ = ["KINDS", "RELATIONS", "EventDataset", "collate"]


class EventDataset(torch.utils.data.Dataset):
    """Events as a PyTorch dataset; each is read when it is asked for.

    >>> data = EventDataset(load_events("out/demo"))                                      # doctest: +SKIP
    >>> loader = torch.utils.data.DataLoader(data, batch_size=8, collate_fn=collate)      # doctest: +SKIP

    Args:
        events: a sequence of :class:`phase_events.Event`, or of :class:`phase_events.ObservedEvent`, which have no labels.

    An item has the members, shapes and types of :func:`phase_events.events.arrays`, as tensors; ``id`` is text. :func:`collate` makes
    batches of them.
    """

    def __init__(self, events):
        self._events = events

    def __len__(self):
        return len(self._events)

    def __getitem__(self, index):
        return _tensors(arrays(self._events[index]))


def collate(items):
    """A batch of items, with the members, shapes, types and masks of :func:`phase_events.events.pad`, as tensors.

    Args:
        items: at least one item of an :class:`EventDataset`.

    Raises:
        PhaseError: for an empty batch, and if some items have labels and some have none.
    """
    numbers = [{name: value if name == "id" else value.numpy() for name, value in item.items()} for item in items]
    return _tensors(pad(numbers))


def _tensors(members):
    return {name: value if name == "id" else torch.as_tensor(value) for name, value in members.items()}
