"""The program keeps its memory; a process of others that calls its command does not."""

import subprocess
import sys

TOLD = """
import sys
from floatref_conformance import kept_memory
kept_memory.keep_memory = lambda: print("kept", flush=True)
sys.argv = ["conformance", "--version"]
try:
    CALL
except SystemExit:
    pass
"""
PROGRAM = "from floatref_conformance.__main__ import start; start()"
COMMAND = "from floatref_conformance.cli.main import main; main()"


def _say(call: str) -> list[str]:
    words = [sys.executable, "-c", TOLD.replace("CALL", call)]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()


def test_the_program_keeps_its_memory_before_its_command_runs() -> None:
    first, second = _say(PROGRAM)
    assert first == "kept"
    assert second.startswith("conformance, version")


def test_a_process_that_calls_the_command_keeps_its_own_way() -> None:
    (only,) = _say(COMMAND)
    assert only.startswith("conformance, version")
