"""The `conformance` command in a process of its own, as its program starts it.

A process of others that calls the command, as a test does, keeps its own way with memory.
"""


def main() -> None:
    """Run the command, its modules loaded with the memory kept."""
    from floatref_conformance.kept_memory import keep_memory

    keep_memory()
    from floatref_conformance.cli.main import main as command

    command()
