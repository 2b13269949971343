"""`python -m floatref_conformance` is the `conformance` command, started by `start`."""

from floatref.cli.program.starting import start_program
from floatref_conformance.kept_memory import keep_memory


def start() -> None:
    """Run the `conformance` command."""
    # Of the program alone: a process of others that calls a command keeps its own way.
    keep_memory()
    start_program("floatref_conformance.cli.main", "Interrupted: no verdict")


if __name__ == "__main__":
    start()
