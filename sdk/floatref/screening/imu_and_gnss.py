"""Whether IMU and GNSS are installed as a Kalman pipeline takes them to be.

A wrong sign, a wrong unit or an exchanged axis leaves a profile that looks like one. What a run
contradicts beyond doubt is refused; what it makes likely, and what is bridged, is a warning.
"""

from collections.abc import Iterator

from floatref.screening.antenna_lever import check_antenna
from floatref.screening.gnss_height import (
    faults_told,
    fixed_told,
    gnss_faults,
    jumps_told,
)
from floatref.screening.gnss_timing import (
    check_epoch,
    check_velocity,
    delay,
    delay_told,
    on_time,
)
from floatref.screening.horizontal_forces import check_curves, check_travel_force
from floatref.screening.imu_channels import check_alive, check_present, check_readings, imu_silences
from floatref.screening.rates_and_attitude import check_plausible_rates, check_rates
from floatref.screening.slow_series import Motion
from floatref.values.needs import profiled_tracks
from floatref.values.recording import Recording

__all__ = ["check_kinematics", "gnss_faults"]


def check_kinematics(
    recording: Recording, track: str, uses_gnss: bool, uses_attitude: bool
) -> tuple[str, ...]:
    """Return warnings about the IMU and GNSS channels of ``track``, one line each.

    What each track's accelerometers measure of the antenna, its place and its delay, differs by
    their noise; it is told with the first track.

    Args:
        recording: one that `examine` has found plausible.
        track: a wheel path; channels without one are shared.
        uses_gnss: whether the pipeline reads gnss_height and gnss_vertical_velocity.
        uses_attitude: whether it reads gnss_pitch and gnss_roll.

    Raises InputError with one line naming the channel, the value and what to do, for channels that
    are missing, silent for most of the run or beyond what a vehicle does, GNSS of another time
    base, and a sign, unit or axis that is certainly wrong.
    """
    check_present(recording, track, uses_gnss, uses_attitude)
    span_s = recording.channel("distance", track).span_s
    check_readings(recording)
    warnings = list(imu_silences(recording, track))
    if uses_gnss:
        warnings += check_epoch(recording, *span_s)
    motion = Motion.of(recording, track)
    if motion is not None:
        check_alive(recording, track, motion)
        check_plausible_rates(recording, track, motion)
        if uses_gnss:
            delay_s = delay(recording, motion)
            told = tuple(delay_told(delay_s))
            warnings += told if _is_first(recording, track) else ()
            recording = on_time(recording, delay_s)
        warnings += check_travel_force(recording, track, motion)
        warnings += check_curves(recording, track, motion)
        warnings += check_rates(recording, track, motion, uses_attitude)
    if uses_gnss:
        warnings += _gnss(recording, track, motion, span_s)
    return tuple(warnings)


def _gnss(
    recording: Recording, track: str, motion: Motion | None, span_s: tuple[float, float]
) -> Iterator[str]:
    faults = gnss_faults(recording)
    yield from fixed_told(recording, *span_s)
    yield from faults_told(recording, faults)
    if motion is not None:
        yield from check_velocity(recording, motion)
        if _is_first(recording, track):
            yield from check_antenna(recording, track, motion, faults)
    yield from jumps_told(recording, faults)


def _is_first(recording: Recording, track: str) -> bool:
    return track == profiled_tracks(recording)[0]
