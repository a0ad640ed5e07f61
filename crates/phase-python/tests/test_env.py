"""Environments: other people's conformance tests, and what PHASE promises beyond them."""

import signal
import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from conftest import QUICK
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import (
    api_test,
    max_cycles_test,
    parallel_api_test,
    parallel_seed_test,
    render_test,
    seed_test,
)

import phase_events as phase
from phase_events import phase_v0
from phase_events._native import ENGINES
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.observation import split_observation


def test_parallel_api():
    parallel_api_test(PhaseParallelEnv(), num_cycles=250)


def test_parallel_seeds():
    parallel_seed_test(PhaseParallelEnv)


@pytest.mark.filterwarnings("ignore:Agent's (min|max)imum observation space:UserWarning")
def test_aec_api():
    api_test(phase_v0.env(), num_cycles=250)


def test_aec_seeds():
    seed_test(phase_v0.env)


def test_max_cycles():
    max_cycles_test(phase_v0)


def test_render():
    pytest.importorskip("pygame")
    render_test(phase_v0.env)


def test_a_process_with_a_window_can_be_ended():
    pytest.importorskip("pygame")
    program = """
import os, signal, time
from phase_events.env import PhaseEnv
env = PhaseEnv("chasing", partner="still", render_mode="human")
env.reset(seed=1)
os.kill(os.getpid(), signal.SIGTERM)
time.sleep(5)
"""
    done = subprocess.run([sys.executable, "-c", program], check=False, timeout=60, capture_output=True)
    assert done.returncode == -signal.SIGTERM, done.stderr


@pytest.mark.filterwarnings("ignore:.*(infinity|spec).*:UserWarning")
@pytest.mark.parametrize("observation", ["view", "state"])
def test_gymnasium_checker(observation):
    check_env(PhaseEnv(partner="random", observation=observation, render_mode="rgb_array"))


def test_gymnasium_makes_it():
    env = gymnasium.make("PHASE-v0", scenes="chasing", partner="still", max_steps=5)
    observation, _ = env.reset(seed=1)
    assert observation in env.observation_space
    ends = [env.step(0)[3] for _ in range(5)]
    assert ends == [False] * 4 + [True]


@pytest.mark.parametrize("engine", ENGINES)
def test_minds_play_the_event_that_is_simulated(scene, engine):
    """Nothing is lost in observations: minds that see only them decide as those of the simulation, bit for bit."""
    event = phase.simulate(scene, seed=7, engine=engine, max_steps=45, parameters=QUICK)
    env = PhaseParallelEnv(scene, engine=engine)
    observations, _ = env.reset(seed=0)
    minds = [phase.Mind(scene, agent, 7, QUICK) for agent in (0, 1)]
    for step in range(event.steps):
        actions = [mind.decide(observations[f"agent_{k}"]) for k, mind in enumerate(minds)]
        assert actions == list(event.actions[step]), step
        observations, *_ = env.step({f"agent_{k}": action for k, action in enumerate(actions)})
        assert np.array_equal(env.state()[: event.substeps.shape[1]], event.substeps[5 * step + 4])


def test_observations_hide_what_is_not_seen():
    """What an agent does not observe does not enter its observation: the same wherever the hidden bodies are."""
    found = 0
    for seed in range(40):
        scene = phase.sample_scene(seed=seed)
        env = PhaseParallelEnv(scene)
        observations, _ = env.reset()
        full = PhaseParallelEnv(scene, observation="state")
        everything, _ = full.reset()
        for agent in env.possible_agents:
            parts, true = split_observation(observations[agent]), split_observation(everything[agent])
            assert parts["entities"][0, 1] == 1, "an agent observes itself"
            present = true["entities"][:, 0] == 1
            assert (true["entities"][present, 1] == 1).all()
            hidden = (parts["entities"][:, 0] == 1) & (parts["entities"][:, 1] == 0)
            found += hidden.sum()
            assert (parts["entities"][hidden, 3:] == 0).all()
            seen = parts["entities"][:, 1] == 1
            assert np.array_equal(parts["entities"][seen, 3:], true["entities"][seen, 3:])
            assert 0 < parts["visible"].sum() < 400
    assert found > 20, "some bodies must be hidden for this to test anything"


