"""A stream on disk: everything that its final points still depend on, in one file.

The file is a zip of arrays as `numpy.savez` writes it, without objects, and the array `state` holds
a JSON document in UTF-8. Provisional points are not in it: their filter runs in anew.
"""

import json
import struct
import tokenize
import zlib
from collections.abc import Mapping
from dataclasses import fields
from fractions import Fraction
from pathlib import Path
from typing import Any, NoReturn
from zipfile import BadZipFile

import numpy as np
from numpy.lib.npyio import NpzFile
from numpy.typing import NDArray

from floatref.engine.choosing import AUTO
from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref.files.recording_directory import describe_installation, setup_of
from floatref.files.sources import open_bytes
from floatref.live.declared_channels import Entrance, name_channel
from floatref.live.following import Following
from floatref.live.held_samples import HeldChannel
from floatref.live.joints import WindowPoints
from floatref.live.starting import settle
from floatref.live.window_plan import WindowPlan
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.profile import ProfileTrack
from floatref.version import __version__

FORMAT = "floatref-stream/1"
DAMAGED = (
    *(BadZipFile, EOFError, KeyError, MemoryError, OSError, OverflowError, RecursionError),
    *(RuntimeError, SyntaxError, TypeError, ValueError, struct.error, tokenize.TokenError),
    zlib.error,
)
"""What zipfile and numpy raise for a file that is no archive of arrays, or a damaged one."""
PLAN = tuple(each.name for each in fields(WindowPlan) if each.name not in ("bounds", "places"))
Arrays = dict[str, NDArray[Any]]
Clocks = Mapping[ChannelId, UniformClock | None]


def save_state(path: Path, following: Following, entrance: Entrance) -> None:
    """Write the state to ``path``, in place of an older one; InputError if that fails."""
    arrays: Arrays = {"places": np.array(following.plan.places)}
    state = {
        "format": FORMAT,
        "floatref": __version__,
        **describe_installation(following.order.example),
        "order": _describe_order(following),
        "channels": [
            _describe_channel(n, each, entrance, arrays)
            for n, each in enumerate(following.held.values())
        ],
        "plan": {name: _finite(getattr(following.plan, name)) for name in PLAN},
        "late": {str(name): count for name, count in following.late.items()},
        "tick": following.tick,
        "distance_m": following.distance_m,
        "refused": None if following.refused is None else str(following.refused),
        "accepted": following.accepted,
        "offset_m": following.runs.offset_m,
        "next": following.joints.next,
        "tail": _describe_tail(following.joints.tail, arrays),
    }
    text = json.dumps(state, allow_nan=False).encode()
    arrays["state"] = np.frombuffer(text, np.uint8)
    with replace_file(path, overwrite=True) as beside, beside.open("wb") as stream:
        np.savez(stream, allow_pickle=False, **arrays)


def load_state(path: Path) -> tuple[Following, Entrance]:
    """Return the state in ``path``; InputError for a file that is not one of this format."""
    try:
        arrays = _read_arrays(path)
        state = json.loads(arrays["state"].tobytes())
    except InputError as error:
        reason = str(error).removeprefix(f"{path}: ")
        raise InputError(f"{path}: cannot be read ({reason}); give a saved stream") from error
    except DAMAGED as error:
        raise InputError(f"{path}: is no saved stream; save one with LiveStream.save") from error
    if not isinstance(state, dict) or state.get("format") != FORMAT:
        raise InputError(f"{path}: is no saved stream of format {FORMAT}; save it again")
    if state["floatref"] != __version__:
        raise InputError(
            f"{path}: was saved by floatref {state['floatref']}, this is {__version__}; resume it "
            "with that version"
        )
    return _restore(state, arrays)


def _read_arrays(path: Path) -> Arrays:
    with open_bytes(path) as stream:
        stored = np.load(stream, allow_pickle=False)
        if not isinstance(stored, NpzFile):
            raise ValueError("one array alone")
        return _Stored(path, {name: stored[name] for name in stored.files})


