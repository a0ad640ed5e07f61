"""Rewards of environments: Equation 1 of the paper, progress, and functions of one's own.

``reward`` of :class:`~phase_events.env.PhaseEnv`, :class:`~phase_events.env.PhaseParallelEnv` and
:class:`~phase_events.vector.PhaseVectorEnv` is ``"equation_1"`` (the default), ``"progress"``, a :class:`Progress` with numbers of its own,
or a function of a :class:`Transition`. The function is called once a step for all learners together and returns one number for each:

>>> def closer(step):
...     return step.equation_1 + 0.2 * (step.previous_distance - step.distance)
"""

from functools import cached_property

import numpy as np

from ._native import PhaseError

REWARDS = ("equation_1", "progress")


class Transition:
    """A step, as a reward needs it: arrays with a row for each of the N learners.

    N is 1 in a :class:`~phase_events.env.PhaseEnv`, 2 in a :class:`~phase_events.env.PhaseParallelEnv`, and ``num_envs`` in a
    :class:`~phase_events.vector.PhaseVectorEnv`, with agent 0 before agent 1 where both learn. Everything is the truth, which agents
    need not know. What is computed is what the reward reads.
    """

    def __init__(self, worlds, agent, actions, equation_1, achieved):
        self._worlds, self._agent = worlds, agent
        self._actions, self._equation_1, self._achieved = actions, equation_1, achieved

    def _own(self, pairs):
        """The numbers of the learners, from (worlds, 2)."""
        return np.array(pairs.reshape(-1) if self._agent is None else pairs[:, self._agent])

    def _other(self, pairs):
        return self._own(pairs[:, ::-1])

    def _rows(self, worlds):
        return np.repeat(worlds, 2, axis=0) if self._agent is None else worlds

    @property
    def agent(self):
        """The number of each learner's agent, (N,): 0 or 1."""
        return self._own(np.tile(np.arange(2), (len(self._worlds), 1)))

    @property
    def attitude(self):
        """α of each learner, (N,): 1 helps, -1 hinders, 0 neither."""
        return self._own(self._worlds.attitudes())

    @property
    def action(self):
        """The actions of the learners, (N,), indices of ``ACTIONS``."""
        return self._own(self._actions)

    @property
    def other_action(self):
        """The actions of the other agents, (N,)."""
        return self._other(self._actions)

    @property
    def equation_1(self):
        """The reward of Equation 1, (N,): (1 - abs α) R(s, own goal) + α R(s, other's goal) + C(a)."""
        return self._own(self._equation_1)

    @property
    def goal_holds(self):
        """Whether the learner's goal holds after the step, (N,) bool."""
        return self._own(self._achieved)

    @property
    def other_goal_holds(self):
        """Whether the other agent's goal holds after the step, (N,) bool."""
        return self._other(self._achieved)

    @property
    def state(self):
        """The bodies after the step, (N, 4, 6): columns x, y (u), angle (rad), vx, vy (u/s of physics),
        angular velocity (rad/s of physics); agents first, then objects, 0 for absent ones."""
        return self._rows(self._worlds.states())

    @property
    def previous_state(self):
        """The bodies before the step, (N, 4, 6), as :attr:`state`."""
        return self._rows(self._worlds.states(before=True))

    @cached_property
    def _after(self):
        return self._worlds.distances()

    @cached_property
    def _before(self):
        return self._worlds.distances(before=True)

    @property
    def distance(self):
        """How far the learner's goal is, (N,), u: the travel distance of what it is about (an agent or an object) to the centre of its
        landmark, or to the other agent less both radii, around walls; negative for a goal to be away, so that less is better."""
        return self._own(self._after[0])

    @property
    def previous_distance(self):
        """:attr:`distance` before the step, (N,)."""
        return self._own(self._before[0])

    @property
    def other_distance(self):
        """How far the other agent's goal is, (N,), u, as :attr:`distance`."""
        return self._other(self._after[0])

    @property
    def previous_other_distance(self):
        """:attr:`other_distance` before the step, (N,)."""
        return self._other(self._before[0])

    @property
    def approach(self):
        """The learner's travel distance to the object that it has to move, (N,), u, less both radii: the object of its own goal, or of the
        other's if it helps or hinders; 0 if that goal is about no object."""
        return self._own(self._after[1])

    @property
    def previous_approach(self):
        """:attr:`approach` before the step, (N,)."""
        return self._own(self._before[1])


class Progress:
    """Equation 1, and progress towards what the learner wants: the difference of a potential.

    r = R(s', a) + weight (discount Φ(s') - Φ(s)), where R is the reward of Equation 1 and

    Φ(s) = -((1 - abs α) D(s, own goal) + α D(s, other's goal) + A(s)).

    D is :attr:`Transition.distance`, A is :attr:`Transition.approach`. With the learner's own discount the best policies are those of
    Equation 1 (Ng, Harada and Russell, 1999).

    Args:
        weight: the reward of 1 u.
        discount: the learner's discount γ, 0 to 1.

    Raises:
        PhaseError: for numbers that are not finite or out of range.
    """

    def __init__(self, weight=0.1, discount=0.99):
        self._weight = _real("weight", weight, -1e6, 1e6)
        self._discount = _real("discount", discount, 0, 1)

    def __call__(self, step):
        alpha = step.attitude

        def potential(own, other, approach):
            # In 64-bit floats, so that one world and many give the same bits.
            own, other, approach = (np.asarray(one, dtype=np.float64) for one in (own, other, approach))
            return -((1 - np.abs(alpha)) * own + alpha * other + approach)

        before = potential(step.previous_distance, step.previous_other_distance, step.previous_approach)
        after = potential(step.distance, step.other_distance, step.approach)
        return step.equation_1 + self._weight * (self._discount * after - before)


def _real(name, number, low, high):
    try:
        found = float(number)
    except (TypeError, ValueError):
        found = float("nan")
    if isinstance(number, (bool, str)) or not low <= found <= high:
        raise PhaseError(f"{name} is a number from {low:g} to {high:g}, not {number!r}")
    return found


def as_reward(reward):
    """The function of a reward, or ``None`` for Equation 1, which worlds compute themselves.

    Args:
        reward: ``equation_1``, ``progress``, or a function of a :class:`Transition`.

    Raises:
        PhaseError: for anything else.
    """
    if isinstance(reward, str) and reward in REWARDS:
        return Progress() if reward == "progress" else None
    if isinstance(reward, type) or not callable(reward):
        raise PhaseError(f"reward must be one of {', '.join(REWARDS)}, or a function of a Transition, not {reward!r}")
    return reward


def rewarded(reward, step, count):
    """The rewards of a step, (count,) 64-bit floats.

    Args:
        reward: as of :func:`as_reward`.
        step: the :class:`Transition`.
        count: the number of learners.

    Raises:
        PhaseError: for an answer that is not one finite number for each learner.
    """
    if reward is None:
        return step.equation_1
    answer = reward(step)
    try:
        rewards = np.array(answer, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise PhaseError(f"the reward function: {error}") from error
    if rewards.shape != (count,) or not np.isfinite(rewards).all():
        raise PhaseError(f"a reward function returns {count} finite numbers, one for each learner, not {answer!r}")
    return rewards
