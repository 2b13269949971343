"""One container from its start to its removal, and the folder through which files pass."""

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path, PurePosixPath

from floatref.files.owners import own_name
from floatref.files.scratch import make_scratch, remove_scratch
from floatref_conformance.devices.containers import removal
from floatref_conformance.devices.containers.engine import PROFILES, RECORDINGS, VARIABLES, Engine
from floatref_conformance.devices.delivered import take
from floatref_conformance.devices.environment import environment_of
from floatref_conformance.devices.protocol import Session
from floatref_conformance.errors import DeviceError

REMOVED_S = 100.0
"""Time in s to wait for the removal of a container."""


class RunningContainer:
    """A started container; after any fault it is removed, and `is_over`.

    The device sees copies of recordings below `RECORDINGS`, and what it writes below `PROFILES` is
    copied by the judge. No other folder of this machine is in the container.
    """

    def __init__(
        self, engine: Engine, digest: str, limit_s: float, variables: Sequence[str]
    ) -> None:
        """Start image ``digest`` and let it describe itself within ``limit_s``.

        Raises DeviceError, in one line, or DeviceHung.
        """
        self.is_over = False
        self._count = 0
        self._folder = make_scratch("container")
        self._removal: subprocess.Popen[bytes] | None = None
        try:
            for name in ("recordings", "profiles"):
                (self._folder / name).mkdir()
            name = own_name("floatref-")
            # Before the container, so that there is no moment in which nobody would remove it.
            self._removal = _start_removal(engine, name)
            words = engine.words_to_run(name, digest, self._folder, variables)
            given = (*VARIABLES, *variables)
            self._session = Session(words, self._folder, limit_s, given)
        except BaseException:
            self.end()
            raise

    @property
    def device(self) -> dict[str, object]:
        """The device's description of itself."""
        return dict(self._session.device)

    def run(self, recording: Path, profile: Path, limit_s: float) -> None:
        """Let the device process a copy of ``recording``, and copy what it made to ``profile``.

        Raises as `Session.run`, and DeviceError for a profile that cannot be copied.
        """
        self._count += 1
        here = str(self._count)
        copy, made = self._folder / "recordings" / here, self._folder / "profiles" / here
        try:
            shutil.copytree(recording.parent, copy)
            there = PurePosixPath(RECORDINGS, here, recording.name)
            self._session.run(there, PurePosixPath(PROFILES, here), limit_s)
            take(made, profile)
        finally:
            for folder in (copy, made):
                shutil.rmtree(folder, ignore_errors=True)
            if self._session.is_over:
                self.end()

    def stop(self, limit_s: float) -> None:
        """Stop the device within ``limit_s``, and remove the container in any case."""
        try:
            self._session.stop(limit_s)
        finally:
            self.end()

    def end(self) -> None:
        """Remove the container and the folder; harmless if they are gone."""
        self.is_over = True
        ending, self._removal = self._removal, None
        if ending is not None and ending.stdin is not None:
            with suppress(OSError):
                ending.stdin.close()
            with suppress(subprocess.TimeoutExpired):
                ending.wait(REMOVED_S)
        remove_scratch(self._folder)


def _start_removal(engine: Engine, name: str) -> "subprocess.Popen[bytes]":
    """Start what removes the container ``name`` as soon as this process closes its input, or ends.

    It is in the judge's own session, in which no process of a device can be, and in a group of its
    own, so that Ctrl-C in a terminal ends the judge alone.
    """
    try:
        return subprocess.Popen(
            [sys.executable, "-I", removal.__file__, engine.program, name],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env=environment_of(VARIABLES),
            process_group=0 if os.name == "posix" else None,
        )
    except OSError as error:
        raise DeviceError(f"start: {sys.executable} cannot be started ({error})") from error
