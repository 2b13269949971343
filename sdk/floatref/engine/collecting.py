"""Collecting the blocks at the end of a signal flow in a profile, with one copy in memory."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.engine.validity_and_sigma import (
    Reach,
    add_axis_error,
    add_contact_error,
    replace_by_validity,
)
from floatref.errors import InputError
from floatref.interfaces.pipeline import Pipeline
from floatref.stages.signals import ELEVATION, SIGMA
from floatref.values.arrays import FlagArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.profile import Profile, ProfileTrack
from floatref.version import __version__

SPARE = 16
"""A full array grows by one sample for this number of samples."""
LARGEST_ROOM = 1 << 27
"""Largest number of points allocated in advance; a jump of the encoder is not a long run."""

S = TypeVar("S", np.float64, np.uint8)


class Growing(Generic[S]):
    """A one-dimensional array of ``kind`` that grows at its end."""

    def __init__(self, kind: type[S], room: int = 0) -> None:
        """Begin without samples, with memory for ``room`` of them."""
        self._array: NDArray[S] = np.empty(min(room, LARGEST_ROOM), kind)
        self._size = 0

    def extend(self, values: NDArray[S]) -> None:
        """Add ``values`` at the end."""
        end = self._size + values.size
        if end > self._array.size:
            self._resize(end + end // SPARE)
        self._array[self._size : end] = values
        self._size = end

    def close(self) -> NDArray[S]:
        """Return the array in its final length."""
        self._resize(self._size)
        return self._array

    def _resize(self, size: int) -> None:
        # Resizing moves pages where the system can; nothing else refers to the array, except
        # perhaps a debugger.
        self._array.resize(size, refcheck=False)


@dataclass(frozen=True)
class Gathered:
    """Elevation and, where it is known, 1-σ in m, and flags of one wheel path, shape (N,) each."""

    elevation: FloatArray
    flags: FlagArray
    sigma: FloatArray | None = None


def collect_tracks(
    blocks: Iterable[Block], tracks: tuple[str, ...], room: int = 0, with_sigma: bool = False
) -> dict[str, Gathered]:
    """Return elevation and flags of all ``tracks``, and 1-σ if it is known.

    ``room`` is about how many points to expect.
    """
    channels = [ChannelId(ELEVATION, track) for track in tracks]
    elevations = [Growing(np.float64, room) for _ in tracks]
    flags = [Growing(np.uint8, room) for _ in tracks]
    sigmas = [Growing(np.float64, room) for _ in tracks if with_sigma]
    for block in blocks:
        for channel, elevation, marks in zip(channels, elevations, flags, strict=True):
            elevation.extend(block[channel])
            marks.extend(block.flags.get(channel, np.zeros(len(block), np.uint8)))
        for track, sigma in zip(tracks, sigmas, strict=False):
            sigma.extend(block[ChannelId(SIGMA, track)])
    known: list[FloatArray | None] = [sigma.close() for sigma in sigmas]
    known += [None] * (len(tracks) - len(known))
    grown = zip(tracks, elevations, flags, known, strict=True)
    return {track: Gathered(z.close(), marks.close(), s) for track, z, marks, s in grown}


def collect_profile(
    header: Header,
    blocks: Iterable[Block],
    chosen: Pipeline,
    resolved: Mapping[str, Any],
    room: int,
) -> Profile:
    """Return the profile made of ``blocks``, which ``header`` describes.

    ``room`` is the expected number of points. Raises InputError if they are on the time axis.
    """
    if header.axis is not Axis.DISTANCE:
        raise InputError(f"pipeline {chosen.name} ends on the time axis; it needs a projection")
    known = all(ChannelId(SIGMA, track) in header.channels for track in header.tracks)
    found = collect_tracks(blocks, header.tracks, room, known)
    reach = Reach.of(resolved)
    tracks = tuple(
        _track(name, found.pop(name), header.step, reach, resolved) for name in header.tracks
    )
    return Profile(
        interval_m=header.step,
        tracks=tracks,
        start_m=header.origin,
        pipeline=chosen.name,
        settings=resolved,
        provenance={
            "architecture": chosen.architecture,
            "floatref": __version__,
            "numpy": version("numpy"),
        },
    )


def _track(
    name: str, found: Gathered, interval_m: float, reach: Reach, resolved: Mapping[str, Any]
) -> ProfileTrack:
    valid, sigma = replace_by_validity(found.flags, interval_m, reach), found.sigma
    if sigma is not None:
        scale = resolved.get("distance_scale_sigma") or 0.0
        add_axis_error(sigma, found.elevation, interval_m, scale)
        if contact_m := resolved.get("contact_m"):
            add_contact_error(sigma, found.elevation, interval_m, contact_m)
    return ProfileTrack.taking(name, found.elevation, valid, sigma)
