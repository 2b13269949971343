"""Constants of the slope under the wheels, with their units."""

from typing import NamedTuple


class Constants(NamedTuple):
    """Constants of the model; noise as densities, but for heights, heave, nod and jolts.

    Equation:
        As named on the page; a speed adds to a 1-σ what the field of that name says, per m/s

    Attributes:
        interval_s: Δ, between nodes, s.
        spacing_m: d, between points of the road, m.
        gravity: g, m/s².
        reading_m: σ_h, of a height, m.
        road: q, intensity of the road's elevation, m²/m.
        bends: g_0, intensity of the slope of a plain road, 1/m.
        bend_weight: ν, degrees of freedom of g_0.
        most_bend: largest intensity over g_0.
        first_bend: intensity at the start over g_0.
        segment_m: length of road with one intensity, m.
        acceleration: σ_a, m/s²/√Hz.
        force_share: ε, the part of F that is not sure.
        missing_acceleration: σ_m in place of σ_a where a sample is missing, m/s²/√Hz.
        bias: σ_b0, of the first bias, m/s².
        walk: σ_b, m/s²/√s.
        offset_m: 1-σ of o_0 about 0, m.
        offset_walk: σ_o, m/√s.
        moment: σ_μ0, m/s².
        moment_walk: σ_μ, m/s²/√s.
        moment_share: share of the change of g β that the grade differs by.
        bounce: σ_v0, m/s²/√Hz.
        bounce_speed: σ_v1.
        swing: σ_p0, rad/s²/√Hz.
        swing_speed: σ_p1.
        heave_m: σ_u0, m.
        heave_speed: σ_u1.
        nod_rad: σ_n0, rad.
        nod_speed: σ_n1.
        jolt_bounce: ι_v, m/s² per m/s² of a jolt.
        jolt_pitch: ι_p, rad/s² per m/s² of a jolt.
        sway_m: η, height over the road that the body pitches about, m.
        slope: σ_s, of the road's slope as the mean over slope_reach_m.
        slope_reach_m: ℓ, m.
        gain: κ_0, rad per m/s².
        gain_sigma: σ_κ, rad per m/s².
        lean_rad: λ_0, rad.
        lean_sigma_rad: σ_λ, rad.
        centre: mean of H.
        centre_sigma: 1-σ of H.
        start_m: 1-σ of z_0 about 0, m.
        hz: f_0, of a pitching body of even springs, Hz.
        damping: ζ_0, its damping ratio.
        stiffness_sigma: 1-σ of ln K_f and of ln K_r.
        damping_sigma: 1-σ of ln C_f and of ln C_r.
        gyration: γ_0.
        gyration_sigma: 1-σ of ln γ.
        known_m: 1-σ of the road's second difference outside of a brake, m.
        gain_doubt: share of κ that is not sure, as a real body is no half car.
        turn_doubt: what a change of β of 1 over a wheelbase adds to it.
        grade_together: by how many times the mean slope of the stretch is less sure than its rows
            have it, as they err together.
        grade_doubt: 1-σ of that slope at most.
    """

    interval_s: float = 0.06
    spacing_m: float = 0.25
    gravity: float = 9.80665
    reading_m: float = 1e-4
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
    offset_m: float = 1.0
    offset_walk: float = 2e-4
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
    sway_m: float = 0.5
    slope: float = 0.06
    slope_reach_m: float = 60.0
    gain: float = 0.005
    gain_sigma: float = 0.004
    lean_rad: float = 0.0
    lean_sigma_rad: float = 0.02
    centre: float = 0.5
    centre_sigma: float = 0.2
    start_m: float = 1.0
    hz: float = 1.6
    damping: float = 0.3
    stiffness_sigma: float = 0.6
    damping_sigma: float = 0.8
    gyration: float = 0.9
    gyration_sigma: float = 0.15
    known_m: float = 2e-3
    gain_doubt: float = 0.045
    turn_doubt: float = 1.0
    grade_together: float = 8.0
    grade_doubt: float = 0.016
