"""What `bench_road_prior_limits.py` does to a stop at 0.2 g, by kind and severity."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from kind_drives import KIND
from road_prior_changes import (
    STOP_M,
    Change,
    RoadChange,
    bias_step,
    boarding,
    crack,
    injured,
    shaking,
    step,
    texture,
)

from floatref_conformance.proving_ground.scenario import Scenario

DWELL_S = 5.8
STOP = Scenario(manoeuvre="stop", event_at_m=STOP_M, dwell_s=DWELL_S, imu=False, gnss=False, **KIND)
CREEP_M = 300.0
"""Creeping half an hour is simulated on this length, and at `SLOW_RATE_HZ`."""
SLOW_RATE_HZ = 2000.0


@dataclass(frozen=True, eq=False)
class Adversity:
    """One severity of one kind.

    Attributes:
        kind: what is done.
        severity: how much of it.
        scenario: what is driven.
        where_m: middle of the stretch that is compared, in m of true distance.
        road: changes the road before.
        change: changes the recording behind.
    """

    kind: str
    severity: str
    scenario: Scenario = STOP
    where_m: float = STOP_M
    road: RoadChange | None = None
    change: Change | None = None


def stop(**changes: Any) -> Scenario:
    """Return the stop with other numbers."""
    return replace(STOP, **changes)


def creep(speed_kmh: float) -> Scenario:
    """Return a drive about ``speed_kmh``, a fifth to either side."""
    speeds = {"speed_kmh": 0.8 * speed_kmh, "event_speed_kmh": 1.2 * speed_kmh}
    more = {"length_m": CREEP_M, "rate_hz": SLOW_RATE_HZ, **speeds}
    return replace(STOP, manoeuvre="creeping", **more)


def queue(spacing_m: float, speed_kmh: float) -> Scenario:
    """Return ten stops in a row about `STOP_M`."""
    first = STOP_M - 4.5 * spacing_m
    return stop(
        speed_kmh=speed_kmh,
        final_speed_kmh=speed_kmh,
        stops=10,
        stop_spacing_m=spacing_m,
        event_at_m=max(first, 106.0),
        dwell_s=3.0,
        length_m=max(first, 106.0) + 9.0 * spacing_m + 184.0,
    )


def of_the_drive() -> Iterator[Adversity]:
    """Yield what vehicles and their drivers do."""
    yield Adversity("none", "0.2 g, 5.8 s")
    for g in (0.35, 0.5, 0.8):
        yield Adversity("hard brake", f"{g:g} g", stop(deceleration_g=g))
    for vehicle in ("soft-van", "pickup", "trailer"):
        for g, iri in ((0.2, 1.8), (0.4, 1.8), (0.3, 6.0)):
            changes = {"vehicle": vehicle, "deceleration_g": g, "iri_m_per_km": iri}
            yield Adversity(vehicle, f"{g:g} g, {iri:g} m/km", stop(**changes))
    for spacing_m, speed_kmh in ((80.0, 33.0), (25.0, 18.0), (8.0, 10.0)):
        drive = queue(spacing_m, speed_kmh)
        middle = drive.event_at_m + 4.5 * spacing_m
        yield Adversity("ten stops", f"{spacing_m:g} m apart", drive, middle)
    for seconds in (60.0, 600.0):
        drive = stop(dwell_s=seconds, rate_hz=SLOW_RATE_HZ)
        yield Adversity("long stop", f"{seconds:g} s", drive)
    for sag_mm in (5.0, 20.0):
        yield Adversity("boarding at the stop", f"{sag_mm:g} mm", change=boarding(sag_mm))
    for speed_kmh in (3.0, 2.0, 1.0):
        where = {"scenario": creep(speed_kmh), "where_m": CREEP_M / 2}
        yield Adversity("creeping", f"{speed_kmh:g} km/h", **where)


def of_the_road() -> Iterator[Adversity]:
    for depth_mm in (5.0, 20.0, 50.0):
        yield Adversity("crack under the laser", f"{depth_mm:g} mm deep", road=crack(depth_mm))
    for percent in (6.0, 12.0, 20.0):
        yield Adversity("hill", f"{percent:g} %", stop(grade_percent=percent))
    for before, behind in ((0.8, 6.0), (6.0, 0.8), (0.8, 12.0)):
        change = step(before, behind)
        yield Adversity("roughness step", f"{before:g} to {behind:g} m/km", road=change)
    for rms_mm in (0.3, 1.0, 2.0):
        yield Adversity("coarse texture", f"{rms_mm:g} mm", road=texture(rms_mm))


def of_the_sensors() -> Iterator[Adversity]:
    """Yield what sensors and their mounts do."""
    for a in (0.3, 1.0, 3.0):
        yield Adversity("engine shakes body", f"{a:g} m/s²", change=shaking(a, True))
    for a in (0.3, 1.0, 3.0):
        yield Adversity("mount resonates", f"{a:g} m/s²", change=shaking(a, False))
    for size in (0.003, 0.01, 0.03):
        yield Adversity("bias of the standstill", f"{size:g} m/s²", change=bias_step(size))
    for fault in ("laser-dropout", "laser-stuck"):
        for seconds, ahead_m in ((2.0, 0.0), (8.0, 2.0)):
            change = injured(fault, seconds, ahead_m)
            yield Adversity(fault.replace("-", " "), f"{seconds:g} s", change=change)
    for factor in (3.0, 10.0):
        yield Adversity("worse sensors", f"errors x {factor:g}", stop(sensors=factor))


def of_the_encoder() -> Iterator[Adversity]:
    """Yield what the encoder and its wheel do."""
    for percent in (1.0, 5.0, -20.0):
        drive = stop(encoder_error_percent=percent)
        yield Adversity("encoder scale", f"{percent:+g} %", drive)
    for percent in (3.0, 10.0, 30.0):
        yield Adversity("slip in the brake", f"{percent:g} %/g", stop(slip_percent_per_g=percent))
    for seconds in (0.1, 0.3, 1.0):
        change = injured("encoder-lost-counts", seconds, ahead_m=8.0)
        yield Adversity("locked wheel", f"{seconds:g} s", change=change)


def adversities() -> Iterator[Adversity]:
    """Yield all of them, the plain stop first."""
    for each in (of_the_drive, of_the_road, of_the_sensors, of_the_encoder):
        yield from each()
