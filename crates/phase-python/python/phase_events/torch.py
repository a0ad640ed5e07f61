"""Events as a PyTorch dataset. It needs ``phase-events[torch]``."""

import torch

from ._native import PhaseError

KINDS = ("helping", "hindering", "chasing", "competing", "collaborating", "independent")
RELATIONS = ("friendly", "adversarial", "neutral")


class EventDataset(torch.utils.data.Dataset):
    """Events as a PyTorch dataset; each is read when it is asked for.

    >>> data = EventDataset(load_events("out/demo"))                                      # doctest: +SKIP
    >>> loader = torch.utils.data.DataLoader(data, batch_size=8, collate_fn=collate)      # doctest: +SKIP

    Args:
        events: a sequence of :class:`Event`.

    An item is a dict of tensors: ``trajectory`` (T + 1, entities, 5) float32, columns x, y (u), vx, vy (u/s), angle (rad); ``actions``
    (T, 2) int64, -1 where there is none; ``kind``, an index of ``KINDS``; ``relation``, an index of ``RELATIONS``; ``attitudes`` (2,).
    :func:`collate` makes batches of them.
    """

    def __init__(self, events):
        self._events = events

    def __len__(self):
        return len(self._events)

    def __getitem__(self, index):
        event = self._events[index]
        actions = torch.full((event.steps, 2), -1, dtype=torch.int64)
        if event.actions is not None:
            actions[: len(event.actions)] = torch.from_numpy(event.actions)
        return {
            "trajectory": torch.from_numpy(event.trajectory.copy()),
            "actions": actions,
            "kind": torch.tensor(KINDS.index(event.kind)),
            "relation": torch.tensor(RELATIONS.index(event.relation)),
            "attitudes": torch.tensor(event.attitudes),
        }


def collate(items):
    """A batch of items, padded with 0 (actions with -1) to the longest event and to four entities.

    Args:
        items: at least one item of an :class:`EventDataset`.

    Returns:
        a dict of the members of an item with a first dimension of N items, and of ``mask`` (N, T + 1) and ``entities`` (N, 4), which are
        true where there is a row and an entity.

    Raises:
        PhaseError: for an empty batch.
    """
    if not items:
        raise PhaseError("a batch has at least one event")
    longest = max(len(item["trajectory"]) for item in items)
    count = len(items)
    trajectory = torch.zeros(count, longest, 4, 5)
    mask = torch.zeros(count, longest, dtype=torch.bool)
    entities = torch.zeros(count, 4, dtype=torch.bool)
    actions = torch.full((count, longest - 1, 2), -1, dtype=torch.int64)
    for k, item in enumerate(items):
        rows, present, _ = item["trajectory"].shape
        trajectory[k, :rows, :present] = item["trajectory"]
        mask[k, :rows] = True
        entities[k, :present] = True
        actions[k, : len(item["actions"])] = item["actions"]
    stacked = {name: torch.stack([item[name] for item in items]) for name in ("kind", "relation", "attitudes")}
    return {"trajectory": trajectory, "mask": mask, "entities": entities, "actions": actions, **stacked}
