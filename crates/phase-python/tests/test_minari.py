"""Minari reads what is exported."""

import json

import numpy as np
import pytest
from conftest import QUICK

import phase_events as phase

minari = pytest.importorskip("minari")
pytest.importorskip("h5py")
pytest.importorskip("PIL")


@pytest.mark.filterwarnings("ignore:.*eval_env.*:UserWarning")
def test_minari_loads_both_agents(event, tmp_path, monkeypatch):
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    from phase_events.minari import export

    other = phase.simulate(phase.sample_scene("chasing", seed=1), seed=2, max_steps=20, parameters=QUICK, id="other")
    export([event, other], "phase/test-v0")
    for agent in (0, 1):
        dataset = minari.load_dataset(f"phase/test-agent{agent}-v0")
        assert dataset.total_episodes == 2
        assert dataset.total_steps == event.steps + other.steps
        first = next(dataset.iterate_episodes())
        assert np.array_equal(first.actions, event.actions[:, agent])
        assert first.observations.shape == (event.steps + 1, phase.OBSERVATION_SIZE)
        assert first.truncations[-1] and not first.truncations[:-1].any()
        (metadata,) = dataset.storage.get_episode_metadata([0])
        options = metadata["options"]
        options = json.loads(options) if isinstance(options, str) else options
        assert json.loads(options["event"])["event"] == event.id
    with pytest.raises(phase.PhaseError):
        export([], "phase/none-v0")
    with pytest.raises(phase.PhaseError):
        export([event], "phase/none")
