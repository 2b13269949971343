"""Whether IMU and GNSS are installed as a Kalman pipeline assumes.

A wrong sign, a wrong unit or an exchanged axis leaves a profile that looks like one. A certain
fault is refused; a likely fault, and a bridged gap, is a warning.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from floatref.screening.antenna_lever import check_antenna
from floatref.screening.gnss_height import report_faults, report_jumps, report_unfixed
from floatref.screening.gnss_timing import (
    check_epoch,
    check_velocity,
    correct_delay,
    delay,
    report_delay,
)
from floatref.screening.horizontal_forces import check_course, check_curves, check_travel_force
from floatref.screening.imu_channels import (
    IMU,
    check_alive,
    check_present,
    check_readings,
    imu_silences,
)
from floatref.screening.rates_and_attitude import check_plausible_rates, check_rates
from floatref.screening.slow_series import RATES, Motion
from floatref.values.arrays import IndexArray
from floatref.values.recording import Channel, Recording


@dataclass(frozen=True)
class ImuUse:
    """The channels of IMU and GNSS that a pipeline reads.

    Attributes:
        tracks: wheel paths, in order; channels without one are shared.
        gnss: whether it reads gnss_height and gnss_vertical_velocity.
        attitude: whether it reads gnss_pitch and gnss_roll.
    """

    tracks: tuple[str, ...]
    gnss: bool
    attitude: bool


def check_kinematics(recording: Recording, use: ImuUse, faults: IndexArray) -> tuple[str, ...]:
    """Return warnings about the IMU and GNSS channels that are used, one line each.

    Shared channels are checked with the first wheel path. The antenna's position and delay,
    measured with each path's accelerometers, differ only by noise, so the first path is used.

    Args:
        recording: a recording that `examine` has found plausible.
        use: the channels that are read.
        faults: stuck readings of gnss_height, as `gnss_faults` returns them.

    Raises InputError with one line naming the channel, the value and what to do, for channels that
    are missing, silent for most of the run or beyond the limits of a vehicle, GNSS on another time
    base, and a sign, unit or axis that is certainly wrong.
    """
    for track in use.tracks:
        check_present(recording, track, use.gnss, use.attitude)
    check_readings(recording)
    first, *others = _paths(recording, use.tracks)
    lines = list(imu_silences(first.own))
    if use.gnss:
        lines += check_epoch(recording, *first.span_s(recording))
    motion = Motion.of(recording, first.track)
    late_s = delay(recording, motion) if use.gnss and motion is not None else 0.0
    aligned = correct_delay(recording, late_s)
    lines += _check_imu(aligned, first, motion, use, late_s)
    if use.gnss:
        lines += _check_gnss(aligned, first, motion, faults)
    for path in others:
        lines += _check_other_path(aligned, path, use)
    return tuple(dict.fromkeys(lines))


@dataclass(frozen=True)
class _Path:
    """A wheel path and ``own``, the IMU channels that no path before it shares."""

    track: str
    own: tuple[Channel, ...]

    def has_own(self, *names: str) -> bool:
        """Return whether one of the channels called ``names`` is not shared."""
        return any(channel.id.name in names for channel in self.own)

    def span_s(self, recording: Recording) -> tuple[float, float]:
        """Return when the run begins and ends by the encoder, in s."""
        return recording.channel("distance", self.track).span_s


def _paths(recording: Recording, tracks: tuple[str, ...]) -> Iterator[_Path]:
    seen: set[object] = set()
    for track in tracks:
        channels = [recording.channel(name, track) for name in IMU]
        yield _Path(track, tuple(c for c in channels if c.id not in seen))
        seen.update(channel.id for channel in channels)


def _check_other_path(recording: Recording, path: _Path, use: ImuUse) -> Iterator[str]:
    """Yield further warnings for a wheel path after the first one."""
    yield from imu_silences(path.own)
    motion = Motion.of(recording, path.track)
    yield from _check_imu(recording, path, motion, use)
    if use.gnss and motion is not None:
        yield from check_velocity(recording, motion)


def _check_imu(
    recording: Recording, path: _Path, motion: Motion | None, use: ImuUse, late_s: float = 0.0
) -> Iterator[str]:
    """Yield warnings about the path's own channels, and about a delay of GNSS."""
    if motion is None or not path.own:
        return
    check_alive(recording, path.track, motion)
    if path.has_own(*RATES):
        check_plausible_rates(recording, path.track, motion)
    yield from report_delay(late_s)
    yield from check_travel_force(recording, path.track, motion)
    if path.has_own(*RATES):
        yield from check_course(recording, path.track, motion)
    yield from check_curves(recording, path.track, motion)
    yield from check_rates(recording, path.track, motion, use.attitude)


def _check_gnss(
    recording: Recording, first: _Path, motion: Motion | None, faults: IndexArray
) -> Iterator[str]:
    yield from report_unfixed(recording, *first.span_s(recording))
    yield from report_faults(recording, faults)
    if motion is not None:
        yield from check_velocity(recording, motion)
        yield from check_antenna(recording, first.track, motion, faults)
    yield from report_jumps(recording, faults)
