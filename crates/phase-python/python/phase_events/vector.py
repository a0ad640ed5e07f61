"""Many worlds at once, stepped in one call, as a Gymnasium vector environment. It needs ``phase-events[env]``."""

import copy as copying
import os

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from . import _native
from ._check import MOST_STEPS, as_action, choice, seed_of, whole
from ._native import ACTIONS, ENGINES, MOST_THREADS, OBSERVATION_SIZE, PhaseError
from .env import (
    STEPS_PER_SECOND,
    VIEWS,
    EnvState,
    _Camera,
    as_policy,
    check_state,
    observation_space,
    read_options,
    saved_partner,
)
from .events import SIDES
from .policies import Mind
from .rewards import Transition, as_reward, rewarded
from .scenes import as_source

MOST_WORLDS = 65_536
"""The greatest number of worlds. Each has two observations, of some 2.5 kB."""
MOST_POOL = 1_000_000
"""The greatest number of different scenes."""
AUTORESETS = {
    "next_step": AutoresetMode.NEXT_STEP,
    "same_step": AutoresetMode.SAME_STEP,
    "disabled": AutoresetMode.DISABLED,
}


class PhaseVectorEnv(gymnasium.vector.VectorEnv):
    """Several PHASE worlds that are stepped together.

    >>> env = PhaseVectorEnv(16, "helping", agent=0, partner="heuristic", pool=8)
    >>> observations, infos = env.reset(seed=1)
    >>> observations, rewards, terminations, truncations, infos = env.step(env.action_space.sample())

    With ``agent`` 0 or 1 there is one learner in each world, and ``num_envs`` is ``worlds``: the same episodes, observations, rewards and
    infos as of that many :class:`~phase_events.env.PhaseEnv` in Gymnasium's ``SyncVectorEnv``. With ``agent=None`` both agents are
    learners, and ``num_envs`` is twice ``worlds``: row 2 k is agent 0 of world k, row 2 k + 1 agent 1.

    Args:
        worlds: the number of worlds, 1 to 65536.
        scenes: as of :class:`~phase_events.env.PhaseParallelEnv`.
        agent: the learner, 0 or 1, or ``None`` for both.
        partner: drives the other agent: as of :class:`~phase_events.env.PhaseEnv`.
        pool: the number of different scenes, drawn once after every reset with a seed, of which each episode has one; ``None`` draws
            a scene for every episode.
        observation, image_side, reward, engine, max_steps, side: as of :class:`~phase_events.env.PhaseParallelEnv`.
        threads: the number of worlds that are stepped, and of minds that decide, at once, 1 to 1024; ``None`` for one a core. Results
            do not depend on it.
        autoreset: ``next_step`` (the step after the last one of an episode begins the next, its action is ignored), ``same_step``
            (the last step returns the first observation and info of the next episode, and ``infos["final_obs"]`` and
            ``infos["final_info"]`` the last ones) or ``disabled`` (worlds are reset by ``reset_mask``).
        render_mode: ``None`` or ``rgb_array``.
        copy: whether observations are copies; ``False`` is faster, and the next step overwrites them.

    Raises:
        PhaseError: for invalid arguments, actions and scenes, and for any use after :meth:`close`.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": STEPS_PER_SECOND, "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        worlds=1,
        scenes=None,
        *,
        agent=None,
        partner="phase",
        pool=None,
        observation="view",
        image_side=64,
        reward="equation_1",
        engine="world",
        max_steps=100,
        threads=None,
        autoreset="next_step",
        render_mode=None,
        side=480,
        copy=True,
    ):
        worlds = whole("worlds", worlds, 1, MOST_WORLDS)
        if isinstance(autoreset, AutoresetMode):
            autoreset = {mode: name for name, mode in AUTORESETS.items()}[autoreset]
        self._autoreset = AUTORESETS[choice("autoreset", autoreset, tuple(AUTORESETS))]
        self.metadata = dict(self.metadata, autoreset_mode=self._autoreset)
        if render_mode is not None:
            choice("render_mode", render_mode, ("rgb_array",))
        if not isinstance(copy, (bool, np.bool_)):
            raise PhaseError(f"copy is True or False, not {copy!r}")
        cores = min(os.cpu_count() or 1, MOST_THREADS)
        self._worlds_count, self._copy = worlds, bool(copy)
        self._agent = None if agent is None else whole("agent", agent, 0, 1)
        # Where each world's scenes come from once a pool is drawn.
        self._source, self._pools = as_source(scenes), [None] * worlds
        self._pool_size = None if pool is None else whole("pool", pool, 1, MOST_POOL)
        self._observes = choice("observation", observation, VIEWS)
        self._reward = as_reward(reward)
        self._engine = choice("engine", engine, ENGINES)
        self._threads = cores if threads is None else whole("threads", threads, 1, MOST_THREADS)
        self._max_steps = whole("max_steps", max_steps, 1, MOST_STEPS)
        self._renderer = _native.Renderer(whole("side", side, *SIDES))
        self.render_mode = render_mode
        self.num_envs = worlds * (2 if agent is None else 1)
        image_side = whole("image_side", image_side, *SIDES)
        self._camera = _Camera(self._observes, image_side, worlds, self._agent)
        self.single_observation_space = observation_space(self._observes, image_side)
        self.single_action_space = spaces.Discrete(len(ACTIONS))
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        policies = [as_policy(partner) for _ in range(worlds)]
        self._partners = [] if agent is None else policies
        self._minds_alone = bool(self._partners) and all(isinstance(partner, Mind) for partner in self._partners)
        self._randoms = [np.random.default_rng() for _ in range(worlds)]
        self._worlds, self._scenes, self._closed = None, [None] * worlds, False
        self._steps, self._seeds = np.zeros(worlds, dtype=np.int64), [0] * worlds
        self._over = np.zeros(worlds, dtype=bool)
        self._actions = np.zeros((worlds, 2), dtype=np.int64)
        self._observations = np.zeros((worlds, 2, OBSERVATION_SIZE), dtype=np.float32)
        self._equation_1 = np.zeros((worlds, 2))
        self._achieved = np.zeros((worlds, 2), dtype=bool)

    def reset(self, *, seed=None, options=None):
        """Begins an episode in every world.

        Args:
            seed: a whole number from 0 to 2**64 - 1, s for s + k in world k, or a list of one seed a world, from which this and all later
                episodes of the world follow; ``None``, also in a list, goes on drawing.
            options: ``{"scene": …}`` gives the scene of these episodes; ``{"reset_mask": …}`` is (num_envs,) bool: only where it is
                true an episode begins. ``None`` for neither.

        Returns:
            observations (num_envs, …), and infos with ``goal_holds`` and ``other_goal_holds`` (num_envs,) and, beside
            each, ``_goal_holds``, where it was set now.

        Raises:
            PhaseError: for an invalid seed, scene, mask or option, and after ``close``.
        """
        self._check_open()
        options = read_options(options, ("scene", "reset_mask"))
        source = as_source(options["scene"]) if "scene" in options else None
        begun = self._masked(options["reset_mask"]) if "reset_mask" in options else np.arange(self._worlds_count)
        seeds = self._read_seeds(seed)
        if self._pool_size is not None and (self._pools[0] is None or seeds[0] is not None):
            self._pools = [_Pool(self._source, self._pool_size, seeds[0])] * self._worlds_count
        for world in begun:
            if seeds[world] is not None:
                self._randoms[world] = np.random.default_rng(seeds[world])
        self._restart(begun, source)
        return self._observed(), self._infos(begun)

    def step(self, actions):
        """Lets every agent act for a step of 0.25 s of video.

        Args:
            actions: (num_envs,) whole numbers, indices of ``ACTIONS``.

        Returns:
            observations (num_envs, …), rewards (num_envs,), terminations (always false), truncations, infos: as those of
            :meth:`reset`, and with ``partner_action`` if there is a partner.

        Raises:
            PhaseError: for an invalid action, of which none is carried out, before :meth:`reset` and after ``close``.
        """
        self._check_running()
        try:
            actions = np.asarray(actions)
        except ValueError as error:
            raise PhaseError(f"actions: {error}") from error
        if actions.shape != (self.num_envs,) or actions.dtype.kind not in "iu":
            shape, kind = actions.shape, actions.dtype
            raise PhaseError(f"actions are {self.num_envs} whole numbers, not the shape {shape} of {kind}")
        wrong = (actions < 0) | (actions >= len(ACTIONS))
        if wrong.any():
            raise PhaseError(f"an action is a whole number from 0 to {len(ACTIONS) - 1}, not {actions[wrong][0]}")
        if self._autoreset == AutoresetMode.DISABLED and self._over.any():
            world = np.flatnonzero(self._over)[0]
            raise PhaseError(f"the episode of world {world} is over: reset it, with options={{'reset_mask': …}}")
        was_over = self._over.copy()
        begun, going = np.flatnonzero(was_over), np.flatnonzero(~was_over)
        if self._agent is None:
            self._actions[:] = actions.reshape(-1, 2)
        else:
            self._actions[:, self._agent] = actions
            self._actions[going, 1 - self._agent] = self._partner_actions(going)
        self._worlds.step(self._actions, self._observations, self._equation_1, self._achieved)
        step = Transition(self._worlds, self._agent, self._actions, self._equation_1, self._achieved)
        rewards = rewarded(self._reward, step, self.num_envs)
        self._camera.look(self._worlds, going.tolist())
        self._steps += 1
        self._restart(begun)
        rewards[self._rows(was_over)] = 0
        truncated = self._steps >= self._max_steps
        self._over = truncated.copy()
        everywhere = np.arange(self._worlds_count)
        if self._autoreset == AutoresetMode.SAME_STEP and truncated.any():
            ended, rows = np.flatnonzero(truncated), self._rows(truncated)
            final = np.full(self.num_envs, None, dtype=object)
            for row in np.flatnonzero(rows):
                final[row] = np.array(self._view()[row])
            last = {"final_obs": final, "_final_obs": rows, "final_info": self._infos(ended, going), "_final_info": rows.copy()}
            self._restart(ended)
            # Where an episode has just begun, nobody has acted yet.
            infos = dict(self._infos(everywhere, np.flatnonzero(~truncated)), **last)
        else:
            infos = self._infos(everywhere, going)
        return self._observed(), rewards, np.zeros(self.num_envs, dtype=bool), self._rows(truncated), infos

    def get_state(self):
        """Saves all worlds with their partners: a list of one :class:`~phase_events.env.EnvState` a world.

        Raises:
            PhaseError: before :meth:`reset` and after ``close``.
        """
        self._check_running()
        return [
            EnvState(
                self._worlds.save(world),
                self._seeds[world],
                int(self._steps[world]),
                bool(self._over[world]),
                self._randoms[world].bit_generator.state,
                saved_partner(self._partners[world]) if self._partners else None,
                self._pools[world],
            )
            for world in range(self._worlds_count)
        ]

    def set_state(self, states, worlds=None):
        """Goes back to states; from there all goes on as it did, bit for bit, partners and later episodes included.

        Args:
            states: one :class:`~phase_events.env.EnvState` a world, also of a :class:`~phase_events.env.PhaseEnv` that was made with the
                same arguments, or a single one for all these worlds.
            worlds: the numbers of the worlds; ``None`` for all.

        Returns:
            observations and infos, as of :meth:`reset` of these worlds.

        Raises:
            PhaseError: for another number of states, for states of an environment with other arguments, none of which is restored then,
                and after ``close``.
        """
        self._check_open()
        if worlds is None:
            worlds = range(self._worlds_count)
        elif self._worlds is None:
            raise PhaseError("worlds: the first states are of all worlds")
        worlds = [whole("a world", world, 0, self._worlds_count - 1) for world in worlds]
        states = [states] * len(worlds) if isinstance(states, EnvState) else states
        if not isinstance(states, (list, tuple)) or len(states) != len(worlds):
            raise PhaseError(f"states are a list of {len(worlds)}, one a world, or a single one")
        for world, state in zip(worlds, states, strict=True):
            check_state(state, self._engine, self._partners[world] if self._partners else None)
        if self._worlds is None:
            self._worlds = self._make([state.scene for state in states])
        for world, state in zip(worlds, states, strict=True):
            self._worlds.restore(world, state.world)
            self._scenes[world], self._seeds[world], self._pools[world] = state.scene, state.seed, state.pool
            self._steps[world], self._over[world] = state.steps, state.over
            self._randoms[world].bit_generator.state = state.random
            if state.partner is not None:
                self._partners[world] = copying.deepcopy(state.partner)
        self._look(worlds)
        return self._observed(), self._infos(np.unique(worlds))

    def scene(self, world):
        """The :class:`Scene` of a world's episode.

        Args:
            world: from 0 to the number of worlds less one.

        Raises:
            PhaseError: for another number, before :meth:`reset` and after ``close``.
        """
        self._check_running()
        return self._scenes[whole("world", world, 0, self._worlds_count - 1)]

    def state(self):
        """The true states: (worlds, 4, 6), columns x, y (u), angle (rad), vx, vy (u/s of physics), angular
        velocity (rad/s of physics); 0 for absent objects.

        Agents do not see them; they are for critics and for shaping rewards.

        Raises:
            PhaseError: before :meth:`reset` and after ``close``.
        """
        self._check_running()
        return self._worlds.states()

    def render(self):
        """A picture (side, side, 3), 0 to 255, of every world, or ``None`` without a render mode.

        Raises:
            PhaseError: before :meth:`reset` and after ``close``.
        """
        self._check_open()
        if self.render_mode is None:
            return None
        self._check_running()
        return tuple(self._renderer.world(self._worlds, world) for world in range(self._worlds_count))

    def close_extras(self, **kwargs):
        """Refuses every later use; ``close`` calls it."""
        self._closed = True

    def _read_seeds(self, seed):
        """The seed of each world, or ``None``."""
        if seed is None:
            return [None] * self._worlds_count
        if isinstance(seed, (list, tuple)) or isinstance(seed, np.ndarray) and seed.ndim:
            if len(seed) != self._worlds_count:
                raise PhaseError(f"seed is a number or a list of {self._worlds_count}, one a world, not of {len(seed)}")
            return [None if one is None else seed_of(one) for one in seed]
        seed = seed_of(seed)
        return [seed_of(seed + world) for world in range(self._worlds_count)]

    def _masked(self, mask):
        """The worlds of a mask."""
        if not isinstance(mask, np.ndarray) or mask.dtype != bool or mask.shape != (self.num_envs,):
            raise PhaseError(f"reset_mask is an array of {self.num_envs} bool, not {mask!r}")
        if not mask.any():
            raise PhaseError("reset_mask is true somewhere")
        if self._worlds is None and not mask.all():
            raise PhaseError("reset_mask: the first reset is of all worlds")
        pairs = mask.reshape(self._worlds_count, -1)
        if (pairs.any(axis=1) != pairs.all(axis=1)).any():
            raise PhaseError("reset_mask: both agents of a world begin an episode together")
        return np.flatnonzero(pairs[:, 0])

    def _restart(self, worlds, source=None):
        """Begins an episode in some worlds, as ``PhaseEnv`` does."""
        if not len(worlds):
            return
        seeds = {world: int(self._randoms[world].integers(2**63)) for world in worlds}
        scenes = {world: (source or self._pools[world] or self._source)(seed) for world, seed in seeds.items()}
        for world, scene in scenes.items():
            self._scenes[world] = scene
        if self._worlds is None:
            self._worlds = self._make(self._scenes)
        for world, scene in scenes.items():
            self._worlds.reset(int(world), scene)
            self._steps[world], self._over[world], self._seeds[world] = 0, False, seeds[world]
            if self._partners and hasattr(self._partners[world], "reset"):
                self._partners[world].reset(scene, 1 - self._agent, seeds[world])
        self._look([int(world) for world in worlds])

    def _make(self, scenes):
        return _native.Worlds(scenes, self._engine, self._observes.startswith("state"), self._threads)

    def _look(self, worlds):
        """Observes some worlds anew."""
        self._worlds.observe(self._observations, self._achieved, worlds)
        self._camera.look(self._worlds, worlds)

    def _partner_actions(self, worlds):
        if not len(worlds):
            return []
        partners = [self._partners[world] for world in worlds]
        observations = self._observations[worlds, 1 - self._agent]
        if self._minds_alone:
            return _native.decide_all([partner.native for partner in partners], observations, self._threads)
        return [as_action(partner(one)) for partner, one in zip(partners, observations, strict=True)]

    def _rows(self, worlds):
        """The rows of the learners of worlds for which something is true."""
        return np.repeat(worlds, self.num_envs // self._worlds_count)

    def _view(self):
        """The observations of the learners."""
        if self._camera.pictures is not None:
            return self._camera.pictures.reshape(self.num_envs, *self.single_observation_space.shape)
        if self._agent is None:
            return self._observations.reshape(self.num_envs, OBSERVATION_SIZE)
        return self._observations[:, self._agent]

    def _observed(self):
        view = self._view()
        return view.copy() if self._copy else view

    def _infos(self, worlds, acted=()):
        """The infos of some worlds, in some of which a partner has acted, as Gymnasium gathers them of single environments."""
        own = slice(None) if self._agent is None else slice(self._agent, self._agent + 1)
        infos = {
            "goal_holds": (self._achieved[:, own], worlds),
            "other_goal_holds": (self._achieved[:, ::-1][:, own], worlds),
        }
        acted = np.intersect1d(worlds, acted)
        if self._partners and len(acted):
            infos["partner_action"] = (self._actions[:, [1 - self._agent]], acted)
        gathered = {}
        for name, (values, worlds) in infos.items():
            present = np.zeros(self._worlds_count, dtype=bool)
            present[worlds] = True
            gathered[name] = np.where(present[:, None], values, np.zeros_like(values)).reshape(-1)
            gathered[f"_{name}"] = self._rows(present)
        return gathered

    def _check_open(self):
        if self._closed:
            raise PhaseError("the environment is closed")

    def _check_running(self):
        self._check_open()
        if self._worlds is None:
            raise PhaseError("call reset before step, scene, state and render")


class _Pool:
    """A source of scenes that draws each of them once."""

    def __init__(self, source, size, seed):
        self._source, self._size = source, size
        self._seeds = np.random.default_rng(seed).integers(2**63, size=size)
        self._scenes = {}

    def __call__(self, seed):
        number = seed % self._size
        if number not in self._scenes:
            self._scenes[number] = self._source(int(self._seeds[number]))
        return self._scenes[number]


def make_vector(num_envs=1, *, agent=0, **options):
    """Worlds with one learner each, for ``gymnasium.make_vec``.

    Args:
        num_envs: the number of worlds.
        agent: the learner, 0 or 1.
        options: as of :class:`PhaseVectorEnv`.

    Raises:
        PhaseError: for an invalid argument.
    """
    return PhaseVectorEnv(num_envs, agent=whole("agent", agent, 0, 1), **options)
