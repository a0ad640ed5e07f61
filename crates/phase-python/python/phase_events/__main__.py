"""``python -m phase_events``, or ``phase-events``: the program ``phase``."""

import sys

from . import PhaseError, run


def main():
    """Runs the program ``phase`` with the arguments of this process.

    The exit code is that of the program: 2 for bad input, 1 for another failure, each with a sentence on stderr, or 130 after an
    interruption.
    """
    try:
        run(*sys.argv[1:])
    except PhaseError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(getattr(error, "exit_code", 1))
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
