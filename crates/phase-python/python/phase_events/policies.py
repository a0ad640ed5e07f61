"""Policies: from an agent's observation to its action.

A policy is anything that is called with an observation and returns the number of an action. If it has a method
``reset(scene, agent, seed)``, environments call that at the start of every episode. Those of this module can be copied and pickled at any
time: a copy goes on as the original does.
"""

import json

import numpy as np

from . import _native
from ._check import as_action, floats, seed_of, to_json, whole
from ._native import ACTIONS, OBSERVATION_SIZE, PhaseError
from .observation import split_observation
from .scenes import scene as as_scene

_STOP = ACTIONS.index("stop")
_ATTACH = ACTIONS.index("attach")
# Directions in the agent's own frame: x to its right, y ahead.
_PUSHES = {
    "up": (0.0, 1.0),
    "down": (0.0, -1.0),
    "left": (-1.0, 0.0),
    "right": (1.0, 0.0),
    "upleft": (-0.7071, 0.7071),
    "upright": (0.7071, 0.7071),
    "downleft": (-0.7071, -0.7071),
    "downright": (0.7071, -0.7071),
}
_PUSH_NUMBERS = [ACTIONS.index(name) for name in _PUSHES]
_PUSH_DIRECTIONS = np.array(list(_PUSHES.values()))


class Mind:
    """A PHASE mind: belief, symbolic planner and POMCP search (docs/explanation/minds.md).

    It can be used on its own or as a policy in an environment; then :meth:`reset` gives it the scene.

    >>> env = PhaseEnv("helping", partner=Mind(parameters={"simulations": 200}))   # doctest: +SKIP

    Args:
        scene: a scene, as of :func:`phase_events.scene`; ``None`` if :meth:`reset` will be called.
        agent: the agent whose mind it is, 0 or 1.
        seed: a whole number from 0 to 2**64 - 1, for its belief and its search. Two minds with the seed of an event decide as those of
            :func:`phase_events.simulate`.
        parameters: a dict of parameters of the kind ``phase`` that differ from the defaults (docs/explanation/minds.md), such as
            ``{"simulations": 200}``.

    Raises:
        PhaseError: for an invalid scene, agent, seed or parameter.
    """

    def __init__(self, scene=None, agent=0, seed=0, parameters=None):
        self._parameters = None if parameters is None else to_json("parameters", parameters)
        if self._parameters is not None:
            _native.Mind.check(self._parameters)
        self._mind = None
        agent, seed = whole("agent", agent, 0, 1), seed_of(seed)
        if scene is not None:
            self.reset(scene, agent, seed)

    def reset(self, scene, agent, seed):
        """Begins an event: all beliefs are forgotten.

        Args:
            scene, agent, seed: as of the constructor.

        Raises:
            PhaseError: for an invalid scene, agent, seed or parameter.
        """
        self._mind = _native.Mind(as_scene(scene), whole("agent", agent, 0, 1), seed_of(seed), self._parameters)

    @property
    def native(self):
        """The mind of the native module.

        Raises:
            PhaseError: before it has a scene.
        """
        if self._mind is None:
            raise PhaseError("the mind has no scene yet: give it one, or call reset")
        return self._mind

    def decide(self, observation, action=None):
        """Observes and decides.

        Args:
            observation: (OBSERVATION_SIZE,) 32-bit floats, as environments give them to this agent.
            action: the action that the agent took since its last decision, if that was not the one that the mind decided on.

        Returns:
            the number of an action, an index of ``ACTIONS``.

        Raises:
            PhaseError: before the mind has a scene, for an invalid action, and for numbers that are no observation of its agent.
        """
        observation = floats("an observation", observation, (OBSERVATION_SIZE,))
        return self.native.decide(observation, None if action is None else as_action(action))

    __call__ = decide

    @property
    def belief(self):
        """The possible worlds, equally likely: (particles, entities, 6), columns x, y (u), angle (rad), vx,
        vy (u/s of physics), angular velocity (rad/s of physics), entities by number, agents first; ``None``
        before the first decision."""
        return self.native.particles()

    @property
    def thought(self):
        """The reasons of the last decision as a dict; ``None`` before the first one.

        It has ``subgoal``, such as ``On(agent 0, landmark 1)``; ``subgoals`` with their values V and numbers of particles; ``plan``;
        ``actions`` with the visits and values of the search; of an agent that does not know the other's
        goal ``intents``, what it takes the other to want; of a hinderer of level 2 ``suspicion``, the
        probability that the other takes it to hinder, as the agent sees it.
        """
        thought = self.native.thought()
        return None if thought is None else json.loads(thought)

    @property
    def visits(self):
        """Visits of the search to each of the fourteen actions, (14,); 0 where nothing was searched."""
        visits = np.zeros(len(ACTIONS), dtype=np.int64)
        for action in (self.thought or {}).get("actions", []):
            visits[ACTIONS.index(action["action"])] = action["visits"]
        return visits


class RandomPolicy:
    """Draws one of the fourteen actions, all equally likely.

    Args:
        seed: a whole number from 0 to 2**64 - 1.

    Raises:
        PhaseError: for an invalid seed.
    """

    def __init__(self, seed=0):
        self._random = np.random.default_rng(seed_of(seed))

    def reset(self, scene, agent, seed):
        """Begins an episode: draws follow from its seed and from the agent's number."""
        self._random = np.random.default_rng((seed_of(seed), whole("agent", agent, 0, 1)))

    def __call__(self, observation):
        return int(self._random.integers(len(ACTIONS)))


