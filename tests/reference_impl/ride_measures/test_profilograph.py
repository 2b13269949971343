"""The reference's profilograph, wavebands and sections, by closed forms."""

import numpy as np
import pytest

from floatref_reference.ride_measures.bands import continued, waveband_energy
from floatref_reference.ride_measures.profilograph import (
    height_above_base,
    must_grind,
    profile_index,
    scallops,
    trace,
)
from floatref_reference.ride_measures.sections import rating, sections
from floatref_reference.signals import samples

INCH = 0.0254


def test_the_trace_of_a_sine_without_low_pass() -> None:
    interval, k = 0.0762, 2 * np.pi / 10
    z = np.sin(k * interval * np.arange(400))
    first, t = trace(z, interval, footprint=0.0)
    assert first == 50
    expected = z[50:-50] * (1 - np.cos(k * 3.81))
    assert np.array(t, dtype=float) == pytest.approx(expected, abs=1e-12)


def test_scallops_and_index_of_a_worked_example() -> None:
    """0.27 and 0.13 in beyond the band, above and below it, are 0.8 in: 8 in/mi of 0.1 mile."""
    t = np.zeros(2112)
    for place, count, height in ((100, 20, 0.37), (300, 30, 0.23)):
        t[place : place + count], t[1000 + place : 1000 + place + count] = height, -height
    found = scallops(samples(INCH * t), 0.0762)
    assert [float(h) for h in found] == pytest.approx([0.25 * INCH, 0.15 * INCH] * 2)
    assert float(profile_index(samples(INCH * t), 0.0762)) * 63.36 == pytest.approx(8.0)


def test_the_height_is_above_the_higher_side_within_the_template() -> None:
    t = samples([0, 5, 0, 3, 3, 3, 3, 3])
    assert height_above_base(t, 1, 2) == 5
    assert height_above_base(t, 3, 4) == 0
    assert height_above_base(samples([0, 5, 2]), 1, 2) == 3
    assert height_above_base(samples([0, 5, 5, 5, 0]), 2, 3) == 0


def test_one_bump_must_be_ground() -> None:
    t = np.zeros(300)
    t[100:110] = 0.01
    (place,) = must_grind(samples(t), 0.0762)
    assert (place.start, place.end) == (100 * 0.0762, 109 * 0.0762)


def test_a_profile_is_continued_by_its_reflection() -> None:
    found = [float(value) for value in continued([1.0, 4.0, 3.0, 4.0], 4)]
    # The line 1, 2, 3, 4 leaves 0, 2, 0, 0.
    assert found == pytest.approx([0, 0, 0, -2, 0, 2, 0, 0, 0, -2, 0, 2], abs=1e-15)


def test_a_wave_in_the_band_keeps_its_size_and_a_line_has_none() -> None:
    interval, wavelength = 0.1, 4.0
    z = np.sin(2 * np.pi * interval * np.arange(401) / wavelength)
    found = waveband_energy(z, interval, 40.0, 0.5)
    assert float(found.elevation) == pytest.approx(1 / np.sqrt(2), rel=5e-3)
    assert float(found.slope) == pytest.approx(2 * np.pi / wavelength / np.sqrt(2), rel=1e-2)
    assert waveband_energy(np.arange(300.0), interval, 8.0, 1.6).elevation < 1e-12


def test_ratings_and_sections() -> None:
    limits = [rating(value / 63.36) for value in (94.9, 95.1, 169.9, 170.1)]
    assert limits == ["good", "fair", "fair", "poor"]
    (first, last) = sections([np.zeros(1000), np.zeros(1000)], 0.25)
    assert (first.length, first.rating) == (161.0, "good")
    assert first.length + last.length == 999 * 0.25
