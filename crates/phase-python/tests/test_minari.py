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
        assert "seed" not in metadata, "no seed leads to the episode"
    with pytest.raises(phase.PhaseError):
        export([], "phase/none-v0")
    with pytest.raises(phase.PhaseError, match="already"):
        export([event], "phase/test-v0")
    with pytest.raises(phase.PhaseError):
        export([event], "phase/none")
    # Minari would keep them as .jpg, from which an episode could not be played again bit for bit.
    with pytest.raises(phase.PhaseError, match="observation must be one of view, state, not 'image'"):
        export([event], "phase/pictures-v0", observation="image")


@pytest.mark.filterwarnings("ignore:.*eval_env.*:UserWarning")
@pytest.mark.parametrize("engine", ["world", "forward"])
def test_an_episode_can_be_played(engine, tmp_path, monkeypatch):
    """The environment of an episode has its scene, engine and partner: its actions give what is stored."""
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    from phase_events.minari import environment, export

    def simulated(seed, engine=engine):
        scene = phase.sample_scene("helping", seed=seed)
        return phase.simulate(scene, seed, engine=engine, max_steps=8 + seed, parameters=QUICK, id=f"e{seed}-{engine}")

    export([simulated(1), simulated(2)], "phase/played-v0", observation="state")
    for agent in (0, 1):
        dataset = minari.load_dataset(f"phase/played-agent{agent}-v0")
        recovered = dataset.recover_environment()
        for number, episode in enumerate(dataset.iterate_episodes()):
            env = environment(dataset, number)
            observation, _ = env.reset()
            assert np.array_equal(observation, episode.observations[0])
            for step, action in enumerate(episode.actions):
                observation, reward, _, truncated, _ = env.step(action)
                assert np.array_equal(observation, episode.observations[step + 1])
                assert (reward, truncated) == (episode.rewards[step], episode.truncations[step])
            # What Minari itself recovers has the engine and the view; it is given the scene.
            scene = env.scene
            observation, _ = recovered.reset(options={"scene": scene})
            assert np.array_equal(observation, episode.observations[0])
        for wrong in (2, -1, True, 0.5):
            with pytest.raises(phase.PhaseError):
                environment(dataset, wrong)
    both = [simulated(1, "world"), simulated(1, "forward")]
    with pytest.raises(phase.PhaseError, match="engines"):
        export(both, "phase/both-v0")
