"""Entry point of the `floatref` command, and how any program is started.

Most of a short command's time is the loading of modules, and Ctrl-C in it is an interruption like
any other. So this module imports only what Python has loaded before it: all else is loaded inside
`start_program`.
"""

import sys
from importlib import import_module


def start() -> None:
    """Run the `floatref` command."""
    start_program("floatref.cli.main", "Interrupted")


def start_program(module: str, interrupted: str) -> None:
    """Load ``module`` and call its `main`.

    Where a signal ends the loading, or comes between two parts of a command, the line
    ``interrupted`` goes to stderr and the exit code is 130.
    """
    try:
        from floatref.cli.program.interrupts import ending_program

        with ending_program(interrupted):
            import_module(module).main()
    except KeyboardInterrupt:
        sys.stderr.write(f"{interrupted}\n")
        sys.exit(130)
