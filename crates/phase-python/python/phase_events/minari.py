"""Events as Minari datasets for offline learning: one dataset of each agent. It needs ``phase-events[minari]``."""

import json

import gymnasium
import minari
import numpy as np
from minari import create_dataset_from_buffers
from minari.data_collector import EpisodeBuffer

from ._check import choice, text, whole
from ._native import ACTIONS, PhaseError
from .env import VECTORS, PhaseEnv, PhaseParallelEnv
from .events import _list
from .policies import ReplayPolicy


def export(events, dataset_id, *, observation="view"):
    """Replays simulated events and stores each agent's side of them.

    Args:
        events: simulated events of one engine; their actions are replayed in it.
        dataset_id: name and version, such as ``phase/demo-v0``; the datasets are ``phase/demo-agent0-v0`` and ``phase/demo-agent1-v0``,
            in Minari's folder (``MINARI_DATASETS_PATH``).
        observation: ``view``, what the agent sees and feels, or ``state``, everything. Minari keeps pictures with losses, so there are none.

    Returns:
        both datasets, as ``minari.load_dataset`` loads them. Every episode has the event's id, kind, relation and scene, and the
        partner's actions, in its metadata, and no seed, from which none of them follows: :func:`environment` plays it.

    Raises:
        PhaseError: for an event without actions, one whose motion is not that of its actions, events of several engines, an id without
            a version, and one that there is already.
    """
    events = _list(events)
    if not events:
        raise PhaseError("there are no events")
    name, _, version = text("dataset_id", dataset_id).rpartition("-v")
    if not name or not version.isdigit():
        raise PhaseError(f"dataset_id is a name and a version, such as phase/demo-v0, not {dataset_id!r}")
    ids = [f"{name}-agent{agent}-v{version}" for agent in (0, 1)]
    present = [one for one in ids if one in minari.list_local_datasets()]
    if present:
        raise PhaseError(f"dataset_id: there is a dataset {present[0]} already")
    choice("observation", observation, VECTORS)
    engines = {_engine(event) for event in events}
    if len(engines) > 1:
        raise PhaseError(f"the events are of several engines, {' and '.join(sorted(engines))}; export those of each by themselves")
    (engine,) = engines
    buffers = ([], [])
    for number, event in enumerate(events):
        for agent, buffer in enumerate(_episodes(event, number, observation, engine)):
            buffers[agent].append(buffer)
    datasets = []
    for agent, episodes in enumerate(buffers):
        env = gymnasium.make("PHASE-v0", agent=agent, observation=observation, engine=engine)
        try:
            dataset = create_dataset_from_buffers(
                dataset_id=ids[agent],
                buffer=episodes,
                env=env,
                action_space=env.action_space,
                observation_space=env.observation_space,
                algorithm_name="PHASE",
                code_permalink="",
                author="",
                author_email="",
                description=f"PHASE events as agent {agent} saw them",
            )
        except ValueError as error:
            raise PhaseError(f"dataset_id: {error}") from error
        datasets.append(dataset)
    return tuple(datasets)


def environment(dataset, episode):
    """The environment of an episode: its scene and engine, and a partner that does what it did. The actions of the episode lead to its
    observations and rewards, bit for bit; with others the partner does the same.

    Args:
        dataset: one of those of :func:`export`.
        episode: the number of the episode, from 0.

    Returns:
        a :class:`~phase_events.env.PhaseEnv`, to be reset.

    Raises:
        PhaseError: for a dataset of another origin, and for an episode that there is not.
    """
    episode = whole("episode", episode, 0, dataset.total_episodes - 1)
    (metadata,) = dataset.storage.get_episode_metadata([episode])
    options = metadata.get("options", {})
    options = json.loads(options) if isinstance(options, str) else options
    if "event" not in options or "partner_actions" not in options:
        raise PhaseError(f"dataset: the episode {episode} was not exported by phase_events.minari")
    scene = json.loads(options["event"])["scene"]
    partner = ReplayPolicy([int(action) for action in options["partner_actions"].split(",") if action])
    given = dataset.env_spec.kwargs
    steps = max(int(metadata["total_steps"]), 1)
    return PhaseEnv(
        scene,
        agent=given["agent"],
        partner=partner,
        observation=given["observation"],
        engine=given["engine"],
        max_steps=steps,
    )


def _engine(event):
    if event.actions is None or event.substeps is None:
        raise PhaseError(f"the event {event.id} is a recording: it has no actions to replay")
    return json.loads(event.to_json())["events"][0].get("settings", {}).get("engine", "world")


def _episodes(event, number, observation, engine):
    env = PhaseParallelEnv(event.scene, observation=observation, engine=engine, max_steps=max(event.steps, 1))
    observations, _ = env.reset(seed=0)
    seen = [[observations[agent]] for agent in env.possible_agents]
    rewards = ([], [])
    for step, actions in enumerate(event.actions):
        observations, reward, *_ = env.step({"agent_0": actions[0], "agent_1": actions[1]})
        for agent, name in enumerate(env.possible_agents):
            seen[agent].append(observations[name])
            rewards[agent].append(reward[name])
        there = env.state()[: event.substeps.shape[1]]
        if not np.array_equal(there, event.substeps[5 * step + 4]):
            raise PhaseError(f"the event {event.id} does not follow from its actions at step {step}")
    ends = [False] * (event.steps - 1) + [True]
    labels = {"event": event.id, "kind": event.kind, "relation": event.relation, "scene": event.scene.to_json()}
    return [
        EpisodeBuffer(
            id=number,
            # The scene is not drawn, so no seed gives the episode.
            seed=None,
            observations=list(seen[agent]),
            actions=[np.int64(action) for action in event.actions[:, agent]],
            rewards=rewards[agent],
            terminations=[False] * event.steps,
            truncations=ends,
            infos={},
            options={
                "event": json.dumps(labels),
                "actions": ",".join(ACTIONS),
                "partner_actions": ",".join(str(action) for action in event.actions[:, 1 - agent]),
            },
        )
        for agent in (0, 1)
    ]