def test_rewards_are_equation_1():
    """An agent that stands on its landmark is rewarded 1 a step, its helper as much, less 0.02 for a push that is not forward."""
    description = {
        "layout": {"base": 0},
        "objects": [],
        "event": "helping",
        "agents": [
            {
                "size_level": 0,
                "strength_level": 2,
                "alpha": 0,
                "start": {"x": 8.5, "y": 17.4, "angle": 0},
                "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 0, "sign": 1},
            },
            {
                "size_level": 0,
                "strength_level": 2,
                "alpha": 1,
                "start": {"x": 23.5, "y": 8, "angle": 0},
                "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 0, "sign": 1},
            },
        ],
    }
    env = PhaseParallelEnv(description)
    _, infos = env.reset()
    assert not infos["agent_0"]["goal_holds"]
    up, back = phase.ACTIONS.index("up"), phase.ACTIONS.index("down")
    for _ in range(12):
        _, rewards, _, _, infos = env.step({"agent_0": up, "agent_1": back})
        holds = infos["agent_0"]["goal_holds"]
        assert rewards == {"agent_0": float(holds), "agent_1": pytest.approx(float(holds) - 0.02)}
        if holds:
            break
    assert holds, "twelve pushes lead there"
    assert infos["agent_1"] == {"goal_holds": True, "other_goal_holds": True}


@pytest.mark.parametrize("partner", ["phase", "heuristic", "random", "still"])
def test_partners(partner):
    env = PhaseEnv("helping", partner=phase.Mind(parameters=QUICK) if partner == "phase" else partner)
    observation, _ = env.reset(seed=4)
    for _ in range(5):
        observation, _, _, _, info = env.step(env.action_space.sample())
        assert 0 <= info["partner_action"] < 14


def test_a_recording_as_partner(scene, event):
    env = PhaseEnv(scene, agent=0, partner=phase.ReplayPolicy(event, agent=1))
    env.reset(seed=0)
    for step in range(event.steps):
        *_, info = env.step(event.actions[step, 0])
        assert info["partner_action"] == event.actions[step, 1]
    assert np.array_equal(env.state()[: event.substeps.shape[1]], event.substeps[-1])


def test_the_heuristic_gets_there():
    """In scenes of independent agents, the heuristic reaches goals far more often than chance."""

    def reached(policy):
        count = 0
        for seed in range(12):
            env = PhaseEnv(phase.sample_scene("independent", variant="places", seed=seed), partner="still")
            observation, _ = env.reset(seed=seed)
            if hasattr(policy, "reset"):
                policy.reset(env.scene, 0, seed)
            for _ in range(60):
                observation, reward, *_ = env.step(policy(observation))
                if reward > 0.5:
                    count += 1
                    break
        return count

    assert reached(phase.HeuristicPolicy()) >= reached(phase.RandomPolicy()) + 4


def test_rubbish_is_refused(scene):
    for wrong in ({"engine": "unity"}, {"observation": "all"}, {"max_steps": 0}, {"render_mode": "ansi"}, {"side": 3}):
        with pytest.raises(phase.PhaseError):
            PhaseParallelEnv(scene, **wrong)
    for wrong in ({}, {"agents": []}, "{", 7, float("nan")):
        with pytest.raises(phase.PhaseError):
            PhaseParallelEnv(wrong)
    env = PhaseParallelEnv(scene)
    with pytest.raises(phase.PhaseError, match="reset"):
        env.step({"agent_0": 0, "agent_1": 0})
    env.reset()
    for wrong in (14, -1, 0.5, float("nan"), None, "up", [0], 2**70):
        with pytest.raises(phase.PhaseError, match="action"):
            env.step({"agent_0": wrong, "agent_1": 0})
    with pytest.raises(phase.PhaseError, match="agent_1"):
        env.step({"agent_0": 0})
    with pytest.raises(phase.PhaseError, match="seed"):
        env.reset(seed=-1)
    env.close()
    env.close()
    for use in (env.reset, env.state, lambda: env.step({"agent_0": 0, "agent_1": 0})):
        with pytest.raises(phase.PhaseError, match="closed"):
            use()
    with pytest.raises(phase.PhaseError):
        PhaseEnv(scene, partner="nobody")
    with pytest.raises(phase.PhaseError):
        PhaseEnv(scene, agent=2)
