"""PyTorch's loader batches events."""

import pytest
from conftest import QUICK

import phase_events as phase

torch = pytest.importorskip("torch")


def test_batches(event):
    from phase_events.torch import EventDataset, collate

    other = phase.simulate(phase.sample_scene("chasing", seed=1), seed=2, max_steps=20, parameters=QUICK, id="other")
    loader = torch.utils.data.DataLoader(EventDataset([event, other]), batch_size=2, collate_fn=collate)
    (batch,) = loader
    assert batch["trajectory"].shape == (2, event.steps + 1, 4, 5)
    assert batch["mask"].sum(dim=1).tolist() == [event.steps + 1, other.steps + 1]
    assert (batch["actions"][1, other.steps :] == -1).all()
