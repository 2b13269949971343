"""Programs that behave badly on purpose, each in its own process.

`python -m floatref_conformance.mutants.hostile NAME` follows the protocol of programs and
delivers a sound profile, except for the behaviour that its entry in `HOSTILE` describes.
"""

import json
import os
import signal
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref_conformance.devices.executable import ExecDevice

PIPELINE = "temporal-adaptive-hpf-spatial-backward"
HANG_S = 1.0
"""Time in s for a recording of the hanging program, which never answers."""
FLOOD_BYTES = 4 << 30

Command = Mapping[str, Any]
Answer = Mapping[str, Any]


class Hostile(NamedTuple):
    """A hostile program: its name, what is wrong with it, and how it is started."""

    name: str
    wrong: str
    argv: tuple[str, ...]


def hostile_device(name: str) -> ExecDevice:
    """Return the device of hostile program ``name``; InputError if it is unknown."""
    for hostile in HOSTILE:
        if hostile.name == name:
            return ExecDevice(hostile.argv, Path.cwd(), HANG_S if name == "hang" else None)
    known = suggest(name, [hostile.name for hostile in HOSTILE], "known:")
    raise InputError(f"hostile program {name}: unknown; {known}")


def main(name: str) -> None:
    """Follow the protocol, with the wrong behaviour of ``name``."""
    if name == "exit-at-start":
        sys.exit(3)
    wrong, _ = BEHAVIOUR[name]
    for line in sys.stdin:
        command = json.loads(line)
        if command["cmd"] == "stop":
            return
        _print_answer(_describe(command) if command["cmd"] == "start" else wrong(command))


def _describe(command: Command) -> Answer:
    device = {"name": "hostile", "version": "1", "architecture": "temporal", "capabilities": []}
    return {"seq": command["seq"], "version": 1, "device": device}


def _print_answer(answer: Answer | str) -> None:
    print(answer if isinstance(answer, str) else json.dumps(answer), flush=True)


def _sound(command: Command) -> Answer:
    from floatref_conformance.devices.builtin import BuiltinDevice

    BuiltinDevice(PIPELINE).run(Path(command["recording"]), Path(command["profile"]))
    return {"seq": command["seq"], "ok": True}


def _hang(command: Command) -> Answer:
    while True:
        time.sleep(3600.0)


def _crash(command: Command) -> Answer:
    print("out of luck", file=sys.stderr, flush=True)
    os.kill(os.getpid(), signal.SIGTERM)
    return _hang(command)


def _flood(command: Command) -> Answer:
    for _ in range(FLOOD_BYTES >> 16):
        sys.stdout.write("x" * (1 << 16))
    return _sound(command)


def _garbage(command: Command) -> str:
    _sound(command)
    return "Processing finished, 0 errors"


def _out_of_order(command: Command) -> Answer:
    return {**_sound(command), "seq": command["seq"] - 1}


def _not_a_number(command: Command) -> str:
    _sound(command)
    return f'{{"seq": {command["seq"]}, "ok": true, "elapsed_s": NaN}}'


def _nothing(command: Command) -> Answer:
    return {"seq": command["seq"], "ok": True}


def _elsewhere(command: Command) -> Answer:
    profile = Path(command["profile"])
    elsewhere = profile.with_name("elsewhere")
    answer = _sound({**command, "profile": str(elsewhere)})
    profile.symlink_to(elsewhere, target_is_directory=True)
    return answer


BEHAVIOUR: Mapping[str, tuple[Callable[[Command], Answer | str], str]] = {
    "exit-at-start": (_sound, "exits before it has described itself"),
    "hang": (_hang, "never answers"),
    "crash": (_crash, "dies in the middle of a run"),
    "flood": (_flood, "writes gigabytes to standard output"),
    "garbage": (_garbage, "answers in prose"),
    "out-of-order": (_out_of_order, "answers with the number of another command"),
    "nan-answer": (_not_a_number, "answers with a number that JSON does not have"),
    "nothing-delivered": (_nothing, "answers ok and delivers nothing"),
    "delivered-elsewhere": (_elsewhere, "delivers a symbolic link to a profile elsewhere"),
}
HOSTILE = tuple(
    Hostile(name, wrong, (sys.executable, "-m", "floatref_conformance.mutants.hostile", name))
    for name, (_, wrong) in BEHAVIOUR.items()
)
"""All hostile programs, in the order in which they are listed."""

if __name__ == "__main__":
    main(*sys.argv[1:])