class StillPolicy:
    """Always stops."""

    def __call__(self, observation):
        return _STOP


class ReplayPolicy:
    """Repeats the actions of an agent of an event, then stops.

    Args:
        actions: (steps,) actions, indices of ``ACTIONS``, or an :class:`Event` with actions.
        agent: the agent whose actions are taken from an event, 0 or 1.

    Raises:
        PhaseError: for an event without actions, and for an invalid action.
    """

    def __init__(self, actions, agent=1):
        if hasattr(actions, "actions"):
            if actions.actions is None:
                raise PhaseError(f"the event {actions.id} has no actions to repeat")
            actions = actions.actions[:, whole("agent", agent, 0, 1)]
        try:
            actions = list(actions)
        except TypeError:
            raise PhaseError(f"actions are a sequence or an event, not {actions!r}") from None
        self._actions = [as_action(action) for action in actions]
        self._next = 0

    def reset(self, scene, agent, seed):
        """Begins an episode: the first action is next."""
        self._next = 0

    def __call__(self, observation):
        self._next += 1
        return self._actions[self._next - 1] if self._next <= len(self._actions) else _STOP


class HeuristicPolicy:
    """Goes straight for what its attitude wants: moves itself, or fetches the object and carries it, room by room through the doors.

    It plans nothing else: it sees no bodies in its way, does not know which doors are too narrow, and hinders by doing the opposite of
    the other's goal. It looks for what it does not see by turning.
    """

    _TURN = ACTIONS.index("turnleft")
    # Rooms: 0 top left, 1 top right, 2 bottom right, 3 bottom left. The wall between two rooms, and its direction from the centre.
    _CENTRE = np.array([16.0, 12.0])
    # It is there when it is this close (u).
    _CLOSE = 0.3

    def __call__(self, observation):
        parts = split_observation(observation)
        entities, goal = parts["entities"], self._goal(parts)
        kind, subject = int(np.argmax(goal[:3])), int(np.argmax(goal[3:7]))
        own = entities[0]
        if not entities[subject][1]:
            return self._TURN
        sign = goal[11]
        place = parts["landmarks"][int(np.argmax(goal[7:11]))] if kind < 2 else entities[1][3:5]
        if kind == 2 and not entities[1][1]:
            return self._TURN
        if sign < 0:
            # Away from the place: to the corner of the arena that is farthest from it.
            corners = np.array([[8.5, 19.5], [23.5, 19.5], [23.5, 4.5], [8.5, 4.5]])
            place = corners[int(np.argmax(np.linalg.norm(corners - place, axis=1)))]
        if kind == 1 and not parts["grips"][0][subject - 2]:
            reach = parts["radii"][0] + parts["radii"][subject] + 0.6
            if np.linalg.norm(entities[subject][3:5] - own[3:5]) <= reach + 0.4 and parts["entities"][subject][2]:
                return _ATTACH
            return self._towards(own, entities[subject][3:5], parts)
        if kind == 0 and subject == 1:
            # The other's place: whoever helps or hinders there pushes the other.
            return self._towards(own, entities[1][3:5], parts)
        carried = entities[subject][3:5] if kind == 1 else own[3:5]
        if np.linalg.norm(carried - place) < self._CLOSE:
            return _STOP
        return self._towards(own, place + (own[3:5] - carried), parts)

    @staticmethod
    def _goal(parts):
        if parts["attitude"][0] == 0:
            return parts["own_goal"]
        goal = np.array(parts["other_goal"])
        goal[11] *= parts["attitude"][0]
        return goal

    def _towards(self, own, place, parts):
        """The push that leads to a place, through the next door on the way."""
        here = own[3:5]
        way = self._way(here, place, parts["doors"])
        offset = way - here
        cosine, sine = own[5], own[6]
        # The agent faces (-sin, cos); its right is (cos, sin).
        direction = np.array([offset @ [cosine, sine], offset @ [-sine, cosine]])
        length = np.linalg.norm(direction)
        if length < 1e-6:
            return _STOP
        return _PUSH_NUMBERS[int(np.argmax(_PUSH_DIRECTIONS @ (direction / length)))]

    def _way(self, here, place, doors):
        start, end = self._room(here), self._room(place)
        if start == end:
            return place
        gates = {}
        directions = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]
        for wall, direction in enumerate(directions):
            begin, stop = doors[wall]
            if stop > begin:
                middle = self._CENTRE + np.array(direction) * (begin + stop) / 2
                # The wall above the centre separates rooms 0 and 1, the next ones 1 and 2, 2 and 3, 3 and 0.
                a, b = wall, (wall + 1) % 4
                gates.setdefault(a, []).append((b, middle))
                gates.setdefault(b, []).append((a, middle))
        # Breadth first from the end: the first door of a shortest way.
        distance, queue = {end: 0}, [end]
        for room in queue:
            for other, _ in gates.get(room, []):
                if other not in distance:
                    distance[other] = distance[room] + 1
                    queue.append(other)
        ways = [(distance[other], k) for k, (other, _) in enumerate(gates.get(start, [])) if other in distance]
        if not ways:
            return place
        other, middle = gates[start][min(ways)[1]]
        if np.linalg.norm(middle - here) < 0.8:
            centres = np.array([[11.0, 17.0], [21.0, 17.0], [21.0, 7.0], [11.0, 7.0]])
            return centres[other]
        return middle

    def _room(self, place):
        x, y = place - self._CENTRE
        return (0 if x < 0 else 1) if y >= 0 else (3 if x < 0 else 2)
