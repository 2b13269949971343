"""A height that is late leaves the body's motion in long waves; a line beside leaves nothing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.certify.fitting.fit import fit

SPEED_MPS = 20.0
TYRE, SPRING, DAMPER, WHEEL = 653.0, 63.3, 6.0, 0.15
"""Of the quarter car of the IRI, over its body's mass."""
INTERVAL_M = 0.04


def body(frequency_hz):
    """Answer of the body of a quarter car to the road under it."""
    s = 2j * np.pi * frequency_hz
    link = SPRING + DAMPER * s
    return TYRE * link / ((s**2 + link) * (WHEEL * s**2 + link + TYRE) - link**2)


def through(run, changed, response):
    """Return ``run`` with every wave times ``response`` of its wave number in cycles per m."""

    def filtered(name, z):
        padded = np.pad(z, 3000, mode="reflect", reflect_type="odd")
        ramp = np.linspace(padded[0], padded[-1], padded.size)
        waves = np.fft.rfft(padded - ramp)
        waves *= response(np.fft.rfftfreq(padded.size, INTERVAL_M))
        return name, (np.fft.irfft(waves, padded.size) + ramp)[3000:-3000]

    return changed(run, filtered)


def late(tau_s):
    def response(wave_number):
        frequency = SPEED_MPS * wave_number
        return 1.0 + body(frequency) * np.expm1(2j * np.pi * frequency * tau_s)

    return response


def one_way(wave_number):
    """A high-pass of Butterworth, third order, at 91 m."""
    s = 1j * 91.0 * wave_number
    return s**3 / ((1.0 + s) * (1.0 + s + s**2))


@pytest.mark.parametrize("tau_s", [0.01, -0.01])
def test_a_skew_is_beyond_the_limit(road, changed, tau_s):
    found = fit(road.reference(), through(road.run(noise=0.05), changed, late(tau_s)), "left")
    waves = found.long_waves
    assert waves.error_percent - 2.0 * waves.error_sigma > 5.0
    assert 5.0 < waves.wave_m < 25.0


@settings(max_examples=4)
@given(seed=st.integers(0, 2**31), gain=st.floats(0.95, 1.05), noise=st.floats(0.0, 0.2))
def test_noise_and_a_scale_of_heights_leave_long_waves_alone(road, seed, gain, noise):
    found = fit(road.reference(), road.run(gain=gain, noise=noise, seed=seed), "left")
    waves = found.long_waves
    assert waves.error_percent - 4.0 * waves.error_sigma < 5.0


def test_a_high_pass_that_runs_one_way_does_not_count(road, changed):
    run = through(road.run(), changed, one_way)
    waves = fit(road.reference(), run, "left").long_waves
    assert waves.error_percent - 2.0 * waves.error_sigma < 5.0


def test_run_and_reference_exchanged_are_as_far_apart(road, changed):
    run, reference = through(road.run(0.0, 160.0), changed, late(0.01)), road.run(0.0, 160.0)
    there, back = fit(reference, run, "left").long_waves, fit(run, reference, "left").long_waves
    assert there.error_percent == pytest.approx(back.error_percent, rel=0.1)


def test_a_short_section_has_no_long_waves(road):
    found = fit(road.reference(length_m=70.0), road.run(0.0, 70.0), "left")
    assert found.found
    assert found.long_waves is None
    assert np.isnan(found.long_percent)
