"""PPO of Stable-Baselines3 learns in a minute to go through a door to its landmark, from the true state of one scene.

It needs `pip install "./crates/phase-python[env]" stable-baselines3`.

Usage: learn_with_sb3.py [STEPS]
"""

import sys

import torch
from stable_baselines3 import PPO
from stable_baselines3.common.env_util import make_vec_env
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.vec_env import VecNormalize

import phase_events as phase
from phase_events.env import PhaseEnv
from phase_events.rewards import Progress

torch.set_num_threads(1)  # the network is small
task = {
    "scenes": phase.sample_scene("independent", variant="places", seed=1),
    "partner": "still", "engine": "forward", "observation": "state", "max_steps": 80,
}  # fmt: skip
env = VecNormalize(make_vec_env(PhaseEnv, 8, env_kwargs={**task, "reward": Progress(weight=0.5, discount=0.99)}))
model = PPO("MlpPolicy", env, gamma=0.99, n_steps=128, batch_size=256, learning_rate=1e-3, ent_coef=0.01, seed=1, device="cpu")
# In the reference world and by Equation 1: the steps on the landmark, of 80.
test = VecNormalize(make_vec_env(PhaseEnv, 1, env_kwargs={**task, "engine": "world"}), training=False, norm_reward=False)
test.obs_rms = env.obs_rms
steps = max(int(sys.argv[1]), 5) if len(sys.argv) > 1 else 40_000
for done in range(0, steps + 1, steps // 5):
    if done:
        model.learn(steps // 5, reset_num_timesteps=False)
    print(f"after {done:6} steps: return {evaluate_policy(model, test, 4)[0]:.1f}", flush=True)
