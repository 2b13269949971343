"""The half car: where it rests, how it swings, and that it has no preferred end."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array
from tests.sdk.estimators.road_slope.plain_equations import Springs, by_name
from tests.sdk.estimators.road_slope.short_runs import RUNS, Run, draw

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.layout import GLOBALS, Layout
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.springs import HalfCar
from floatref.values.arrays import FloatArray

G, K = 9.80665, 9
SEEDS = st.integers(0, 2**32 - 1)
few = settings(deadline=None, max_examples=4)
some = settings(deadline=None, max_examples=15)


class Car(NamedTuple):
    """The springs and masses of a vehicle, by the names of the layout, and where its axles are."""

    places: Places
    gain: float
    centre: float
    log_front: float
    log_rear: float
    log_front_damping: float
    log_rear_damping: float
    log_gyration: float


CARS = st.builds(
    Car,
    st.builds(
        lambda front, base, lever: Places(front, front - base, lever),
        st.floats(-2.0, 2.0),
        st.floats(2.0, 4.0),
        st.floats(-1.5, 1.5),
    ),
    gain=st.floats(0.0005, 0.02),
    centre=st.floats(-0.1, 1.1),
    log_front=st.floats(2.0, 5.0),
    log_rear=st.floats(2.0, 5.0),
    log_front_damping=st.floats(-2.0, 3.0),
    log_rear_damping=st.floats(-2.0, 3.0),
    log_gyration=st.floats(-0.9, 0.4),
)


def moving(along: float, step: float = 0.06, nodes: int = K) -> Readings:
    """Return nodes at 5 m/s and more with a constant acceleration."""
    t, full, zero = step * np.arange(float(nodes)), np.ones(nodes), np.zeros(nodes)
    faster = along * t - min(0.0, along * t[-1])
    place = (5.0 + faster[0]) * t + along / 2 * t**2
    return Readings(t, zero, zero, place, 5.0 + faster, along * full, zero, step * full, step)


def on_road(
    car: Car, seen: Readings, under: tuple[FloatArray, FloatArray]
) -> tuple[HalfCar, FloatArray]:
    """Return the half car over elevations ``under`` its axles at all nodes, with its constants.

    The road is a point for each node under each axle.
    """
    nodes = seen.place.size
    layout, eye = Layout(2 * nodes, nodes), np.eye(2 * nodes)
    wheels = csr_array(eye[:nodes]), csr_array(eye[nodes:])
    y = np.zeros(layout.size)
    y[layout.elevation] = np.concatenate(under)
    for name in car._fields[1:]:
        y[layout.place(name)] = getattr(car, name)
    return HalfCar(seen, car.places, layout, wheels), y


def set_body(layout: Layout, y: FloatArray, r: FloatArray, theta: FloatArray) -> None:
    y[layout.height], y[layout.pitch] = r, theta


def axles_m(car: Car) -> tuple[float, float]:
    """Return front and rear axle ahead of the accelerometer."""
    return car.places.lever_m + car.places.front_m, car.places.lever_m + car.places.rear_m


@some
@given(
    car=CARS,
    where=st.sampled_from(["grade", "brake"]),
    size=st.floats(-1.0, 1.0),
    moment=st.floats(-0.5, 0.5),
    offset=st.floats(-1.0, 1.0),
)
def test_at_rest_it_pitches_with_the_road_and_by_the_force_along_it(
    car: Car, where: str, size: float, moment: float, offset: float
) -> None:
    """On a grade at one speed, or in a steady brake on the level: θ is β + κ(a + gβ + μ)."""
    grade, along = (0.1 * size, 0.0) if where == "grade" else (0.0, 4.0 * size)
    seen, (front_m, rear_m) = moving(along), axles_m(car)
    ends = (car.places.front_m, car.places.rear_m)
    half, y = on_road(car, seen, tuple(grade * (seen.place + end) for end in ends))
    pitch = grade + car.gain * (along + G * grade + moment)
    # The weight is shared as the springs are stiff, wherever the centre of gravity is.
    stiff = np.exp([car.log_front, car.log_rear])
    share = stiff[0] / stiff.sum()
    levers = share * (ends[0] * grade - front_m * pitch)
    levers += (1 - share) * (ends[1] * grade - rear_m * pitch)
    r = grade * seen.place + levers + offset
    set_body(half.layout, y, r, np.full(K, pitch))
    y[half.layout.in_time("moment")], y[half.layout.in_time("offset")] = moment, offset
    for value in (half.bounce(y)[1], half.pitch(y, G)[1]):
        assert value.shape == (K - 2,)
        np.testing.assert_allclose(value, 0.0, atol=1e-9)
    set_body(half.layout, y, r, np.full(K, pitch + 1e-3))
    assert np.abs([half.bounce(y)[1], half.pitch(y, G)[1]]).max() > 1e-4


@few
@given(run=RUNS, seed=SEEDS)
def test_rows_are_those_of_plain_sums(run: Run, seed: int) -> None:
    case, rng = draw(run), np.random.default_rng(seed)
    y = case.truth + 1e-3 * rng.normal(size=case.truth.size)
    x, half = by_name(case.ours, y), case.ours.car
    expected = Springs(case.ours, x).values(x["height"], x["pitch"], case.ours.readings.middles)
    found = half.bounce(y)[1], half.pitch(y, case.ours.model.gravity)[1]
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@few
@given(run=RUNS, seed=SEEDS)
def test_derivatives_are_central_differences(run: Run, seed: int) -> None:
    """By each of the constants of the vehicle, and in a direction in which all else changes."""
    case, rng = draw(run), np.random.default_rng(seed)
    half, size, step = case.ours.car, case.ours.layout.size, 1e-4
    y = case.truth + 1e-3 * rng.normal(size=size)
    # A pitch of about 1 rad moves all values as much as the constants do.
    y[case.ours.layout.pitch] += 0.1 * rng.normal(size=case.ours.layout.nodes)
    places = [case.ours.layout.place(name) for name in GLOBALS]
    ways = [np.eye(size)[place] for place in places]
    rest = rng.normal(size=size)
    rest[places] = 0.0
    for of in (half.bounce, lambda at: half.pitch(at, G)):
        derivative, _ = of(y)
        scale = abs(derivative) @ np.ones(size)
        for way in (*ways, rest):
            change = (of(y + step * way)[1] - of(y - step * way)[1]) / (2 * step)
            np.testing.assert_allclose(derivative @ way / scale, change / scale, atol=1e-7)


@some
@given(hz=st.floats(0.8, 2.5), damping=st.floats(0.05, 0.7), gyration=st.floats(0.6, 1.3))
def test_a_body_of_even_springs_pitches_at_the_natural_frequency_of_the_settings(
    hz: float, damping: float, gyration: float
) -> None:
    """A dying oscillation of that frequency and damping leaves nothing, of any other it does."""
    model = SlopeModel(hz=hz, damping=damping, gyration=gyration)
    means, places = {"centre": 0.5} | model.means, Places(-0.8, -3.5, 0.6)
    car = Car(places, *(means[name] for name in Car._fields[1:]))
    seen, omega = moving(0.0, 0.005, 60), 2 * np.pi * hz
    half, y = on_road(car, seen, (np.zeros(60), np.zeros(60)))
    off = []
    for faster in (1.0, 1.3):
        dying = faster * omega * (-damping + 1j * np.sqrt(1 - damping**2)) * seen.bins
        theta = 0.01 * np.exp(dying).real
        set_body(half.layout, y, -0.5 * sum(axles_m(car)) * theta, theta)
        assert np.abs(half.bounce(y)[1]).max() < 1e-9
        off.append(float(np.abs(half.pitch(y, G)[1]).max()) / (0.01 * omega**2))
    assert off[0] < 5e-3
    assert off[1] > 0.1


@some
@given(stiffness=st.floats(2.5, 5.0), damping=st.floats(-1.0, 2.0), lever=st.floats(-1.0, 1.0))
def test_a_body_of_even_springs_bounces_without_a_pitch(
    stiffness: float, damping: float, lever: float
) -> None:
    """Its two springs are in parallel."""
    places = Places(-0.8, -3.5, lever)
    car = Car(places, 0.005, 0.5, stiffness, stiffness, damping, damping, -0.1)
    seen = moving(0.0, 0.002, 60)
    half, y = on_road(car, seen, (np.zeros(60), np.zeros(60)))
    omega2, twice = 2 * np.exp(stiffness), 2 * np.exp(damping)
    root = (-twice + np.sqrt(complex(twice**2 - 4 * omega2))) / 2
    set_body(half.layout, y, 0.01 * np.exp(root * seen.bins).real, np.zeros(60))
    assert np.abs(half.bounce(y)[1]).max() < 5e-3 * 0.01 * (omega2 + abs(twice * root))
    assert np.abs(half.pitch(y, G)[1]).max() < 1e-9


def mirrored(name: str) -> tuple[str, float]:
    """Return what an unknown is called, and its sign, for whoever looks backward."""
    swapped = {"front": "rear", "rear": "front"}
    other = "_".join(swapped.get(part, part) for part in name.split("_"))
    return other, -1.0 if name in {"pitch", "nod", "moment"} else 1.0


@some
@given(car=CARS, seed=SEEDS)
def test_looked_at_from_the_other_side_it_is_the_same_vehicle(car: Car, seed: int) -> None:
    """Front is rear, nose up is nose down, and it brakes where it sped up."""
    rng, seen = np.random.default_rng(seed), moving(-2.0)
    seen = replace(seen, along=rng.normal(size=K), speed=np.abs(rng.normal(size=K)))
    under = tuple(rng.normal(size=(2, K)))
    half, y = on_road(car, seen, under)
    back = replace(seen, along=-seen.along, place=-seen.place)
    places = Places(-car.places.rear_m, -car.places.front_m, -car.places.lever_m)
    springs = {mirrored(name)[0]: getattr(car, name) for name in car._fields[3:]}
    other = Car(places, car.gain, 1 - car.centre, **springs)
    turned, z = on_road(other, back, under[::-1])
    for name in ("height", "pitch", "heave", "nod", "offset", "moment"):
        drawn = rng.normal(size=K)
        y[half.layout.in_time(name)] = drawn
        z[half.layout.in_time(name)] = mirrored(name)[1] * drawn
    size = np.abs(half.bounce(y)[1]).max(), np.abs(half.pitch(y, G)[1]).max()
    bounce, pitch = half.bounce(y)[1], half.pitch(y, G)[1]
    np.testing.assert_allclose(turned.bounce(z)[1] / size[0], bounce / size[0], atol=1e-9)
    np.testing.assert_allclose(turned.pitch(z, G)[1] / size[1], -pitch / size[1], atol=1e-9)


@some
@given(car=CARS, seed=SEEDS, by_m=st.floats(-5.0, 5.0), rise=st.floats(-1.0, 1.0))
def test_levels_and_what_the_springs_do_not_follow_are_no_forces(
    car: Car, seed: int, by_m: float, rise: float
) -> None:
    """A higher road and body, a body mounted higher, and heave and nod that change evenly."""
    rng, seen = np.random.default_rng(seed), moving(1.0)
    half, y = on_road(car, seen, tuple(0.1 * rng.normal(size=(2, K))))
    set_body(half.layout, y, *(0.1 * rng.normal(size=(2, K))))
    lay, even = half.layout, rise * seen.bins
    expected = half.bounce(y)[1], half.pitch(y, G)[1]
    changes = (
        ((lay.height, by_m), (lay.elevation, by_m)),
        ((lay.height, by_m), (lay.in_time("offset"), by_m)),
        ((lay.in_time("heave"), even), (lay.in_time("nod"), even)),
    )
    for change in changes:
        other = y.copy()
        for where, by in change:
            other[where] += by
        found = half.bounce(other)[1], half.pitch(other, G)[1]
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-7)


def test_it_has_no_rows_across_a_cut() -> None:
    seen = moving(0.0)
    pause = np.where(np.arange(K) == 4, 7.0, seen.pause_s)
    half, y = on_road(
        Car(Places(1.0, -2.0, 0.0), 0.005, 0.5, 3.0, 3.0, 1.0, 1.0, 0.0),
        replace(seen, pause_s=pause),
        (np.zeros(K), np.zeros(K)),
    )
    derivative, value = half.bounce(y)
    assert value.size == K - 4
    columns = derivative[:, half.layout.height].toarray() != 0
    assert not (columns[:, 3] & columns[:, 4]).any()
    assert columns.any(axis=0).all()
