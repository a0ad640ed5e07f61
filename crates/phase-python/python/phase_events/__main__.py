"""``python -m phase_events``, or ``phase-events``: the program ``phase``."""

import sys

from . import PhaseError, run


def main():
    """Runs the command line; exit code 0, 2 for a failure, 130 for an interruption."""
    try:
        run(*sys.argv[1:])
    except PhaseError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
