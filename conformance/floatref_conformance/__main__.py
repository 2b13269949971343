"""`python -m floatref_conformance` is the `conformance` command, started by `start`."""

from floatref.cli.program.starting import start_program


def start() -> None:
    """Run the `conformance` command."""
    start_program("floatref_conformance.own_process", "Interrupted: no verdict")


if __name__ == "__main__":
    start()
