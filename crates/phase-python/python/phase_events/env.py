"""Environments for one learner (Gymnasium) and for two (PettingZoo). They need ``phase-events[env]``.

A step is 0.25 s of video and 1/12 s of physics. Actions are indices of ``ACTIONS``. Observations are
described in :mod:`phase_events.observation`. The reward of a step is Equation 1 of the paper,
(1 - |attitude|) R(s, own goal) + attitude R(s, other's goal) + C(a), where R is 1 while the goal holds and
C(a) is -0.02 for the seven pushes that are not forward, otherwise 0; :mod:`phase_events.rewards` has others.
Episodes do not terminate; they are truncated after ``max_steps``.

Environments can be copied and pickled at any time. A copy goes on as the original does. ``get_state`` and ``set_state`` save and restore
an episode.
"""

import copy
import inspect
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
import pettingzoo
from gymnasium import spaces

from . import _native
from ._check import MOST_STEPS, as_action, choice, seed_of, whole
from ._native import ACTIONS, ENGINES, OBSERVATION_SIZE, PhaseError
from .events import SIDES
from .policies import HeuristicPolicy, Mind, RandomPolicy, StillPolicy
from .rewards import Transition, as_reward, rewarded
from .scenes import as_source

RENDER_MODES = ("human", "rgb_array")
STEPS_PER_SECOND = 4
AGENTS = ("agent_0", "agent_1")
VECTORS = ("view", "state")
VIEWS = (*VECTORS, "image", "state_image")


def observation_space(observation="view", image_side=64):
    """The space of an agent's observation.

    Args:
        observation: ``view`` or ``state``: a box of ``OBSERVATION_SIZE`` 32-bit floats without bounds; ``image`` or ``state_image``: a box
            of (image_side, image_side, 3) 8-bit numbers, red, green, blue.
        image_side: the side of a picture (pixels).
    """
    if observation.endswith("image"):
        return spaces.Box(0, 255, (image_side, image_side, 3), np.uint8)
    return spaces.Box(-np.inf, np.inf, (OBSERVATION_SIZE,), np.float32)


@dataclass(frozen=True)
class EnvState:
    """One world of an environment as it was: all that decides how it goes on, bit for bit.

    It can be pickled, and restored as often as one likes, also in another environment and process that was made with the same arguments.
    In this process it is a copy of the world and of the partner's mind. Pickled, both are the past, which is gone through again on
    reading, without searches: some 10 ms for 100 steps.
    """

    world: Any
    """Bodies, grips and the engine's memory, such as impulses of contacts."""
    seed: int
    """The seed of the episode."""
    steps: int
    """Steps since the episode began."""
    over: bool
    """Whether the episode is over."""
    random: dict
    """The state of the generator from which later episodes are drawn."""
    partner: Any
    """A copy of the partner's policy with its memory and random numbers; ``None`` for one without ``reset``, which has no memory."""
    pool: Any
    """The scenes of later episodes, if they were drawn beforehand."""

    @property
    def scene(self):
        """The :class:`Scene` of the episode."""
        return self.world.scene


def saved_partner(partner):
    """What of a partner is part of a state: a copy of one that knows its episode, otherwise ``None``."""
    return copy.deepcopy(partner) if hasattr(partner, "reset") else None


def check_state(state, engine, partner):
    """Refuses the state of an environment that was made with other arguments.

    Args:
        state: anything.
        engine: the name of the environment's engine.
        partner: the environment's partner; ``None`` without one.

    Raises:
        PhaseError: for what is no :class:`EnvState`, and for one of another engine or kind of partner.
    """
    if not isinstance(state, EnvState):
        raise PhaseError(f"a state is what get_state returned, not {type(state).__name__}")
    if state.world.engine != engine:
        raise PhaseError(f"the state is of the engine {state.world.engine}, the environment of {engine}")
    expected = type(partner) if hasattr(partner, "reset") else type(None)
    if type(state.partner) is not expected:
        raise PhaseError(f"the state has the partner {type(state.partner).__name__}, the environment {expected.__name__}")


