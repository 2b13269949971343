"""Wrong readings of sensors: signs, scales, units, delays, lost samples."""

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.mutants import recordings as r
from floatref_conformance.mutants.mutation import Mutation, all_but

FOOT_M = 0.3048

IN_SENSORS = (
    Mutation(
        "accelerometer-sign",
        "takes upward acceleration for downward",
        all_but("quiescent", "low-speed"),
        r.change_channel(r.FORCE, r.invert_acceleration),
    ),
    Mutation(
        "laser-sign",
        "takes a longer range for a higher road",
        all_but("low-speed"),
        r.change_channel(r.HEIGHT, r.mirror),
    ),
    Mutation(
        "accelerometer-high",
        "reads accelerations 1 % too large",
        ("bounce", "waveband"),
        r.change_channel(r.FORCE, r.scale_acceleration(1.01)),
    ),
    Mutation(
        "accelerometer-low",
        "reads accelerations 1 % too small",
        ("bounce", "waveband"),
        r.change_channel(r.FORCE, r.scale_acceleration(0.99)),
    ),
    Mutation(
        "laser-high",
        "reads heights 1 % too large",
        ("bounce", "waveband"),
        r.change_channel(r.HEIGHT, r.scale(1.01)),
    ),
    Mutation(
        "laser-low",
        "reads heights 1 % too small",
        ("bounce", "waveband"),
        r.change_channel(r.HEIGHT, r.scale(0.99)),
    ),
    Mutation(
        "late-laser",
        "reads the laser 2 ms late",
        ("bounce", "waveband"),
        r.change_channel(r.HEIGHT, r.delay_by(0.002)),
    ),
    Mutation(
        "late-accelerometer",
        "reads the accelerometer 2 ms late",
        ("bounce", "waveband"),
        r.change_channel(r.FORCE, r.delay_by(0.002)),
    ),
    Mutation(
        "height-only",
        "ignores the accelerometer",
        all_but("quiescent", "low-speed"),
        r.change_channel(r.FORCE, r.replace_by_rest),
    ),
    Mutation(
        "accelerometer-only",
        "ignores the laser",
        all_but("low-speed"),
        r.change_channel(r.HEIGHT, r.hold_first),
    ),
    Mutation(
        "force-in-g",
        "takes accelerations in g for m/s²",
        all_but("quiescent", "low-speed"),
        r.change_channel(r.FORCE, r.scale_acceleration(1 / STANDARD_GRAVITY)),
    ),
    Mutation(
        "height-in-feet",
        "takes heights in feet for m",
        all_but("low-speed"),
        r.change_channel(r.HEIGHT, r.scale(1 / FOOT_M)),
    ),
    Mutation(
        "distance-in-feet",
        "takes distances in feet for m",
        all_but(),
        r.change_channel(r.DISTANCE, r.scale(1 / FOOT_M)),
    ),
    Mutation(
        "sample-lost",
        "loses one of 4096 samples of the accelerometer",
        ("bounce", "dead-start", "waveband", "invariance"),
        r.change_channel(r.FORCE, r.lose_samples(4096)),
    ),
    Mutation(
        "accelerometer-clipped",
        "clips accelerations at 0.5 g",
        ("bounce", "stop"),
        r.change_channel(r.FORCE, r.clip(0.5 * STANDARD_GRAVITY)),
    ),
    Mutation("time-rounded", "stores times in single precision", ("invariance",), r.round_times),
    Mutation(
        "missing-height-zero",
        "takes a missing height for 0",
        ("faults",),
        r.change_channel(r.HEIGHT, r.fill_missing(0.0)),
    ),
    Mutation(
        "missing-force-zero",
        "takes a missing acceleration for 0",
        ("faults",),
        r.change_channel(r.FORCE, r.fill_missing(0.0)),
    ),
    Mutation(
        "gaps-vouched",
        "bridges gaps and marks them valid",
        ("faults",),
        r.bridge_missing,
    ),
)
"""Mutations of the recording."""
