"""What the fit of a stop takes sensors, vehicle and road for."""

from dataclasses import dataclass

from floatref.values.channels import STANDARD_GRAVITY


@dataclass(frozen=True)
class SlopeModel:
    """Constants of the rows, by the names of docs/road-prior-slope.md; 1-σ and densities.

    Attributes:
        interval_s: Δ between time nodes, at most 1 s over 6 times the frequency of pitch.
        spacing_m: d between points of the road.
        gravity: g in m/s².
        reading_m: σ_h of a mean reading of the height sensor.
        road: q of the road's elevation, in m.
        bends, bend_weight, most_bend, first_bend: g_0 in 1/m and ν; the largest g and the first,
            over g_0.
        segment_m: length of road that has one g.
        acceleration: σ_a in m/s²/√Hz.
        force_share: ε, the part of the force itself that is not sure: scale and timing.
        missing_acceleration: takes its place where samples are missing.
        bias, walk: σ_b0 in m/s² and σ_b in m/s²/√s.
        swing, swing_speed: σ_s0 in rad/s²/√Hz, and σ_s1, what each m/s of speed adds.
        even_m, even_speed: σ_e0 in m, and σ_e1 in m per m/s.
        bounce_s: time for which the height over the axles is one error.
        slope, slope_reach_m: σ_s of the mean slope over ℓ.
        gain, gain_sigma: κ in rad per m/s².
        lean_rad, lean_sigma_rad: λ.
        centre, centre_sigma: H.
        offset_m: 1-σ of h_0.
        start_m: 1-σ of z_0.
        hz, hz_sigma: f and 1-σ of its logarithm.
        damping, damping_sigma: ζ and 1-σ of its logarithm.
    """

    interval_s: float = 0.03
    spacing_m: float = 0.25
    gravity: float = STANDARD_GRAVITY
    reading_m: float = 2e-4
    road: float = 4e-6
    bends: float = 2e-7
    bend_weight: float = 1.0
    most_bend: float = 4000.0
    first_bend: float = 30.0
    segment_m: float = 10.0
    acceleration: float = 1.5e-4
    force_share: float = 0.003
    missing_acceleration: float = 0.3
    bias: float = 0.03
    walk: float = 1e-4
    swing: float = 5e-4
    swing_speed: float = 1e-3
    even_m: float = 2e-4
    even_speed: float = 3e-4
    bounce_s: float = 0.3
    slope: float = 0.01
    slope_reach_m: float = 60.0
    gain: float = 0.005
    gain_sigma: float = 0.004
    lean_rad: float = 0.0
    lean_sigma_rad: float = 0.02
    centre: float = 0.5
    centre_sigma: float = 0.2
    offset_m: float = 1.0
    start_m: float = 1.0
    hz: float = 1.6
    hz_sigma: float = 0.3
    damping: float = 0.3
    damping_sigma: float = 0.5


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
