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
    # The same members, shapes, types and values as without PyTorch.
    arrays = phase.events.tensors([event, other])
    assert batch.keys() == arrays.keys() and batch.pop("id") == arrays.pop("id")
    for name, tensor in batch.items():
        assert tensor.numpy().dtype == arrays[name].dtype and (tensor.numpy() == arrays[name]).all(), name
    (seen,) = torch.utils.data.DataLoader(EventDataset([event.observed, other.observed]), batch_size=2, collate_fn=collate)
    assert "goals" not in seen and torch.equal(seen["walls"], batch["walls"])


def test_answers_from_tensors(event):
    logits = torch.nn.functional.one_hot(torch.as_tensor(event.goal_indices), len(phase.GOALS)).float().requires_grad_()
    answer = phase.answer(logits, torch.tensor([1.0, 0.0, 0.0]))
    assert [goals[0]["goal"] for goals in answer["goals"]] == event.goals
