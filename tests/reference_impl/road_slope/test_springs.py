"""The half car at rest, in motion by Newton's law, and how it swings."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.springs import (
    bounce_rows,
    half_car,
    moment_per_force,
    pitch_rows,
)
from floatref_reference.road_slope.symbols import Places, Readings, Stretch
from floatref_reference.road_slope.unknowns import Unknowns, by_name, start
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval_s=0.1, spacing_m=1.0)
K = 12
T = 0.1 * np.arange(K)
AT = Places(-0.7, -3.4, 1.1)
L, D_F, D_R = 2.7, 0.4, -2.3
Stopping = Callable[..., Stretch]
BODIES = st.fixed_dictionaries(
    {
        "gain": st.floats(0.0005, 0.02),
        "centre": st.floats(-0.1, 1.1),
        "log_front": st.floats(2, 5),
        "log_rear": st.floats(2, 5),
        "log_front_damping": st.floats(-2, 3),
        "log_rear_damping": st.floats(-2, 3),
        "log_gyration": st.floats(-0.9, 0.4),
    }
)


def driving(speed: float, a: float, c: Constants = C) -> Stretch:
    """Return a stretch at an even acceleration; nothing is read."""
    t, zero = c.interval_s * np.arange(K), np.zeros(K)
    place, pause = speed * t + a / 2 * t**2, np.full(K, c.interval_s)
    return Stretch(Readings(zero, zero, place, speed + a * t, zero + a, zero, pause), AT, c)


def body(stretch: Stretch, constants: dict[str, Any], **parts: Any) -> Unknowns:
    x = by_name(start(stretch), road_points(stretch).number, K)
    return x._replace(**{name: np.asarray(c) for name, c in constants.items()}, **parts)


def grade(stretch: Stretch, slope: float) -> np.ndarray:
    points = road_points(stretch)
    return 0.3 + slope * (points.first + points.spacing * np.arange(points.number))


@settings(deadline=None, max_examples=25)
@given(
    constants=BODIES,
    slope=st.floats(-0.1, 0.1),
    a=st.floats(-3, 3),
    moment=st.floats(-0.2, 0.2),
    offset=st.floats(-1, 1),
)
def test_braking_evenly_on_a_grade(
    constants: dict[str, Any], slope: float, a: float, moment: float, offset: float
) -> None:
    """The pitch is β + κ (a + g β + μ), and what lifts the body by a β leans it by its springs."""
    stretch, H = driving(5.0, a), constants["centre"]
    front, rear = np.exp(constants["log_front"]), np.exp(constants["log_rear"])
    over = constants["gain"] * (a + C.gravity * slope + moment)
    lifted_front, lifted_rear = (1 - H) * slope * a / front, H * slope * a / rear
    theta = slope + over - (lifted_front - lifted_rear) / L
    pushed = lifted_front - over * L * rear / (front + rear)
    r = 0.3 + slope * (stretch.readings.place + AT.front) + offset - pushed - D_F * theta
    x = body(stretch, constants, elevation=grade(stretch, slope), height=r, offset=offset + 0 * T)
    x = x._replace(pitch=theta + 0 * T, moment=moment + 0 * T)
    assert bounce_rows(x, stretch) == pytest.approx(np.zeros(K - 2), abs=1e-6)
    assert pitch_rows(x, stretch) == pytest.approx(np.zeros(K - 2), abs=1e-6)


def newton(x: Unknowns, constants: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return forces and turning moments that are over, by heights of the body over the axles."""

    def mean(y: np.ndarray) -> np.ndarray:
        return np.convolve(y, [1, 10, 1], "valid") / 12

    def push(delta: np.ndarray, name: str) -> np.ndarray:
        K_i, C_i = np.exp(constants[f"log_{name}"]), np.exp(constants[f"log_{name}_damping"])
        return K_i * mean(delta) + C_i * (delta[2:] - delta[:-2]) / 0.2

    front, rear = x.height + D_F * x.pitch, x.height + D_R * x.pitch
    H, rho = constants["centre"], np.exp(constants["log_gyration"]) * L / 2
    phi_f, phi_r = push(x.offset - front, "front"), push(x.offset - rear, "rear")
    lifted = np.diff((1 - H) * front + H * rear - x.heave, 2) / 0.01
    turned = np.diff(x.pitch - x.nod, 2) / 0.01
    both = 1 / np.exp(constants["log_front"]) + 1 / np.exp(constants["log_rear"])
    by_force = constants["gain"] * L**2 / both * (-1 + mean(x.moment))
    torque = phi_f * H * L - phi_r * (1 - H) * L + by_force
    return lifted - phi_f - phi_r, turned - torque / rho**2


