"""What the fit of a stop takes sensors, vehicle and road for."""

from dataclasses import dataclass

import numpy as np

from floatref.values.channels import STANDARD_GRAVITY


@dataclass(frozen=True)
class SlopeModel:
    """Constants of the rows, by the names of docs/road-prior-slope.md; 1-σ and densities.

    Attributes:
        interval_s: Δ between time nodes: a body of 2 Hz moves smoothly over it.
        spacing_m: d between points of the road.
        gravity: g in m/s².
        reading_m: σ_h of a mean reading of the height sensor.
        sway_m: η, height over the road of the point about which the body pitches.
        road: q of the road's elevation, in m.
        bends, bend_weight, most_bend, first_bend: g_0 in 1/m and ν; the largest g and the first,
            over g_0.
        segment_m: length of road that has one g.
        slope, slope_reach_m: σ_s of the mean slope over ℓ.
        start_m: 1-σ of z_0.
        acceleration: σ_a in m/s²/√Hz.
        force_share: ε, the part of the force itself that is not sure: scale and timing.
        missing_acceleration: takes its place where samples are missing.
        bias, walk: σ_b0 in m/s² and σ_b in m/s²/√s.
        offset_m, offset_walk: 1-σ of o_0 in m, and σ_o in m/√s.
        rest_s, first_sag_m: time after which a body that stands has swung out, so that a step of
            the offset is somebody who boards, and that step in the first pass.
        moment, moment_walk, moment_share: σ_μ0 in m/s², σ_μ in m/s²/√s, and the part of a change
            of β that is not sure to be one of grade.
        bounce, bounce_speed: σ_v0 in m/s²/√Hz, and σ_v1, what each m/s of speed adds.
        swing, swing_speed: σ_p0 in rad/s²/√Hz, and σ_p1.
        heave_m, heave_speed: σ_u0 in m, and σ_u1 in m per m/s.
        nod_rad, nod_speed: σ_n0 in rad, and σ_n1 in rad per m/s.
        jolt_bounce, jolt_pitch: ι_v, and ι_p in rad/m.
        gain, gain_sigma: κ in rad per m/s².
        lean_rad, lean_sigma_rad: λ.
        centre, centre_sigma: H.
        hz, damping: f_0 and ζ_0, from which the springs' means are.
        stiffness_sigma, damping_sigma: 1-σ of ln K and ln C.
        gyration, gyration_sigma: γ_0 and 1-σ of its logarithm.
    """

    interval_s: float = 0.06
    spacing_m: float = 0.25
    gravity: float = STANDARD_GRAVITY
    reading_m: float = 1e-4
    sway_m: float = 0.5
    road: float = 4e-6
    bends: float = 2e-7
    bend_weight: float = 1.0
    most_bend: float = 4000.0
    first_bend: float = 30.0
    segment_m: float = 10.0
    slope: float = 0.06
    slope_reach_m: float = 60.0
    start_m: float = 1.0
    acceleration: float = 1.5e-4
    force_share: float = 0.003
    missing_acceleration: float = 0.3
    bias: float = 0.03
    walk: float = 1e-4
    offset_m: float = 1.0
    offset_walk: float = 2e-4
    rest_s: float = 1.0
    first_sag_m: float = 1e-3
    moment: float = 0.1
    moment_walk: float = 0.02
    moment_share: float = 0.3
    bounce: float = 1e-3
    bounce_speed: float = 4e-4
    swing: float = 1e-3
    swing_speed: float = 4e-4
    heave_m: float = 5e-6
    heave_speed: float = 1.3e-5
    nod_rad: float = 5e-6
    nod_speed: float = 7e-6
    jolt_bounce: float = 0.003
    jolt_pitch: float = 0.015
    gain: float = 0.005
    gain_sigma: float = 0.004
    lean_rad: float = 0.0
    lean_sigma_rad: float = 0.02
    centre: float = 0.5
    centre_sigma: float = 0.2
    hz: float = 1.6
    damping: float = 0.3
    stiffness_sigma: float = 0.6
    damping_sigma: float = 0.8
    gyration: float = 0.9
    gyration_sigma: float = 0.15

    @property
    def means(self) -> dict[str, float]:
        """The mean of each of `layout.GLOBALS` before the readings."""
        omega, squared = 2.0 * np.pi * self.hz, self.gyration**2
        stiffness = float(np.log(0.5 * omega**2 * squared))
        damping = float(np.log(self.damping * omega * squared))
        return {
            "gain": self.gain,
            "lean": self.lean_rad,
            "centre": self.centre,
            "log_front": stiffness,
            "log_rear": stiffness,
            "log_front_damping": damping,
            "log_rear_damping": damping,
            "log_gyration": float(np.log(self.gyration)),
        }

    @property
    def sigmas(self) -> dict[str, float]:
        """Their 1-σ."""
        return {
            "gain": self.gain_sigma,
            "lean": self.lean_sigma_rad,
            "centre": self.centre_sigma,
            "log_front": self.stiffness_sigma,
            "log_rear": self.stiffness_sigma,
            "log_front_damping": self.damping_sigma,
            "log_rear_damping": self.damping_sigma,
            "log_gyration": self.gyration_sigma,
        }


@dataclass(frozen=True)
class Places:
    """Where the axles are, x_f and x_r ahead of the laser, and the laser before its accelerometer.

    All in m.
    """

    front_m: float
    rear_m: float
    lever_m: float

    @property
    def wheelbase_m(self) -> float:
        """L."""
        return self.front_m - self.rear_m
