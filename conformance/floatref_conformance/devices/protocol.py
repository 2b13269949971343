"""The protocol of devices that are programs: one JSON object per line, version 1."""

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path, PurePath
from typing import Any, NoReturn

from floatref_conformance.devices.process import Child, readable, start
from floatref_conformance.errors import DeviceError, DeviceRefused, DeviceSkipped

VERSION = 1
WHERE = "stdout is for answers alone, messages go to stderr"
"""What to do about a line that is no answer."""
START_S = 10.0
"""Time for `start`, in s."""
STOP_S = 5.0
"""Time for `stop`, in s."""
RUN_S = 60.0
"""Time for `run` in s, in addition to `RUN_PER_LENGTH` times the length of the recording."""
RUN_PER_LENGTH = 2.0


class Session:
    """A started device from `start` to `stop`; any fault ends it at once.

    Attributes:
        device: the device's description of itself.
        is_over: whether the session has ended.
    """

    def __init__(
        self,
        argv: Sequence[str],
        folder: Path,
        limit_s: float = START_S,
        variables: Sequence[str] = (),
    ) -> None:
        """Start ``argv`` in ``folder`` and request its description within ``limit_s``.

        ``variables`` names those of the environment that it gets beside the usual ones.
        Raises DeviceError, in one line, or DeviceHung.
        """
        self.is_over = False
        self._seq = 0
        try:
            self._child: Child = start(argv, folder, variables)
        except DeviceError as fault:
            raise DeviceError(f"start: {fault}") from fault
        with self._step("start"):
            answer = self._ask({"cmd": "start", "version": VERSION}, limit_s)
            if "error" in answer:
                raise DeviceError(f"answered an error: {_text(answer, 'error')}")
            self.device = _description(answer)

    def run(self, recording: PurePath, profile: PurePath, limit_s: float) -> None:
        """Let the device process ``recording`` into ``profile`` within ``limit_s``.

        Raises DeviceSkipped if the device skips it, DeviceRefused if it answers an error,
        DeviceError if it fails, in one line, or DeviceHung.
        """
        self._child.conceal(str(PurePath(profile).parent))
        with self._step("run"):
            command = {"cmd": "run", "recording": str(recording), "profile": str(profile)}
            answer = self._ask(command, limit_s)
            failed = _text(answer, "error") if "error" in answer else None
            skipped = _text(answer, "skipped") if "skipped" in answer else None
            if failed is None and skipped is None and answer.get("ok") is not True:
                raise DeviceError("answered neither ok, nor skipped, nor error")
        if failed is not None:
            raise DeviceRefused(f"run: answered an error: {failed}{self._child.describe_stderr()}")
        if skipped is not None:
            raise DeviceSkipped(skipped)

    def stop(self, limit_s: float = STOP_S) -> None:
        """Stop the device within ``limit_s``; afterwards no process of it exists.

        It may answer before it ends. Raises DeviceError, in one line, or DeviceHung.
        """
        if self.is_over:
            return
        with self._step("stop"):
            self._send({"cmd": "stop"})
            for line in self._child.finish(limit_s):
                self._check(line)
        self.is_over = True

    @contextmanager
    def _step(self, name: str) -> Iterator[None]:
        """On a fault, kill the device; put ``name`` before the fault and its stderr behind it."""
        try:
            yield
        except BaseException as fault:
            self.is_over = True
            self._child.kill()
            if isinstance(fault, DeviceError):
                raise type(fault)(f"{name}: {fault}{self._child.describe_stderr()}") from fault
            raise

    def _ask(self, command: Mapping[str, Any], limit_s: float) -> Mapping[str, Any]:
        self._send(command)
        return self._check(self._child.receive(limit_s))

    def _send(self, command: Mapping[str, Any]) -> None:
        self._seq += 1
        self._child.send(json.dumps({"seq": self._seq, **command}).encode("ascii") + b"\n")

    def _check(self, line: bytes) -> Mapping[str, Any]:
        """Return the object on ``line``; DeviceError unless it answers the last command."""
        answer = parse_line(line)
        seq = answer.get("seq")
        if isinstance(seq, bool) or not isinstance(seq, int) or seq != self._seq:
            given = f"seq {readable(repr(seq), 40)}" if "seq" in answer else "without a seq"
            raise DeviceError(f"answered {given}, expected {self._seq}")
        return answer


def parse_line(line: bytes) -> Mapping[str, Any]:
    """Return the JSON object on ``line``; DeviceError, in one line, for anything else."""
    try:
        found = json.loads(line.decode("utf-8"), parse_constant=_refuse)
    except UnicodeDecodeError as error:
        raise DeviceError(f"the answer is not UTF-8: {readable(line)}") from error
    except (ValueError, RecursionError) as error:
        noise = readable(line) or "an empty line"
        raise DeviceError(f"the answer is not JSON: {noise} ({WHERE})") from error
    if not isinstance(found, Mapping):
        raise DeviceError(f"the answer is not a JSON object: {readable(line)} ({WHERE})")
    return found


def _refuse(literal: str) -> NoReturn:
    raise ValueError(f"{literal} is not JSON")


def _description(answer: Mapping[str, Any]) -> Mapping[str, Any]:
    version, device = answer.get("version"), answer.get("device")
    if version != VERSION or isinstance(version, bool):
        raise DeviceError(f"answered version {readable(repr(version), 40)}, expected {VERSION}")
    if not isinstance(device, Mapping):
        raise DeviceError("answered without a device")
    for key in ("name", "version"):
        value = device.get(key)
        if isinstance(value, str) and readable(value) != value:
            raise DeviceError(f"the device's {key} is too long or cannot be printed")
    return device


def _text(answer: Mapping[str, Any], key: str) -> str:
    """Return the reason in ``answer``; DeviceError unless it is a text."""
    text = answer[key]
    if not isinstance(text, str) or not readable(text):
        raise DeviceError(f"answered {key} without a reason")
    return readable(text, 500)