@settings(deadline=None, max_examples=25)
@given(constants=BODIES, seed=st.integers(0, 999), loose=st.floats(1, 30))
def test_any_motion_by_newtons_law(constants: dict[str, Any], seed: int, loose: float) -> None:
    """On a flat road, braking by 1 m/s²; over 1-σ at speeds without jolts."""
    rng, stretch = np.random.default_rng(seed), driving(3.0, -1.0)
    names = ("height", "pitch", "offset", "heave", "nod", "moment")
    x = body(stretch, constants, **{name: rng.normal(size=K) for name in names})
    bounce, pitch = newton(x, constants)
    sigma = loose * (1e-3 + 4e-4 * stretch.readings.speed[1:-1]) / np.sqrt(0.1)
    assert bounce_rows(x, stretch, loose) == pytest.approx(bounce / sigma, rel=1e-6, abs=1e-3)
    assert pitch_rows(x, stretch, loose) == pytest.approx(pitch / sigma, rel=1e-6, abs=1e-3)


@given(hz=st.floats(1, 2.5), damping=st.floats(0.05, 0.5), gyration=st.floats(0.5, 1.5))
@settings(deadline=None, max_examples=25)
def test_a_body_of_even_springs_swings_as_the_settings_say(
    hz: float, damping: float, gyration: float
) -> None:
    """About its centre of gravity, within two thousandths of ω² at Δ = 10 ms."""
    c = C._replace(interval_s=0.01, hz=hz, damping=damping, gyration=gyration)
    stretch, omega, t = driving(0.0, 0.0, c), 2 * np.pi * hz, 0.01 * np.arange(K)
    swing = np.exp(-damping * omega * t) * np.cos(omega * np.sqrt(1 - damping**2) * t)
    x = body(stretch, {}, pitch=swing, height=-(D_F - L / 2) * swing)
    sigma = 1e-3 / np.sqrt(0.01)
    assert np.abs(pitch_rows(x, stretch)).max() * sigma < 2e-3 * omega**2
    assert np.abs(bounce_rows(x, stretch)).max() * sigma < 1e-9 * omega**2
    slower = x._replace(pitch=swing[::-1])
    assert np.abs(pitch_rows(slower, stretch)).max() * sigma > 2e-3 * omega**2


def test_jolts_loosen_both(stopping: Stopping) -> None:
    """The brake ends at node 20; V is 0.4 m/s at node 18, and 0 at node 22."""
    stretch, V = stopping(C), {5: 3.0, 18: 0.4, 22: 0.0}
    x = by_name(start(stretch), road_points(stretch).number, 30)
    for k, jolt in ((5, 0), (18, 2), (22, 2)):
        unit = np.eye(30)[k]
        heave = np.subtract(bounce_rows(x._replace(heave=unit), stretch), bounce_rows(x, stretch))
        nod = np.subtract(pitch_rows(x._replace(nod=unit), stretch), pitch_rows(x, stretch))
        density = (1e-3 + 4e-4 * V[k]) ** 2 / 0.1
        assert heave[k - 1] == pytest.approx(200 / np.sqrt(density + (0.003 * jolt) ** 2))
        assert nod[k - 1] == pytest.approx(200 / np.sqrt(density + (0.015 * jolt) ** 2))


def test_a_cut_leaves_out_rows(stopping: Stopping) -> None:
    stretch = stopping(C, cut=25)
    x = by_name(start(stretch), road_points(stretch).number, 30)
    assert len(bounce_rows(x, stretch)) == len(pitch_rows(x, stretch)) == 26


@given(constants=BODIES)
def test_the_moment_is_the_one_that_even_pitch_needs(constants: dict[str, Any]) -> None:
    """Springs that are pressed by δ and -δ times the other's stiffness turn it by M."""
    x = body(driving(1.0, 0.0), constants)
    by = half_car(x, AT)
    push = constants["gain"] * L * by.front * by.rear / (by.front + by.rear)
    turned = push * (by.to_front + by.to_rear) / by.radius**2
    assert moment_per_force(x, AT) == pytest.approx(turned)
