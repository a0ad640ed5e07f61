"""The environment as PettingZoo names them: ``phase_v0.parallel_env()`` and, agent by agent, ``phase_v0.env()``."""

from pettingzoo.utils import parallel_to_aec, wrappers

from .env import PhaseParallelEnv


def parallel_env(*arguments, max_cycles=100, **options):
    """A :class:`PhaseParallelEnv`, in which both agents act at the same time.

    Args:
        arguments, options: as of :class:`PhaseParallelEnv`.
        max_cycles: its ``max_steps``, the steps of an episode.

    Raises:
        PhaseError: for an invalid argument.
    """
    return PhaseParallelEnv(*arguments, max_steps=max_cycles, **options)


def raw_env(*arguments, **options):
    """The environment in which agents act one after the other (AEC); arguments as of :func:`parallel_env`."""
    return parallel_to_aec(parallel_env(*arguments, **options))


def env(*arguments, **options):
    """The environment of :func:`raw_env` with checks of the order of calls; arguments as of :func:`parallel_env`."""
    return wrappers.OrderEnforcingWrapper(raw_env(*arguments, **options))
