"""The process of a `python:` device: it runs a vendor's object by the protocol of programs.

`python -m floatref_conformance.devices.host package.module:factory`. Output of the vendor's code
goes to standard error; its standard input is empty. A process whose first line is a `hello` of a
stream answers that stream by the object's ``open_stream``, and ends.
"""

import json
import os
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from importlib import import_module
from io import TextIOWrapper
from itertools import chain
from operator import attrgetter
from pathlib import Path
from typing import Any

from floatref_conformance.devices.streams.serving import OpenStream, serve_stream
from floatref_conformance.errors import DeviceSkipped

Order = Callable[[Iterator[Mapping[str, Any]]], Iterator[Mapping[str, Any]]]
FIND = "--find"
"""Option: the host only answers whether it finds the factory."""


class Missing(Exception):
    """The module or the factory does not exist; the text is one line."""


def main(words: Sequence[str]) -> None:
    """Answer commands, or with `FIND` whether the factory named in ``words`` exists."""
    spec, *options = words
    commands, answers = _pipes()
    if os.getcwd() not in sys.path:
        sys.path.insert(0, os.getcwd())
    if FIND in options:
        _write(answers, {"missing": describe_missing(spec)})
        return
    serve(spec, map(json.loads, commands), partial(_write, answers))


def serve(
    spec: str,
    commands: Iterable[Mapping[str, Any]],
    answer: Callable[[Mapping[str, Any]], None],
) -> None:
    """Let the object of the factory ``spec`` answer ``commands``, until `stop`.

    If the first is of a stream, let it answer the stream.
    """
    device: Any = None
    reply: Mapping[str, Any]
    coming = iter(commands)
    for command in coming:
        if "kind" in command:
            serve_stream(find_factory(spec)().open_stream, chain([command], coming), answer)
            break
        if command["cmd"] == "stop":
            break
        try:
            if command["cmd"] == "start":
                device = find_factory(spec)()
                reply = {"version": 1, "device": dict(device.describe())}
            else:
                paths = Path(command["recording"]), Path(command["profile"])
                reply = outcome(device.run(*paths))
            answer({"seq": command["seq"], **reply})
        except BaseException as error:
            answer({"seq": command["seq"], **_fault(error)})
    if hasattr(device, "close"):
        device.close()


def stream_alone(open_stream: OpenStream, order: Order = iter) -> None:
    """Answer one stream on standard input and output by what ``open_stream`` makes.

    ``order`` puts the messages into the order in which they are obeyed.
    """
    messages, answers = _pipes()
    serve_stream(open_stream, order(map(json.loads, messages)), partial(_write, answers))


def find_factory(spec: str) -> Callable[[], Any]:
    """Return the factory that ``spec`` names; Missing if it does not exist.

    Exceptions of the vendor's module during its import are passed on.
    """
    name, _, attribute = spec.partition(":")
    try:
        module = import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{name}.".startswith(f"{error.name}."):
            raise
        raise Missing(f"no module {error.name} in the current folder or installed") from error
    try:
        factory = attrgetter(attribute)(module)
    except AttributeError as error:
        raise Missing(f"module {name} has no {attribute}") from error
    if not callable(factory):
        raise Missing(f"{attribute} of {name} is a {type(factory).__name__}, not a function")
    made: Callable[[], Any] = factory
    return made


def describe_missing(spec: str) -> str | None:
    """Return why the factory does not exist; None if it exists, or if that is unknown."""
    try:
        find_factory(spec)
    except Missing as reason:
        return str(reason)
    except BaseException:
        return None
    return None


def outcome(done: object) -> Mapping[str, Any]:
    """Return the answer to a run that returned ``done``: skipped with the reason, or ok."""
    if isinstance(done, Mapping) and "skipped" in done:
        return {"skipped": str(done["skipped"])}
    return {"ok": True}


def _fault(error: BaseException) -> Mapping[str, Any]:
    if isinstance(error, DeviceSkipped):
        return {"skipped": str(error)}
    traceback.print_exception(error, file=sys.stderr)
    sys.stderr.flush()
    return {"error": f"{type(error).__name__}: {error}"}


def _pipes() -> tuple[TextIOWrapper, TextIOWrapper]:
    """Return standard input and output, and replace them: empty input, output to stderr."""
    commands = os.fdopen(os.dup(0), encoding="utf-8")
    answers = os.fdopen(os.dup(1), "w", encoding="ascii")
    empty = os.open(os.devnull, os.O_RDONLY)
    os.dup2(empty, 0)
    os.close(empty)
    os.dup2(2, 1)
    sys.stdout = sys.stderr
    return commands, answers


def _write(answers: TextIOWrapper, answer: Mapping[str, Any]) -> None:
    answers.write(json.dumps(answer, allow_nan=False) + "\n")
    answers.flush()


if __name__ == "__main__":
    main(sys.argv[1:])