class Arena:
    """One world with its scene, clock and pictures: the part that both kinds of environments share.

    Args:
        scenes, engine, observation, image_side, reward, max_steps, render_mode, side: as of :class:`PhaseParallelEnv`.
        agent: the learner, 0 or 1, or ``None`` for both.

    Raises:
        PhaseError: for an invalid argument.

    ``observations`` (1, 2, OBSERVATION_SIZE), ``rewards`` (learners,) and ``achieved`` (1, 2), whether goals hold, are overwritten by
    every step.
    """

    def __init__(self, scenes, engine, observation, image_side, reward, max_steps, render_mode, side, agent):
        self._view = choice("observation", observation, VIEWS)
        self.engine = choice("engine", engine, ENGINES)
        if render_mode is not None:
            choice("render_mode", render_mode, RENDER_MODES)
        self._source, self.pool = as_source(scenes), None
        self._renderer = _native.Renderer(whole("side", side, *SIDES))
        self._image_side = whole("image_side", image_side, *SIDES)
        self.observation_space = observation_space(self._view, self._image_side)
        self._agent = agent
        self._camera = _Camera(self._view, self._image_side, 1, agent)
        self._reward = as_reward(reward)
        self._random = np.random.default_rng()
        self._window = None
        self._worlds = None
        self._closed = False
        self.max_steps = whole("max_steps", max_steps, 1, MOST_STEPS)
        self.render_mode = render_mode
        self.steps = 0
        self.seed = 0
        self.scene = None
        self.observations = np.zeros((1, 2, OBSERVATION_SIZE), dtype=np.float32)
        self._equation_1 = np.zeros((1, 2))
        self.rewards = None
        self.achieved = np.zeros((1, 2), dtype=bool)

    def __getstate__(self):
        # A window belongs to its process.
        return dict(self.__dict__, _window=None)

    def reset(self, seed, options):
        """Begins an episode: draws its seed, from that its scene, and puts the world at its start.

        Args:
            seed: a whole number from 0 to 2**64 - 1 from which this and all later episodes follow; ``None`` goes on drawing.
            options: ``{"scene": …}`` gives the scene of this episode; ``None`` for none.

        Raises:
            PhaseError: for an invalid seed, scene or option, and after :meth:`close`.
        """
        self.check_open()
        options = read_options(options, ("scene",))
        given = as_source(options["scene"]) if "scene" in options else None
        if seed is not None:
            self._random, self.pool = np.random.default_rng(seed_of(seed)), None
        self.seed = int(self._random.integers(2**63))
        self.scene = (given or self.pool or self._source)(self.seed)
        self._put(self.scene)
        self.steps = 0
        self._look()

    def _put(self, scene):
        """Puts a scene at its start into the world."""
        if self._worlds is None:
            self._worlds = _native.Worlds([scene], self.engine, self._view.startswith("state"), 1)
        else:
            self._worlds.reset(0, scene)

    def _look(self):
        self._worlds.observe(self.observations, self.achieved)
        self._camera.look(self._worlds)
        if self.render_mode == "human":
            self.render()

    def get_state(self, over, partner):
        """The :class:`EnvState` of the world.

        Args:
            over: whether the episode is over.
            partner: the policy of the other agent; ``None`` without one.

        Raises:
            PhaseError: before :meth:`reset` and after :meth:`close`.
        """
        self.check_running()
        random, pool = self._random.bit_generator.state, self.pool
        return EnvState(self._worlds.save(0), self.seed, self.steps, over, random, saved_partner(partner), pool)

    def set_state(self, state, partner):
        """Goes back to a state.

        Args:
            state: an :class:`EnvState`.
            partner: the policy of the other agent; ``None`` without one.

        Raises:
            PhaseError: for the state of an environment with other arguments, and after :meth:`close`.
        """
        self.check_open()
        check_state(state, self.engine, partner)
        if self._worlds is None:
            self._put(state.scene)
        self._worlds.restore(0, state.world)
        self._random.bit_generator.state = state.random
        self.scene, self.seed, self.steps, self.pool = state.scene, state.seed, state.steps, state.pool
        self._look()

    def step(self, actions):
        """Lets both agents act for a step of 0.25 s of video.

        Args:
            actions: the numbers of both agents' actions, 0 to 13.

        Raises:
            PhaseError: for an invalid action, before :meth:`reset` and after :meth:`close`.
        """
        self.check_running()
        actions = np.array([actions], dtype=np.int64)
        self._worlds.step(actions, self.observations, self._equation_1, self.achieved)
        self.steps += 1
        step = Transition(self._worlds, self._agent, actions, self._equation_1, self.achieved)
        self.rewards = rewarded(self._reward, step, 2 if self._agent is None else 1)
        self._camera.look(self._worlds)
        if self.render_mode == "human":
            self.render()

    @property
    def truncated(self):
        """Whether the episode has reached its length."""
        return self.steps >= self.max_steps

    def vector(self, agent):
        """A copy of what an agent observes as a vector, (OBSERVATION_SIZE,) 32-bit floats."""
        return self.observations[0, agent].copy()

    def observation(self, agent):
        """A copy of a learner's observation, a vector or a picture."""
        if self._camera.pictures is None:
            return self.vector(agent)
        return self._camera.pictures[0, agent if self._agent is None else 0].copy()

    def state(self):
        """The true state: (4, 6), columns x, y (u), angle (rad), vx, vy (u/s of physics), angular velocity
        (rad/s of physics); 0 for absent objects."""
        self.check_running()
        return self._worlds.states()[0]

    def info(self, agent):
        """Whether the agent's goal and the other's hold in truth, which the agent need not know."""
        return {"goal_holds": bool(self.achieved[0, agent]), "other_goal_holds": bool(self.achieved[0, 1 - agent])}

    def render(self):
        """A picture (side, side, 3), 0 to 255, for ``rgb_array``; a frame in a window and ``None`` for ``human``.

        Raises:
            PhaseError: before :meth:`reset` and after :meth:`close`.
            gymnasium.error.DependencyNotInstalled: if a window is asked for and pygame is absent.
        """
        if self.render_mode is None:
            gymnasium.logger.warn("render() needs render_mode='human' or 'rgb_array' when the environment is made")
            return None
        self.check_running()
        picture = self._renderer.world(self._worlds, 0)
        if self.render_mode == "rgb_array":
            return picture
        self._show(picture)
        return None

    def _show(self, picture):
        try:
            import pygame
        except ImportError as error:
            raise gymnasium.error.DependencyNotInstalled("render_mode='human' needs pygame: pip install pygame") from error
        height, width, _ = picture.shape
        if self._window is None:
            # SDL would have SIGTERM for itself, and nobody could end this process, or one that is forked from it, by asking.
            os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")
            pygame.init()
            pygame.display.set_caption("PHASE")
            self._window = (pygame.display.set_mode((width, height)), pygame.time.Clock())
        window, clock = self._window
        window.blit(pygame.surfarray.make_surface(picture.swapaxes(0, 1)), (0, 0))
        pygame.event.pump()
        pygame.display.flip()
        clock.tick(STEPS_PER_SECOND)

    def close(self):
        """Ends everything; closing twice is allowed."""
        if self._window is not None:
            import pygame

            pygame.display.quit()
            self._window = None
        self._closed = True

    def check_open(self):
        """Refuses any use after :meth:`close`.

        Raises:
            PhaseError: after close.
        """
        if self._closed:
            raise PhaseError("the environment is closed")

    def check_running(self):
        """Refuses what needs an episode.

        Raises:
            PhaseError: after :meth:`close`, and before :meth:`reset`.
        """
        self.check_open()
        if self._worlds is None:
            raise PhaseError("call reset before step, render and state")


