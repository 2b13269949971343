"""`waveband` reads the error of gain or phase that a profile was given."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import hilbert
from tests.conformance.checks.benches import OneRecording, taken_of

import floatref
from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.distance.waveband import WavebandCheck, waves_of
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.roads.sines import WAVELENGTHS_M

GAIN, CUT_OFF, BEYOND, DISPLACEMENT, PHASE = WavebandCheck().limits


@pytest.fixture(scope="module")
def taken():
    return taken_of(WavebandCheck().simplest.scenario)


def filtered(taken, wavelength_m=91.44, change=lambda z: z, stretched=1.0):
    """Return the truth behind the profile's filter, changed, its axis stretched."""
    interval = taken.truth.interval_m
    tracks = tuple(
        ProfileTrack.of(t.name, change(high_pass(t.elevation, interval, wavelength_m)))
        for t in taken.truth.tracks
    )
    return Profile(stretched * interval, tracks)


def judged(taken, **spoiled):
    bench = OneRecording(taken, lambda t: filtered(t, **spoiled))
    return WavebandCheck().judge(WavebandCheck().simplest, bench)


def read(taken, **spoiled):
    """Return the largest of each quantity of both wheel paths."""
    measured = judged(taken, **spoiled)
    return {
        name: max(m.value for m in measured if m.quantity == name)
        for name in WavebandCheck().limits
    }


def failing(taken, device_class=DeviceClass.NOMINAL, **spoiled):
    return {m.quantity for m in judged(taken, **spoiled) if not m.within(device_class)}


def gain_at(wavelength_m, minus_3db_m):
    """Return the gain of two third-order Butterworth passes, -3 dB together (A.20)."""
    setting = minus_3db_m / (2**0.5 - 1) ** (1 / 6)
    return 1 / (1 + (wavelength_m / setting) ** 6)


@pytest.mark.slow
def test_the_truth_filtered_alike_keeps_every_limit_of_the_strictest_class(taken):
    assert failing(taken, DeviceClass.REFERENCE) == set()
    values = read(taken)
    assert values[BEYOND] == pytest.approx(gain_at(137.16, 91.44), abs=0.003)
    assert values[GAIN] == pytest.approx(100 * (1 - gain_at(42.9, 91.44)), abs=0.1)


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(percent=st.floats(1.5, 40.0))
def test_an_error_of_scale_is_read_as_one_of_gain(taken, percent):
    values = read(taken, change=lambda z: (1 + percent / 100) * z)
    assert values[GAIN] == pytest.approx(percent, rel=0.02, abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_a_cut_off_wrong_by_a_tenth_is_read_in_decibel_and_fails(taken, factor):
    expected = abs(20 * np.log10(gain_at(91.44, factor * 91.44) * 2**0.5))
    assert read(taken, wavelength_m=factor * 91.44)[CUT_OFF] == pytest.approx(expected, abs=0.05)
    assert CUT_OFF in failing(taken, wavelength_m=factor * 91.44)


def test_no_high_pass_at_all_fails_beyond_the_cut_off(taken):
    assert failing(taken, wavelength_m=2000.0) >= {CUT_OFF, BEYOND}


def test_a_shift_is_read_in_metres(taken):
    steps = 20
    values = read(taken, change=lambda z: np.roll(z, steps))
    assert values[DISPLACEMENT] == pytest.approx(steps * taken.truth.interval_m, abs=0.001)


@pytest.mark.parametrize("degrees", [1.3, 3.0])
def test_a_turn_of_all_waves_is_read_in_degrees(taken, degrees):
    turn = np.exp(1j * np.radians(degrees))
    values = read(taken, change=lambda z: (hilbert(z) * turn).real)
    assert values[PHASE] == pytest.approx(degrees, abs=0.3)


def test_a_flat_profile_and_a_smoothed_one_fail_by_gain(taken):
    assert read(taken, change=lambda z: 0.0 * z)[GAIN] == pytest.approx(100.0)
    window = round(0.25 / taken.truth.interval_m)
    lost = read(taken, change=lambda z: np.convolve(z, np.full(window, 1 / window), "same"))[GAIN]
    assert lost == pytest.approx(100 * (1 - np.sinc(0.25 / 0.6)), abs=1.0)


@pytest.mark.slow
def test_an_encoder_that_is_wrong_by_a_known_share_moves_no_wave():
    scenario = replace(WavebandCheck().simplest.scenario, encoder_error_percent=1.0)
    assert failing(taken_of(scenario), DeviceClass.REFERENCE, stretched=1.01) == set()


def test_points_without_elevation_matter_in_the_middle_alone(taken):
    def holed(at):
        x = taken.truth.distance_m
        return lambda z: np.where(np.abs(x - at) < 1.0, np.nan, z)

    assert failing(taken, change=holed(100.0)) == set()
    with pytest.raises(DeviceError, match="points without elevation from 163"):
        read(taken, change=holed(300.0))


def test_cases_follow_the_seed_and_survive_as_parameters():
    cases = WavebandCheck().cases(5, Effort.QUICK)
    assert cases == WavebandCheck().cases(5, Effort.QUICK)
    assert {c.scenario.seed for c in cases}.isdisjoint(
        c.scenario.seed for c in WavebandCheck().cases(6, Effort.QUICK)
    )
    assert [Case.of("waveband", c.parameters, c.name) for c in cases] == list(cases)


@pytest.mark.slow
def test_the_basic_pipeline_passes_its_first_case():
    case = WavebandCheck().cases(0, Effort.QUICK)[0]
    bench = OneRecording(
        taken_of(case.scenario), lambda t: floatref.process(t.recording, "temporal-basic")
    )
    assert all(m.ratio(DeviceClass.NOMINAL) <= 0.7 for m in WavebandCheck().judge(case, bench))


seeds = st.integers(0, 2**32 - 1)


@settings(deadline=None, max_examples=10)
@given(seed=seeds, level=st.floats(-1, 1), slope=st.floats(-0.05, 0.05))
def test_waves_beside_any_line_are_found(seed: int, level: float, slope: float) -> None:
    rng = np.random.default_rng(seed)
    x = np.sort(rng.uniform(100.0, 374.32, 4000))
    put_in = rng.normal(size=WAVELENGTHS_M.size) + 1j * rng.normal(size=WAVELENGTHS_M.size)
    z = level + slope * x
    for amplitude, wavelength in zip(put_in, WAVELENGTHS_M, strict=True):
        z = z + (amplitude * np.exp(2j * np.pi * x / wavelength)).real
    assert waves_of(x, z, WAVELENGTHS_M) == pytest.approx(put_in, abs=1e-8)
