"""Events as Minari datasets for offline learning: one dataset of each agent. It needs ``phase-events[minari]``."""

import json

import gymnasium
import numpy as np
from minari import create_dataset_from_buffers
from minari.data_collector import EpisodeBuffer

from ._native import ACTIONS, PhaseError
from .env import PhaseParallelEnv


def export(events, dataset_id, *, observation="view"):
    """Replays simulated events and stores each agent's side of them.

    Args:
        events: simulated events; their actions are replayed in the engine that they were simulated in.
        dataset_id: name and version, such as ``phase/demo-v0``; the datasets are ``phase/demo-agent0-v0`` and ``phase/demo-agent1-v0``,
            in Minari's folder (``MINARI_DATASETS_PATH``).
        observation: ``view``, what the agent sees and feels, or ``state``, everything.

    Returns:
        both datasets, as ``minari.load_dataset`` loads them. Every episode has the event's id, kind, relation and scene in its
        metadata.

    Raises:
        PhaseError: for an event without actions, one whose motion is not that of its actions, and an id without a version.
    """
    events = list(events)
    if not events:
        raise PhaseError("there are no events")
    name, _, version = dataset_id.rpartition("-v")
    if not name or not version.isdigit():
        raise PhaseError(f"dataset_id is a name and a version, such as phase/demo-v0, not {dataset_id!r}")
    buffers = ([], [])
    for number, event in enumerate(events):
        for agent, buffer in enumerate(_episodes(event, number, observation)):
            buffers[agent].append(buffer)
    datasets = []
    for agent, episodes in enumerate(buffers):
        env = gymnasium.make("PHASE-v0", agent=agent, observation=observation)
        datasets.append(
            create_dataset_from_buffers(
                dataset_id=f"{name}-agent{agent}-v{version}",
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
        )
    return tuple(datasets)


def _episodes(event, number, observation):
    if event.actions is None or event.substeps is None:
        raise PhaseError(f"the event {event.id} is a recording: it has no actions to replay")
    engine = json.loads(event.to_json())["events"][0].get("settings", {}).get("engine", "world")
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
            seed=0,
            observations=list(seen[agent]),
            actions=[np.int64(action) for action in event.actions[:, agent]],
            rewards=rewards[agent],
            terminations=[False] * event.steps,
            truncations=ends,
            infos={},
            options={"event": json.dumps(labels), "actions": ",".join(ACTIONS)},
        )
        for agent in (0, 1)
    ]