class _Camera:
    """The pictures that learners of some worlds are given, if they are given any."""

    def __init__(self, view, side, worlds, agent):
        self.pictures = None
        if view.endswith("image"):
            self._renderer, self._whole = _native.Renderer(side), view == "state_image"
            self._agents = [0, 1] if agent is None else [agent]
            try:
                self.pictures = np.zeros((worlds, len(self._agents), side, side, 3), dtype=np.uint8)
            except MemoryError as error:
                raise PhaseError(f"image_side: the pictures of {worlds} worlds do not fit in memory: {error}") from error

    def look(self, worlds, chosen=None):
        """Draws all worlds, or those that are chosen, anew."""
        if self.pictures is not None:
            self._renderer.observe(worlds, self._agents, self._whole, self.pictures, chosen)


def read_options(options, known):
    """The options of a reset as a dict.

    Args:
        options: a dict, or ``None``.
        known: the names that it may have.

    Raises:
        PhaseError: for another name, and for anything that is no dict.
    """
    if options is None:
        return {}
    if not isinstance(options, Mapping):
        raise PhaseError(f"options are a dict or None, not {options!r}")
    unknown = [name for name in options if name not in known]
    if unknown:
        raise PhaseError(f"options may have {' and '.join(known)}, and no {unknown[0]!r}")
    return dict(options)


