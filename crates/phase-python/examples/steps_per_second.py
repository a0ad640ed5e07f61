"""Steps a second of PHASE's environments beside those of PettingZoo's MPE and of VMAS, in one run on one core.

A step is one of every environment: both agents of a PHASE world, all agents of `simple_tag`. Seconds are of CPU time. Actions are random and
drawn before the clock starts. MPE and VMAS are measured where they are installed (`pip install mpe2 vmas`). `--only cores` measures vector
environments with one thread and with one for each core, in turns, in seconds of the clock: the machine has to be idle.

Usage: steps_per_second.py [--seconds 2] [--only engine|learning|others|cores]
"""

import argparse
import json
import os
import time

# One core for everybody.
for variable in ("OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"
CORES = os.cpu_count() or 1
if hasattr(os, "sched_setaffinity"):
    ALL_CORES = os.sched_getaffinity(0)
    CORES = len(ALL_CORES)
    os.sched_setaffinity(0, {min(ALL_CORES)})

import numpy as np

from phase_events import Mind, _native, sample_scene
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.vector import PhaseVectorEnv


def rate(step, environments, seconds, clock=time.process_time):
    """Steps of an environment a second."""
    for _ in range(3):
        step()
    count, begun = 0, clock()
    while clock() - begun < seconds:
        step()
        count += 1
    return count * environments / (clock() - begun)


def phase_single(engine):
    env = PhaseParallelEnv(sample_scene("helping", seed=1), engine=engine, max_steps=10**9)
    env.reset(seed=1)
    actions = iter(np.random.default_rng(0).integers(14, size=(4_000_000, 2)).tolist())

    def step():
        first, second = next(actions)
        env.step({"agent_0": first, "agent_1": second})

    return step


def phase_vector(worlds, engine, observation="view", threads=1):
    env = PhaseVectorEnv(worlds, engine=engine, threads=threads, observation=observation, pool=128, copy=False)
    env.reset(seed=1)
    actions = np.random.default_rng(0).integers(14, size=(50, 2 * worlds))
    k = iter(range(10**9))
    return lambda: env.step(actions[next(k) % 50])


def phase_learner(partner, given):
    """A learner with a partner, in new scenes after every 100 steps."""
    env = PhaseEnv([sample_scene("helping", seed=k) for k in range(16)], partner=partner, **given)
    env.reset(seed=1)
    actions = iter(np.random.default_rng(0).integers(14, size=4_000_000).tolist())

    def step():
        if env.step(next(actions))[3]:
            env.reset()

    return step


def save_and_restore(partner):
    """A state that is saved, restored and left by a step."""
    env = PhaseEnv(sample_scene("helping", seed=1), partner=partner, max_steps=10**9)
    env.reset(seed=1)
    for action in range(14):
        env.step(action)

    def step():
        env.set_state(env.get_state())

    return step


def native_vector(worlds, engine):
    """The same without Gymnasium: what Rust takes by itself."""
    native = _native.Worlds([sample_scene(seed=k) for k in range(worlds)], engine, False, 1)
    observations = np.zeros((worlds, 2, _native.OBSERVATION_SIZE), dtype=np.float32)
    rewards, achieved = np.zeros((worlds, 2)), np.zeros((worlds, 2), dtype=bool)
    actions = np.random.default_rng(0).integers(14, size=(50, worlds, 2))
    k = iter(range(10**9))
    return lambda: native.step(actions[next(k) % 50], observations, rewards, achieved)


def mpe():
    from mpe2 import simple_tag_v3

    env = simple_tag_v3.parallel_env(max_cycles=10**9)
    env.reset(seed=1)
    names = env.possible_agents
    actions = iter(np.random.default_rng(0).integers(5, size=(1_000_000, len(names))).tolist())
    return lambda: env.step(dict(zip(names, next(actions), strict=True)))


def vmas(worlds):
    import torch
    from vmas import make_env

    torch.set_num_threads(1)
    env = make_env("simple_tag", num_envs=worlds, device="cpu", continuous_actions=False, seed=1)
    env.reset()
    actions = [torch.randint(5, (worlds,)) for _ in env.agents]
    return lambda: env.step(actions)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=2.0, help="how long each is measured")
    parser.add_argument("--only", choices=("engine", "learning", "others", "cores"), help="one part")
    arguments = parser.parse_args()
    seconds, measured = arguments.seconds, {}
    parts = (arguments.only,) if arguments.only else ("engine", "learning", "others")

    def measure(name, make, environments, *arguments):
        try:
            measured[name] = round(rate(make(*arguments), environments, seconds))
        except ImportError as error:
            measured[name] = f"not installed: {error.name}"
        print(f"{name:<40} {measured[name]:>12}", flush=True)

    if "engine" in parts:
        for engine in ("world", "forward"):
            measure(f"phase single {engine}", phase_single, 1, engine)
        for worlds in (1, 64, 1024):
            for engine in ("world", "forward"):
                measure(f"phase vector {worlds} {engine}", phase_vector, worlds, worlds, engine)
                measure(f"rust alone {worlds} {engine}", native_vector, worlds, worlds, engine)
            measure(f"phase vector {worlds} forward, state", phase_vector, worlds, worlds, "forward", "state")
    if "learning" in parts:
        minds = {"phase": "phase", "phase, 50 simulations": Mind(parameters={"simulations": 50, "particles": 10})}
        for name, partner in {"still": "still", "random": "random", "heuristic": "heuristic", **minds}.items():
            measure(f"learner, partner {name}", phase_learner, 1, partner, {})
        for given in ({"reward": "progress"}, {"observation": "image"}, {"observation": "state_image"}):
            name = " ".join(given.values())
            measure(f"learner, {name}", phase_learner, 1, "still", given)
            measure(f"learner, {name}, forward", phase_learner, 1, "still", {**given, "engine": "forward"})
        measure("learner, forward", phase_learner, 1, "still", {"engine": "forward"})
        for partner in ("still", "phase"):
            measure(f"get_state and set_state, partner {partner}", save_and_restore, 1, partner)
    if "others" in parts:
        measure("mpe simple_tag", mpe, 1)
        for worlds in (1, 64, 1024):
            measure(f"vmas simple_tag {worlds}", vmas, worlds, worlds)
    if "cores" in parts:
        if hasattr(os, "sched_setaffinity"):
            os.sched_setaffinity(0, ALL_CORES)
        for worlds in (64, 1024):
            for engine, observation in (("world", "view"), ("forward", "view"), ("forward", "state")):
                # In turns, so that both see the same machine.
                steps = {threads: phase_vector(worlds, engine, observation, threads) for threads in (1, CORES)}
                for _ in range(3):
                    for threads, step in steps.items():
                        name = f"phase vector {worlds} {engine}, {observation}, {threads} threads"
                        measured.setdefault(name, []).append(round(rate(step, worlds, seconds, time.perf_counter)))
        for name, rates in measured.items():
            print(f"{name:<50} {rates}", flush=True)
    print(json.dumps(measured))


if __name__ == "__main__":
    main()
