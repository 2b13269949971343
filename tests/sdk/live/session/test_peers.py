"""A program that sets the pipes it shares not to block loses nothing, either way."""

import os
import subprocess
import sys
import time

import pytest

pytestmark = pytest.mark.posix
ECHO = """
import os
from floatref.live.session.peers import standard_streams
os.set_blocking(0, False)
os.set_blocking(1, False)
with standard_streams() as peer:
    while line := peer.stream.readline():
        peer.write(line)
"""
PIPE_BYTES = 1 << 20
"""More than a pipe holds."""
PAUSE_S = 0.3


@pytest.mark.parametrize("parts", [[b"one ", b"line\n", b"rest"], [b"x" * PIPE_BYTES + b"\n"], []])
def test_what_does_not_block_is_waited_for(parts):
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, "-c", ECHO], **pipes) as process:
        process.stdin.write(b"ready\n")
        process.stdin.flush()
        assert process.stdout.readline() == b"ready\n"
        for part in parts:
            time.sleep(PAUSE_S)
            process.stdin.write(part)
            process.stdin.flush()
        process.stdin.close()
        time.sleep(PAUSE_S)
        assert process.stdout.read() == b"".join(parts)
    assert process.returncode == 0


def test_a_reader_that_has_gone_is_an_error_though_nothing_blocks():
    shout = ECHO.replace("while line := peer.stream.readline():", "while line := b'x' * 100_000:")
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen([sys.executable, "-c", shout], **pipes) as process:
        os.read(process.stdout.fileno(), 10)
        process.stdout.close()
        assert b"BrokenPipeError" in process.stderr.read()
    assert process.returncode == 1
