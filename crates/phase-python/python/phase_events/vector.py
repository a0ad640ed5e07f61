"""Many worlds at once, stepped in one call, as a Gymnasium vector environment. It needs ``phase-events[env]``."""

import os

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from . import _native
from ._native import ACTIONS, OBSERVATION_SIZE, PhaseError
from .env import VIEWS, as_policy, observation_space
from .policies import Mind
from .scenes import as_source, seed_of


class PhaseVectorEnv(gymnasium.vector.VectorEnv):
    """Several PHASE worlds that are stepped together.

    >>> env = PhaseVectorEnv(16, "helping", agent=0, partner="heuristic", pool=8)
    >>> observations, infos = env.reset(seed=1)
    >>> observations, rewards, terminations, truncations, infos = env.step(env.action_space.sample())

    With ``agent`` 0 or 1 there is one learner in each world, and ``num_envs`` is ``worlds``. With ``agent=None`` both agents are
    learners, and ``num_envs`` is twice ``worlds``: row 2 k is agent 0 of world k, row 2 k + 1 agent 1.

    Observations are a view of the array that worlds write into: the next step overwrites it. ``copy=True`` gives copies.

    Args:
        worlds: the number of worlds.
        scenes: as of :class:`PhaseParallelEnv`. Scenes that are sampled are drawn once, ``pool`` of them, at the first reset and after
            every reset with a seed, and each episode has one of them.
        agent: the learner, 0 or 1, or ``None`` for both.
        partner: drives the other agent: ``phase``, ``heuristic``, ``random``, ``still``, or a function that makes a policy.
        pool: the number of different scenes.
        observation, engine, max_steps: as of :class:`PhaseParallelEnv`.
        threads: the number of worlds that are stepped, and of minds that decide, at once; ``None`` for one a core.
        autoreset: ``next_step`` (the step after the last one of an episode begins the next, its action is ignored) or ``same_step``
            (the last step returns the first observation of the next episode, and ``infos["final_obs"]`` the last one).
        render_mode: ``None`` or ``rgb_array``.
        copy: whether observations are copies.

    Raises:
        PhaseError: for invalid arguments, actions and scenes, and for any use after :meth:`close`.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 4, "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        worlds=1,
        scenes=None,
        *,
        agent=None,
        partner="heuristic",
        pool=128,
        observation="view",
        engine="world",
        max_steps=100,
        threads=None,
        autoreset="next_step",
        render_mode=None,
        copy=False,
    ):
        for name, number in (("worlds", worlds), ("pool", pool), ("max_steps", max_steps)):
            if not isinstance(number, int) or number < 1:
                raise PhaseError(f"{name} is a whole number of at least 1, not {number!r}")
        if agent not in (None, 0, 1):
            raise PhaseError(f"agent is 0, 1 or None for both, not {agent!r}")
        if observation not in VIEWS:
            raise PhaseError(f"observation is view or state, not {observation!r}")
        if autoreset not in ("next_step", "same_step"):
            raise PhaseError(f"autoreset is next_step or same_step, not {autoreset!r}")
        if render_mode not in (None, "rgb_array"):
            raise PhaseError(f"render_mode is rgb_array or None, not {render_mode!r}")
        self._same_step = autoreset == "same_step"
        mode = AutoresetMode.SAME_STEP if self._same_step else AutoresetMode.NEXT_STEP
        self.metadata = dict(self.metadata, autoreset_mode=mode)
        self._worlds_count, self._agent, self._copy = worlds, agent, copy
        self._source, self._pool_size, self._pool = as_source(scenes), pool, []
        self._omniscient, self._engine = observation == "state", engine
        self._threads = threads if threads is not None else os.cpu_count() or 1
        self._max_steps = max_steps
        self.render_mode = render_mode
        self.num_envs = worlds * (2 if agent is None else 1)
        self.single_observation_space = observation_space()
        self.single_action_space = spaces.Discrete(len(ACTIONS))
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._partners = [] if agent is None else [_make(partner) for _ in range(worlds)]
        self._minds_alone = bool(self._partners) and all(isinstance(partner, Mind) for partner in self._partners)
        self._random = np.random.default_rng()
        self._worlds, self._closed = None, False
        self._steps = np.zeros(worlds, dtype=np.int64)
        self._over = np.zeros(worlds, dtype=bool)
        self._actions = np.zeros((worlds, 2), dtype=np.int64)
        self._observations = np.zeros((worlds, 2, OBSERVATION_SIZE), dtype=np.float32)
        self._rewards = np.zeros((worlds, 2))
        self._achieved = np.zeros((worlds, 2), dtype=bool)
        _native.Worlds([], engine, self._omniscient, 1)

    def reset(self, *, seed=None, options=None):
        """Begins an episode in every world.

        Args:
            seed: a whole number from 0 to 2**64 - 1, or a list that begins with one, from which scenes and episodes follow; ``None``
                goes on drawing.
            options: ignored.

        Returns:
            observations (num_envs, OBSERVATION_SIZE), and infos with ``goal_holds`` (num_envs,).

        Raises:
            PhaseError: for an invalid seed, and after ``close``.
        """
        self._check_open()
        if isinstance(seed, (list, tuple, np.ndarray)):
            seed = None if seed[0] is None else int(seed[0])
        if seed is not None:
            self._random = np.random.default_rng(seed_of(seed))
            self._pool = []
        if not self._pool:
            seeds = self._random.integers(2**63, size=self._pool_size)
            self._pool = [self._source(int(one)) for one in seeds]
        scenes = [self._begin(world) for world in range(self._worlds_count)]
        self._worlds = _native.Worlds(scenes, self._engine, self._omniscient, self._threads)
        self._steps[:], self._over[:] = 0, False
        self._worlds.observe(self._observations, self._achieved)
        return self._observed(), self._infos()

    def step(self, actions):
        """Lets every agent act for a step of 0.25 s.

        Args:
            actions: (num_envs,) whole numbers, indices of ``ACTIONS``.

        Returns:
            observations (num_envs, OBSERVATION_SIZE), rewards (num_envs,), terminations (always false), truncations, infos.

        Raises:
            PhaseError: for an invalid action, of which none is carried out, before :meth:`reset` and after ``close``.
        """
        self._check_open()
        if self._worlds is None:
            raise PhaseError("call reset before step")
        actions = np.asarray(actions)
        if actions.shape != (self.num_envs,) or actions.dtype.kind not in "iu":
            shape, kind = actions.shape, actions.dtype
            raise PhaseError(f"actions are {self.num_envs} whole numbers, not the shape {shape} of {kind}")
        if self._agent is None:
            self._actions[:] = actions.reshape(-1, 2)
        else:
            self._actions[:, self._agent] = actions
            self._actions[:, 1 - self._agent] = self._partner_actions()
        self._worlds.step(self._actions, self._observations, self._rewards, self._achieved)
        self._steps += 1
        begun = np.flatnonzero(self._over)
        self._restart(begun)
        self._rewards[begun] = 0
        truncated = self._steps >= self._max_steps
        self._over = truncated.copy()
        infos = self._infos()
        if self._same_step and truncated.any():
            rows = np.repeat(truncated, 2) if self._agent is None else truncated
            final = np.full(self.num_envs, None, dtype=object)
            for row in np.flatnonzero(rows):
                final[row] = np.array(self._view()[row])
            infos.update(final_obs=final, _final_obs=rows)
            self._restart(np.flatnonzero(truncated))
            self._over[:] = False
        truncated = np.repeat(truncated, 2) if self._agent is None else truncated
        rewards = self._rewards.reshape(-1) if self._agent is None else self._rewards[:, self._agent]
        return self._observed(), rewards.copy(), np.zeros(self.num_envs, dtype=bool), truncated, infos

    def scene(self, world):
        """The :class:`Scene` of a world's episode; ``world`` is from 0 to the number of worlds less one."""
        return self._scenes[world]

    def state(self):
        """The true states: (worlds, 4, 6), columns x, y (u), angle (rad), vx, vy (u/s), angular velocity (rad/s); 0 for absent objects.

        Agents do not see them; they are for critics and for shaping rewards.

        Raises:
            PhaseError: before :meth:`reset` and after ``close``.
        """
        self._check_open()
        if self._worlds is None:
            raise PhaseError("call reset before state")
        return self._worlds.states()

    def render(self):
        """A picture (240, 240, 3), 0 to 255, of every world, or ``None`` without a render mode."""
        self._check_open()
        if self.render_mode is None:
            return None
        renderer = _native.Renderer(240)
        return tuple(renderer.world(self._worlds, world) for world in range(self._worlds_count))

    def close_extras(self, **kwargs):
        """Refuses every later use; ``close`` calls it."""
        self._closed = True

    def _begin(self, world):
        if not hasattr(self, "_scenes"):
            self._scenes = [None] * self._worlds_count
        scene = self._pool[int(self._random.integers(len(self._pool)))]
        self._scenes[world] = scene
        seed = int(self._random.integers(2**63))
        if self._partners and hasattr(self._partners[world], "reset"):
            self._partners[world].reset(scene, 1 - self._agent, seed)
        return scene

    def _restart(self, worlds):
        if not len(worlds):
            return
        for world in worlds:
            self._worlds.reset(int(world), self._begin(int(world)))
            self._steps[world] = 0
        self._worlds.observe(self._observations, self._achieved, worlds.astype(np.int64))

    def _partner_actions(self):
        observations = np.ascontiguousarray(self._observations[:, 1 - self._agent])
        if self._minds_alone:
            minds = [partner.native for partner in self._partners]
            return _native.decide_all(minds, observations, self._threads)
        return [partner(one) for partner, one in zip(self._partners, observations, strict=True)]

    def _view(self):
        if self._agent is None:
            return self._observations.reshape(self.num_envs, OBSERVATION_SIZE)
        return self._observations[:, self._agent]

    def _observed(self):
        view = self._view()
        return view.copy() if self._copy else view

    def _infos(self):
        achieved = self._achieved.reshape(-1) if self._agent is None else self._achieved[:, self._agent]
        everywhere = np.ones(self.num_envs, dtype=bool)
        return {"goal_holds": achieved.copy(), "_goal_holds": everywhere}

    def _check_open(self):
        if self._closed:
            raise PhaseError("the environment is closed")


def _make(partner):
    """A policy of its own for each world."""
    return as_policy(partner) if isinstance(partner, str) else as_policy(partner())


def make_vector(num_envs=1, *, agent=0, **options):
    """Worlds with one learner each, for ``gymnasium.make_vec``.

    Args:
        num_envs: the number of worlds.
        agent: the learner, 0 or 1.
        options: as of :class:`PhaseVectorEnv`.

    Raises:
        PhaseError: for an invalid argument.
    """
    return PhaseVectorEnv(num_envs, agent=agent, **options)
