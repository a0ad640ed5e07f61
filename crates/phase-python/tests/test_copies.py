"""Everything can be copied and pickled at any time and goes on as the original, also in other processes."""

import copy
import json
import multiprocessing
import pickle

import gymnasium
import numpy as np
import pytest
from conftest import QUICK, same

import phase_events as phase
from phase_events import phase_v0
from phase_events._native import ENGINES
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.vector import PhaseVectorEnv

COPIES = {"deepcopy": copy.deepcopy, "pickle": lambda item: pickle.loads(pickle.dumps(item))}
copies = pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
# A lost lock or thread shows as a wait; nothing here takes as long as this (s).
PATIENCE = 60


def in_child(context, function, *arguments):
    """The result of a function in a process of its own; an error if it does not come."""
    context = multiprocessing.get_context(context)
    here, there = context.Pipe()
    child = context.Process(target=answer, args=(there, function, arguments), daemon=True)
    child.start()
    try:
        assert here.poll(PATIENCE), "the child waits for ever"
        return here.recv()
    finally:
        child.kill()
        child.join()


def answer(connection, function, arguments):
    connection.send(function(*arguments))


@copies
def test_scenes_and_events(copied, scene, event, tmp_path):
    assert copied(scene).to_json() == scene.to_json()
    assert event.trajectory is not None, "an array that is kept"
    assert copied(event).to_json() == event.to_json()
    event.save(tmp_path / "event.json")
    events = phase.load_events(tmp_path / "event.json")
    assert copied(events)[0].to_json() == event.to_json()


