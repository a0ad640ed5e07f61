"""``python -m phase_events``, or ``phase-events``: the program ``phase``."""

import sys

from . import PhaseError, run


def main():
    """Runs the program ``phase`` with the arguments of this process.

    The exit code is 0, 2 after a failure, whose sentence is printed on stderr, or 130 after an interruption.
    """
    try:
        run(*sys.argv[1:])
    except PhaseError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
