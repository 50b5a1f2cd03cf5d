"""The `rosmini` command, and `python -m rosmini`."""

import sys


def main() -> int:
    """Run the command line; Ctrl-C ends it quietly with status 130, also while its modules are being imported."""
    try:
        from rosmini.tools.main import main as run
    except KeyboardInterrupt:
        print(file=sys.stderr)
        return 130
    return run()


if __name__ == "__main__":
    sys.exit(main())
