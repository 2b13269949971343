"""A process that outlives the judge by a moment, and removes its container then.

`python -I removal.py COMMAND NAME` waits until its standard input is closed, by the judge or by the
judge's end. Killing the client of a container does not end the container, and nobody else would.
It imports nothing of ours, so that it starts at once.
"""

import signal
import subprocess
import sys
import time

LIMIT_S = 30.0
"""Time in s for one command."""
AGAIN_S = 0.3
"""Time in s after which a container is looked for again: it may have been about to start."""


def main(program: str, name: str) -> None:
    """Wait for the end of standard input, then kill and remove the container ``name``."""
    for number in (signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
        signal.signal(number, signal.SIG_IGN)
    sys.stdin.buffer.read()
    call(program, "kill", name)
    call(program, "rm", "--force", name)
    time.sleep(AGAIN_S)
    call(program, "rm", "--force", name)


def call(*words: str) -> None:
    """Run a command whose failure means that there is nothing to do."""
    quiet = subprocess.DEVNULL
    try:
        subprocess.run(words, stdin=quiet, stdout=quiet, stderr=quiet, timeout=LIMIT_S, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return


if __name__ == "__main__":
    main(*sys.argv[1:])