class _Stored(dict[str, Any]):
    """The arrays of a file by their names, which no checksum protects as it does what they hold."""

    def __init__(self, path: Path, arrays: Arrays) -> None:
        """Hold the ``arrays`` of the file at ``path``."""
        super().__init__(arrays)
        self._path = path

    def __missing__(self, name: str) -> NoReturn:
        """Raise InputError for an array that is not there."""
        raise InputError(f"{self._path}: holds no array {name}; give a whole saved stream")


def _describe_order(following: Following) -> dict[str, Any]:
    order = following.order
    return {
        "pipeline": AUTO if order.reason else order.pipelines[0],
        "settings": dict(order.settings),
        "late_s": order.bounds.late_s,
        "provisional": following.forward is not None,
    }


def _describe_channel(
    number: int, held: HeldChannel, entrance: Entrance, arrays: Arrays
) -> dict[str, Any]:
    arrays[f"values_{number}"] = held.values.take(0, held.values.end)
    arrays[f"times_{number}"] = held.times.take(0, held.times.end)
    clock = held.clock
    return {
        "name": str(held.name),
        "rate": None if clock is None else [clock.rate.numerator, clock.rate.denominator],
        "start_s": None if clock is None else clock.start_s,
        "first": held.values.first,
        "passed_s": _finite(held.passed_s),
        "owed": held.owed,
        "latest_s": entrance.latest_s.get(held.name),
    }


def _describe_tail(tail: WindowPoints, arrays: Arrays) -> dict[str, Any]:
    for n, track in enumerate(tail.tracks):
        arrays[f"tail_{n}"], arrays[f"tail_valid_{n}"] = track.elevation, track.valid
        if track.sigma is not None:
            arrays[f"tail_sigma_{n}"] = track.sigma
    return {"first": tail.first, "tracks": [track.name for track in tail.tracks]}


def _restore(state: Mapping[str, Any], arrays: Arrays) -> tuple[Following, Entrance]:
    clocks = {name_channel(each["name"]): _clock(each) for each in state["channels"]}
    order = state["order"]
    setup = setup_of(state["setup"])
    settled = settle(setup, clocks, order["pipeline"], order["settings"], order["late_s"])
    following, entrance = Following(settled, order["provisional"]), Entrance(clocks)
    for n, each in enumerate(state["channels"]):
        held = following.held[name_channel(each["name"])]
        held.restore(arrays[f"values_{n}"], arrays[f"times_{n}"], each["first"])
        held.passed_s, held.owed = _infinite(each["passed_s"]), each["owed"]
        if each["latest_s"] is not None:
            entrance.latest_s[held.name] = each["latest_s"]
    following.plan = WindowPlan(settled.bounds, arrays["places"].tolist(), **_plan(state["plan"]))
    following.late = {name_channel(name): count for name, count in state["late"].items()}
    following.tick, following.distance_m = state["tick"], state["distance_m"]
    following.refused = None if state["refused"] is None else InputError(state["refused"])
    following.accepted = state["accepted"]
    following.runs.offset_m = state["offset_m"]
    following.joints.next = state["next"]
    following.joints.tail = _tail(state["tail"], arrays)
    return following, entrance


def _clock(entry: Mapping[str, Any]) -> UniformClock | None:
    if entry["rate"] is None:
        return None
    return UniformClock(Fraction(*entry["rate"]), entry["start_s"])


def _plan(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {**entry, "begin_s": _infinite(entry["begin_s"])}


def _tail(entry: Mapping[str, Any], arrays: Arrays) -> WindowPoints:
    tracks = (
        ProfileTrack.of(
            name, arrays[f"tail_{n}"], arrays[f"tail_valid_{n}"], arrays.get(f"tail_sigma_{n}")
        )
        for n, name in enumerate(entry["tracks"])
    )
    return WindowPoints(entry["first"], tuple(tracks))


def _finite(value: Any) -> Any:
    """Return ``value``; None in place of minus infinity, which JSON has not."""
    return None if isinstance(value, float) and value == -np.inf else value


def _infinite(value: float | None) -> float:
    return -np.inf if value is None else value