def as_policy(partner):
    """A policy for an environment of its own.

    Args:
        partner: ``phase``, ``heuristic``, ``random``, ``still``, a policy, of which one with ``reset`` is copied, or a function without
            arguments (or a class) that makes one.

    Raises:
        PhaseError: for anything else.
    """
    named = {"phase": Mind, "heuristic": HeuristicPolicy, "random": RandomPolicy, "still": StillPolicy}
    if isinstance(partner, str) and partner in named:
        return named[partner]()
    if callable(partner) and _makes_policies(partner):
        partner = partner()
    elif hasattr(partner, "reset"):
        # It knows its episode: two environments cannot share it.
        partner = copy.deepcopy(partner)
    if callable(partner):
        return partner
    raise PhaseError(f"partner must be one of {', '.join(named)}, or a policy, not {partner!r}")


def _makes_policies(function):
    if isinstance(function, type):
        return True
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):
        return False
    try:
        signature.bind(None)
    except TypeError:
        return True
    return False


class PhaseParallelEnv(pettingzoo.ParallelEnv):
    """Two agents in a PHASE world that act at the same time.

    >>> env = PhaseParallelEnv("chasing", max_steps=60)
    >>> observations, infos = env.reset(seed=1)
    >>> observations, rewards, terminations, truncations, infos = env.step({"agent_0": 0, "agent_1": 12})

    Args:
        scenes: a scene, a kind of event, ``"preset:phase-500"``, a list of scenes, a function of a seed, or ``None`` for sampled scenes
            of all kinds (:func:`phase_events.scenes.as_source`).
        observation: ``view``, what agents see and feel, or ``state``, everything, as vectors; ``image``, a picture of what the agent
            sees, in which cells out of sight are dimmed and bodies that are not observed left out, or ``state_image``, a picture of
            everything. Pictures show neither goals nor attitudes.
        image_side: the side of a picture that is an observation (pixels), 64 to 2000.
        reward: ``equation_1``, ``progress``, or a function (:mod:`phase_events.rewards`).
        engine: ``world`` (rapier2d), ``forward`` (the kernel that minds plan in: faster) or ``original`` (the published simulator's world,
            bit for bit).
        max_steps: steps after which an episode is truncated.
        render_mode: ``None``, ``rgb_array`` or ``human``.
        side: the side of a picture of :meth:`render` (pixels), 64 to 2000.

    Raises:
        PhaseError: for invalid arguments, actions and scenes, and for any use after :meth:`close`.
    """

    metadata = {
        "name": "phase_v0",
        "render_modes": list(RENDER_MODES),
        "is_parallelizable": True,
        "render_fps": STEPS_PER_SECOND,
    }

    def __init__(
        self,
        scenes=None,
        *,
        observation="view",
        image_side=64,
        reward="equation_1",
        engine="world",
        max_steps=100,
        render_mode=None,
        side=480,
    ):
        self._arena = Arena(scenes, engine, observation, image_side, reward, max_steps, render_mode, side, None)
        self.render_mode = render_mode
        self.possible_agents = list(AGENTS)
        self.agents = []
        self.observation_spaces = {agent: copy.deepcopy(self._arena.observation_space) for agent in AGENTS}
        self.action_spaces = {agent: spaces.Discrete(len(ACTIONS)) for agent in AGENTS}
        self.state_space = spaces.Box(-np.inf, np.inf, (4, 6), np.float32)

    def observation_space(self, agent):
        """The space of an agent's observations, one object for all calls."""
        return self.observation_spaces[agent]

    def action_space(self, agent):
        """The space of an agent's actions: the fourteen indices of ``ACTIONS``."""
        return self.action_spaces[agent]

    @property
    def scene(self):
        """The :class:`Scene` of the episode; ``None`` before the first one."""
        return self._arena.scene

    @property
    def seed(self):
        """The seed of the episode: minds with this seed play it as :func:`phase_events.simulate` does."""
        return self._arena.seed

    def reset(self, seed=None, options=None):
        """Begins an episode.

        Args:
            seed: a whole number from 0 to 2**64 - 1 from which this and all later episodes follow; ``None`` goes on drawing.
            options: ``{"scene": …}`` gives the scene of this episode. ``{"options": 1}``, which PettingZoo's test of conformance passes,
                has no effect.

        Returns:
            the observations and the infos, dicts from ``agent_0`` and ``agent_1``. An info has ``goal_holds`` and
            ``other_goal_holds``, which are the truth.

        Raises:
            PhaseError: for an invalid seed, scene or option, and after :meth:`close`.
        """
        self._arena.reset(seed, None if options == {"options": 1} else options)
        self.agents = list(AGENTS)
        return self._by_agent(self._arena.observation), self._by_agent(self._arena.info)

    def get_state(self):
        """Saves the episode: an :class:`EnvState`.

        Raises:
            PhaseError: before :meth:`reset` and after :meth:`close`.
        """
        return self._arena.get_state(not self.agents, None)

    def set_state(self, state):
        """Goes back to a state; from there all goes on as it did, bit for bit, later episodes included.

        Args:
            state: what :meth:`get_state` returned, also in another environment that was made with the same arguments.

        Returns:
            observations and infos, as of :meth:`reset`.

        Raises:
            PhaseError: for the state of an environment with other arguments, and after :meth:`close`.
        """
        self._arena.set_state(state, None)
        self.agents = [] if state.over else list(AGENTS)
        return self._by_agent(self._arena.observation), self._by_agent(self._arena.info)

    def step(self, actions):
        """Lets both agents act for a step of 0.25 s of video.

        Args:
            actions: a dict from ``agent_0`` and ``agent_1`` to their actions, indices of ``ACTIONS``.

        Returns:
            observations, rewards, terminations, truncations and infos, dicts from agents; empty ones after the last step.

        Raises:
            PhaseError: for a missing or invalid action, before :meth:`reset` and after :meth:`close`.
        """
        arena = self._arena
        arena.check_running()
        if not self.agents:
            return {}, {}, {}, {}, {}
        if not isinstance(actions, Mapping):
            raise PhaseError(f"actions are a dict from agents to actions, not {actions!r}")
        missing = [agent for agent in AGENTS if agent not in actions]
        if missing:
            raise PhaseError(f"there is no action of {missing[0]}")
        unknown = [agent for agent in actions if agent not in AGENTS]
        if unknown:
            raise PhaseError(f"actions: there is no agent {unknown[0]!r}")
        arena.step([as_action(actions[agent]) for agent in AGENTS])
        truncated = arena.truncated
        answer = (
            self._by_agent(arena.observation),
            {agent: float(arena.rewards[k]) for k, agent in enumerate(AGENTS)},
            dict.fromkeys(AGENTS, False),
            dict.fromkeys(AGENTS, truncated),
            self._by_agent(arena.info),
        )
        if truncated:
            self.agents = []
        return answer

    def state(self):
        """The true state: (4, 6), columns x, y (u), angle (rad), vx, vy (u/s of physics), angular velocity
        (rad/s of physics); 0 for absent objects."""
        return self._arena.state()

    def render(self):
        """A picture (side, side, 3), or a frame in a window."""
        return self._arena.render()

    def close(self):
        """Ends everything; closing twice is allowed."""
        self._arena.close()

    @staticmethod
    def _by_agent(of):
        return {agent: of(k) for k, agent in enumerate(AGENTS)}