def test_a_sequence_of_events_is_found_from_another_folder(event, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    event.save("event.json")
    pickled = pickle.dumps(phase.load_events("event.json"))
    (tmp_path / "other").mkdir()
    monkeypatch.chdir(tmp_path / "other")
    assert pickle.loads(pickled)[0].id == event.id


@copies
@pytest.mark.parametrize("engine", ENGINES)
def test_parallel_environments(copied, engine):
    env = PhaseParallelEnv("chasing", engine=engine, max_steps=8)
    assert same(copied(env).reset(seed=3), env.reset(seed=3))
    random = np.random.default_rng(1)
    for step in range(20):
        if not env.agents:
            other = copied(env)
            assert same(other.reset(), env.reset()), "later episodes are the same, too"
        actions = dict(zip(env.agents, random.integers(14, size=2), strict=True))
        if step % 5 == 3:
            other = copied(env)
            assert np.array_equal(other.state(), env.state())
            assert same(other.step(actions), env.step(actions))
        else:
            env.step(actions)


@copies
@pytest.mark.parametrize("partner", ["phase", "heuristic", "random", "still"])
def test_environments_with_partners(copied, partner):
    env = PhaseEnv("helping", partner=phase.Mind(parameters=QUICK) if partner == "phase" else partner, render_mode="rgb_array")
    env.reset(seed=2)
    for _ in range(4):
        env.step(2)
    other = copied(env)
    for action in (2, 0, 10, 5):
        assert same(other.step(action), env.step(action))
    assert np.array_equal(other.render(), env.render())


@copies
def test_aec_environments(copied):
    env = phase_v0.env("chasing")
    env.reset(seed=1)
    env.step(3)
    other = copied(env)
    for action in (2, 4, 6):
        env.step(action)
        other.step(action)
        assert same(other.last(), env.last())


@copies
def test_vector_environments(copied):
    vector = PhaseVectorEnv(3, "helping", agent=1, partner=phase.Mind(parameters=QUICK), max_steps=5, pool=2, threads=2)
    vector.reset(seed=1)
    for _ in range(3):
        vector.step(np.array([2, 3, 4]))
    other = copied(vector)
    for _ in range(6):
        assert same(other.step(np.array([1, 2, 3])), vector.step(np.array([1, 2, 3])))


@copies
def test_minds(copied, scene):
    """A copy believes and decides as the original, though it has not searched again."""
    env = PhaseParallelEnv(scene)
    observations, _ = env.reset(seed=0)
    mind, other = phase.Mind(scene, 0, 5, QUICK), phase.Mind(scene, 1, 5, QUICK)
    assert copied(mind).decide(observations["agent_0"]) == mind.decide(observations["agent_0"])
    for step in range(12):
        actions = {"agent_0": 2 if step == 4 else mind.decide(observations["agent_0"]), "agent_1": other.decide(observations["agent_1"])}
        observations, *_ = env.step(actions)
        if step == 4:
            mind.decide(observations["agent_0"], action=2)
    again = copied(mind)
    assert np.array_equal(again.belief, mind.belief)
    assert again.thought == mind.thought
    for _ in range(5):
        decided = mind.decide(observations["agent_0"])
        assert again.decide(observations["agent_0"]) == decided
        assert again.thought == mind.thought
        observations, *_ = env.step({"agent_0": decided, "agent_1": other.decide(observations["agent_1"])})


@copies
def test_minds_that_find_out(copied):
    """A copy knows how long it has watched and, of level 2, what it takes the other to suspect."""
    document = phase.sample_scene("hindering", seed=7).to_dict()
    for agent in document["agents"]:
        agent |= {"knows": "nothing", "level": 2}
    hinderer = next(k for k, agent in enumerate(document["agents"]) if agent["alpha"] < 0)
    scene = phase.Scene.from_json(json.dumps(document))
    env = PhaseParallelEnv(scene)
    observations, _ = env.reset(seed=0)
    minds = {f"agent_{k}": phase.Mind(scene, k, 5, QUICK) for k in range(2)}
    suspicions = []
    for step in range(24):
        kept = {name: copied(mind) for name, mind in minds.items()} if step % 6 == 5 else {}
        actions = {name: mind.decide(observations[name]) for name, mind in minds.items()}
        for name, mind in kept.items():
            assert mind.decide(observations[name]) == actions[name]
            assert mind.thought == minds[name].thought
        suspicions.append(minds[f"agent_{hinderer}"].thought["suspicion"])
        assert "suspicion" not in minds[f"agent_{1 - hinderer}"].thought
        observations, *_ = env.step(actions)
    assert 0 < min(suspicions) < max(suspicions) < 1


@copies
def test_observers(copied, event):
    observer = phase.Observer(event.scene, event.trajectory[0], seed=0)
    observer.push(event.trajectory[1])
    observer.inference()
    observer.push(event.trajectory[2])
    again = copied(observer)
    assert again.push(event.trajectory[3]) == observer.push(event.trajectory[3])
    assert again.inference() == observer.inference()


def name(event):
    return event.id


@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_events_go_to_workers(context, event):
    assert in_child(context, name, event) == event.id


def test_datasets_go_to_workers_of_pytorch(event, tmp_path):
    torch = pytest.importorskip("torch")
    from phase_events.torch import EventDataset, collate

    event.save(tmp_path / "event.json")
    data = EventDataset(phase.load_events(tmp_path / "event.json"))
    for context in ("fork", "spawn"):
        loader = torch.utils.data.DataLoader(data, collate_fn=collate, num_workers=1, multiprocessing_context=context)
        (batch,) = loader
        assert batch["trajectory"].shape == (1, event.steps + 1, 4, 5)


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_gymnasium_steps_environments_in_processes(context, scene):
    """Made by id, with a scene and a mind among the arguments: as in this process."""
    arguments = {"scenes": [scene], "partner": phase.Mind(parameters=QUICK), "max_steps": 3}
    many = gymnasium.make_vec(
        "PHASE-v0", num_envs=2, vectorization_mode="async", vector_kwargs={"context": context}, **arguments
    )
    here = gymnasium.make_vec("PHASE-v0", num_envs=2, **arguments)
    try:
        assert same(many.reset(seed=4), here.reset(seed=4))
        for _ in range(5):
            assert same(many.step(np.array([2, 3])), here.step(np.array([2, 3])))
    finally:
        many.close()


def test_supersuit_leads_to_other_learners():
    """SuperSuit's way from PettingZoo to vector environments, as Stable-Baselines3 is used with it."""
    supersuit = pytest.importorskip("supersuit")

    env = supersuit.pettingzoo_env_to_vec_env_v1(PhaseParallelEnv("chasing", max_steps=4))
    for processes in (0, 2):
        many = supersuit.concat_vec_envs_v1(env, 2, num_cpus=processes, base_class="gymnasium")
        observations, _ = many.reset(seed=1)
        assert observations.shape == (4, phase.OBSERVATION_SIZE)
        for _ in range(6):
            observations, rewards, *_ = many.step(np.zeros(4, dtype=np.int64))
        assert rewards.shape == (4,)
        many.close()


def stepped(vector):
    return vector.step(np.zeros(vector.num_envs, dtype=np.int64))


USED = {}


def step_what_was_used():
    return stepped(USED["vector"])


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("partner", ["still", "phase"])
def test_a_forked_child_goes_on(partner):
    """Threads do not survive a fork; what used them works in the child, and in the parent afterwards."""
    partner = phase.Mind(parameters=QUICK) if partner == "phase" else partner
    vector = PhaseVectorEnv(16, "helping", agent=0, partner=partner, threads=2)
    vector.reset(seed=1)
    stepped(vector)
    USED["vector"] = vector
    there = in_child("fork", step_what_was_used)
    assert same(there, stepped(vector))


def generated(folder):
    return str(phase.generate("demo", 1, folder, options=["--simulations", "10", "--particles", "5", "--max-steps", "4"], video=False))


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_child_generates_and_infers(event, tmp_path):
    here = generated(tmp_path / "here")
    there = in_child("fork", generated, tmp_path / "there")
    assert phase.load_events(here)[0].to_json() == phase.load_events(there)[0].to_json()
    inferred = phase.infer(event, method="cue", steps=10)
    assert in_child("fork", infer_by_cue, event)["relation"] == inferred["relation"]


def infer_by_cue(event):
    return phase.infer(event, method="cue", steps=10)
