"""Two minds play a scene in an environment; the event is filmed, a dataset is loaded, and SIMPLE perceives both.

Usage: two_minds.py [FOLDER]
"""

import sys
from pathlib import Path

import phase_events as phase
from phase_events.env import PhaseParallelEnv

out = Path(sys.argv[1] if len(sys.argv) > 1 else "out/two-minds")
out.mkdir(parents=True, exist_ok=True)

scene = phase.sample_scene("helping", seed=1)
env = PhaseParallelEnv(scene, render_mode="rgb_array")
observations, _ = env.reset(seed=1)
minds = [phase.Mind(scene, agent, seed=1, parameters={"simulations": 200}) for agent in (0, 1)]
total = 0.0
for _ in range(40):
    actions = {f"agent_{k}": mind.decide(observations[f"agent_{k}"]) for k, mind in enumerate(minds)}
    observations, rewards, *_ = env.step(actions)
    total += rewards["agent_1"]
print(f"agent 1 pursues {minds[1].thought['subgoal']}; its rewards add up to {total:.2f}; the picture is {env.render().shape}")

event = phase.simulate(scene, seed=1, max_steps=40, parameters={"simulations": 200})
event.save_video(out / "event.mp4")
dataset = phase.generate("demo", 2, out / "dataset", video=False, options=["--max-steps", "40", "--simulations", "200"])
events = [event, *phase.load_events(dataset)]
answers = {one.id: phase.infer(one) for one in events}
for one in events:
    relation = answers[one.id]["relation"]
    print(f"{one.id}: {one.relation}, inferred {max(relation, key=relation.get)} ({max(relation.values()):.2f})")
print("goals recognised:", phase.evaluate(answers, events)["goal"]["top1"])