class PhaseEnv(gymnasium.Env):
    """One agent in a PHASE world; a partner drives the other.

    >>> env = PhaseEnv("helping", agent=1, partner="heuristic")
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

    Args:
        scenes, observation, image_side, reward, engine, max_steps, render_mode, side: as of :class:`PhaseParallelEnv`.
        agent: which agent is the learner's, 0 or 1.
        partner: ``phase`` (a mind with the paper's settings), ``heuristic``, ``random``, ``still``, or a policy, such as
            ``Mind(parameters={"simulations": 100})`` or ``ReplayPolicy(event)``. One with ``reset`` is copied; policies that share
            something, such as weights, are made by a function without arguments.

    ``gymnasium.make("PHASE-v0", …)`` makes it, and ``gymnasium.make_vec`` many of them, in one call
    (:class:`phase_events.vector.PhaseVectorEnv`), one after the other or in processes: all with the same episodes for the same seeds.

    Raises:
        PhaseError: for invalid arguments, actions and scenes, and for any use after :meth:`close`.
    """

    metadata = {"render_modes": list(RENDER_MODES), "render_fps": STEPS_PER_SECOND}

    def __init__(
        self,
        scenes=None,
        *,
        agent=0,
        partner="phase",
        observation="view",
        image_side=64,
        reward="equation_1",
        engine="world",
        max_steps=100,
        render_mode=None,
        side=480,
    ):
        self._agent = whole("agent", agent, 0, 1)
        self._arena = Arena(scenes, engine, observation, image_side, reward, max_steps, render_mode, side, self._agent)
        self._partner = as_policy(partner)
        self.render_mode = render_mode
        self.observation_space = self._arena.observation_space
        self.action_space = spaces.Discrete(len(ACTIONS))

    @property
    def scene(self):
        """The :class:`Scene` of the episode; ``None`` before the first one."""
        return self._arena.scene

    @property
    def partner(self):
        """The policy of the other agent, such as a :class:`~phase_events.policies.Mind` with its thoughts."""
        return self._partner

    def reset(self, *, seed=None, options=None):
        """Begins an episode; the partner is reset with its scene and seed.

        Args:
            seed: a whole number from 0 to 2**64 - 1 from which this and all later episodes follow; ``None`` goes on drawing.
            options: ``{"scene": …}`` gives the scene of this episode.

        Returns:
            the learner's observation and its info, with ``goal_holds`` and ``other_goal_holds``.

        Raises:
            PhaseError: for an invalid seed, scene or option, and after :meth:`close`.
        """
        seed = None if seed is None else seed_of(seed)
        arena = self._arena
        arena.reset(seed, options)
        super().reset(seed=seed)
        if hasattr(self._partner, "reset"):
            self._partner.reset(arena.scene, 1 - self._agent, arena.seed)
        return arena.observation(self._agent), arena.info(self._agent)

    def state(self):
        """The true state: (4, 6), columns x, y (u), angle (rad), vx, vy (u/s of physics), angular velocity
        (rad/s of physics); 0 for absent objects."""
        return self._arena.state()

    def get_state(self):
        """Saves the episode and the partner's memory: an :class:`EnvState`.

        Raises:
            PhaseError: before :meth:`reset` and after :meth:`close`.
        """
        return self._arena.get_state(self._arena.truncated, self._partner)

    def set_state(self, state):
        """Goes back to a state; from there all goes on as it did, bit for bit, the partner and later episodes included.

        ``partner`` is another object afterwards. Spaces keep their own random numbers.

        Args:
            state: what :meth:`get_state` returned, also in another environment that was made with the same arguments.

        Returns:
            the learner's observation and its info, as of :meth:`reset`.

        Raises:
            PhaseError: for the state of an environment with other arguments, and after :meth:`close`.
        """
        self._arena.set_state(state, self._partner)
        if state.partner is not None:
            self._partner = copy.deepcopy(state.partner)
        return self._arena.observation(self._agent), self._arena.info(self._agent)

    def step(self, action):
        """Lets the learner and its partner act at the same time, for a step of 0.25 s of video.

        Args:
            action: the learner's action, an index of ``ACTIONS``.

        Returns:
            observation, reward, terminated (always ``False``), truncated, and info, which has ``partner_action``, too.

        Raises:
            PhaseError: for an invalid action of either agent, before :meth:`reset` and after :meth:`close`.
        """
        arena, agent = self._arena, self._agent
        arena.check_running()
        actions = [0, 0]
        actions[agent] = as_action(action)
        actions[1 - agent] = as_action(self._partner(arena.vector(1 - agent)))
        arena.step(actions)
        info = dict(arena.info(agent), partner_action=actions[1 - agent])
        return arena.observation(agent), float(arena.rewards[0]), False, arena.truncated, info

    def render(self):
        """A picture (side, side, 3), or a frame in a window."""
        return self._arena.render()

    def close(self):
        """Ends everything; closing twice is allowed."""
        self._arena.close()


# gymnasium.make("PHASE-v0") and gymnasium.make_vec("PHASE-v0")
if "PHASE-v0" not in gymnasium.registry:
    gymnasium.register(
        "PHASE-v0",
        entry_point="phase_events.env:PhaseEnv",
        vector_entry_point="phase_events.vector:make_vector",
    )
