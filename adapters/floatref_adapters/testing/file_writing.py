"""What all writers share: quanta, clocks that are one, and files that appear complete."""

import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, InputError, Recording, StampedClock, UniformClock

Floats = NDArray[np.float64]


@contextmanager
def replace_file(path: Path) -> Iterator[Path]:
    """Yield a path beside ``path`` to write to; give it that name when all went well."""
    beside = path.with_name(f".{path.name}-{secrets.token_hex(4)}")
    try:
        yield beside
        os.replace(beside, path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror or error})") from error
    finally:
        beside.unlink(missing_ok=True)


def quantum_of(channel: Channel, quanta: Mapping[str, float] | None) -> float | None:
    """Return the quantum of ``channel``: under its own name, or under that without the track."""
    given = quanta or {}
    return given.get(str(channel.id), given.get(channel.id.name))


def check_quanta(recording: Recording, quanta: Mapping[str, float] | None) -> None:
    """Raise InputError for a quantum of no channel, or one that is no step."""
    names = {name for c in recording.channels for name in (str(c.id), c.id.name)}
    for name, quantum in (quanta or {}).items():
        if name not in names:
            raise InputError(f"quantum of {name}: no such channel; there are {', '.join(names)}")
        if not 0 < quantum < np.inf:
            raise InputError(f"quantum of {name} is {quantum}; give a number above zero")


def round_to_quantum(values: Floats, quantum: float | None) -> Floats:
    """Return ``values`` as multiples of ``quantum``; as they are without one."""
    return values if quantum is None else np.round(values / quantum) * quantum


def by_clock(channels: Sequence[Channel]) -> list[list[Channel]]:
    """Return the channels in groups of one clock each, in the order of their first."""
    groups: list[list[Channel]] = []
    for channel in channels:
        for group in groups:
            if _is_same(group[0].clock, channel.clock):
                group.append(channel)
                break
        else:
            groups.append([channel])
    return groups


def _is_same(one: UniformClock | StampedClock, other: UniformClock | StampedClock) -> bool:
    if isinstance(one, UniformClock) or isinstance(other, UniformClock):
        return one == other
    return one is other or np.array_equal(one.times_s, other.times_s)


def start_of(clock: UniformClock) -> str:
    """Return the start in s as text that reads back as the same float64."""
    return repr(float(clock.start_s))


def exact_start(clock: UniformClock) -> Fraction:
    """Return the start in s as its digits say."""
    return Fraction(start_of(clock))


__all__ = [
    "Floats",
    "by_clock",
    "check_quanta",
    "exact_start",
    "quantum_of",
    "replace_file",
    "round_to_quantum",
    "start_of",
]
