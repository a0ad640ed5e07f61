"""The environment as PettingZoo names them: ``phase_v0.parallel_env()`` and, agent by agent, ``phase_v0.env()``."""

from pettingzoo.utils import parallel_to_aec, wrappers

from .env import PhaseParallelEnv


def parallel_env(*arguments, max_cycles=100, **options):
    """A :class:`PhaseParallelEnv`; ``max_cycles`` is its ``max_steps``."""
    return PhaseParallelEnv(*arguments, max_steps=max_cycles, **options)


def raw_env(*arguments, **options):
    """The same, in which agents act one after the other (AEC)."""
    return parallel_to_aec(parallel_env(*arguments, **options))


def env(*arguments, **options):
    """:func:`raw_env` with checks of the order of calls."""
    return wrappers.OrderEnforcingWrapper(raw_env(*arguments, **options))
