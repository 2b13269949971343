"""Units are what the standards define them to be, however they are written."""

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping.channel_map.units import UNITS, known_unit, unit_of
from floatref.values.channels import CHANNELS

# The international yard and pound agreement of 1959, the SI brochure, and ISO 80000-3.
YARD = Fraction(9144, 10_000)
DEFINED = {
    "yd": ("m", YARD),
    "ft": ("m", YARD / 3),
    "in": ("m", YARD / 36),
    "mil": ("m", YARD / 36_000),
    "mi": ("m", 1760 * YARD),
    "km": ("m", Fraction(10**3)),
    "m": ("m", Fraction(1)),
    "dm": ("m", Fraction(1, 10**1)),
    "cm": ("m", Fraction(1, 10**2)),
    "mm": ("m", Fraction(1, 10**3)),
    "um": ("m", Fraction(1, 10**6)),
    "nm": ("m", Fraction(1, 10**9)),
    "m/s^2": ("m/s^2", Fraction(1)),
    "mm/s^2": ("m/s^2", Fraction(1, 10**3)),
    "cm/s^2": ("m/s^2", Fraction(1, 10**2)),
    "gal": ("m/s^2", Fraction(1, 10**2)),
    "g": ("m/s^2", Fraction(980_665, 10**5)),
    "mg": ("m/s^2", Fraction(980_665, 10**8)),
    "ug": ("m/s^2", Fraction(980_665, 10**11)),
    "ft/s^2": ("m/s^2", YARD / 3),
    "in/s^2": ("m/s^2", YARD / 36),
    "m/s": ("m/s", Fraction(1)),
    "mm/s": ("m/s", Fraction(1, 10**3)),
    "cm/s": ("m/s", Fraction(1, 10**2)),
    "km/h": ("m/s", Fraction(1000, 3600)),
    "mph": ("m/s", 1760 * YARD / 3600),
    "kn": ("m/s", Fraction(1852, 3600)),
    "ft/s": ("m/s", YARD / 3),
    "rad": ("rad", Fraction(1)),
    "mrad": ("rad", Fraction(1, 1000)),
    "rad/s": ("rad/s", Fraction(1)),
    "mrad/s": ("rad/s", Fraction(1, 1000)),
    "rad/s^2": ("rad/s^2", Fraction(1)),
    "mrad/s^2": ("rad/s^2", Fraction(1, 1000)),
    "1": ("1", Fraction(1)),
    "%": ("1", Fraction(1, 100)),
}
TURNS = {
    "deg": ("rad", 360),
    "arcmin": ("rad", 360 * 60),
    "arcsec": ("rad", 360 * 3600),
    "deg/s": ("rad/s", 360),
    "mdeg/s": ("rad/s", 360_000),
    "deg/h": ("rad/s", 360 * 3600),
    "rpm": ("rad/s", 60),
    "deg/s^2": ("rad/s^2", 360),
}
"""Units by how many of them are a full turn, or a turn per second, once or in each second."""
SPELLINGS = {
    "m": ["metre", "meters", " [m] ", "(m)"],
    "mm": ["MM", "Mm", "[mm]", "millimeter"],
    "um": ["\u00b5m", "\u03bcm", "micron"],
    "in": ["inch", "inches", "IN", '"'],
    "ft": ["feet", "foot", "'"],
    "m/s^2": [
        "m/s\u00b2",
        "m/s2",
        "M/S2",
        "m / s^2",
        "m/s/s",
        "m/s**2",
        "m s^-2",
        "m\u00b7s\u207b\u00b2",
    ],
    "g": ["G", "gn", "[g]"],
    "mg": ["Mg", "milli-g"],
    "ug": ["\u00b5g", "\u03bcg"],
    "km/h": ["kmh", "KPH", "Km/h", "km/hr"],
    "mph": ["MPH", "mi/h"],
    "kn": ["knots", "kt"],
    "deg": ["\u00b0", "degrees", "DEG"],
    "deg/s": ["\u00b0/s", "dps", "deg/sec", "Deg/s"],
    "deg/s^2": ["\u00b0/s\u00b2", "deg/s2", "\u00b0/s^2", "Deg/sec^2"],
    "rad/s^2": ["rad/s\u00b2", "RAD/S2"],
    "1": ["-", "\u2013", "counts", "none"],
}


@pytest.mark.parametrize("name", DEFINED)
def test_a_unit_is_what_its_definition_says(name: str) -> None:
    si, size = DEFINED[name]
    assert unit_of(name) == (si, float(size))


@pytest.mark.parametrize("name", TURNS)
def test_angles_are_parts_of_a_turn(name: str) -> None:
    si, parts = TURNS[name]
    assert unit_of(name).si == si
    assert unit_of(name).factor * parts == pytest.approx(2 * math.pi, rel=1e-15)


@pytest.mark.parametrize("name", SPELLINGS)
def test_a_unit_may_be_written_in_several_ways(name: str) -> None:
    for spelling in SPELLINGS[name]:
        assert unit_of(spelling) == unit_of(name), spelling


def test_every_spelling_means_one_of_the_defined_units() -> None:
    defined = {unit_of(name) for name in {**DEFINED, **TURNS}}
    assert set(UNITS.values()) == defined


def test_every_channel_has_a_unit_that_is_known() -> None:
    for spec in CHANNELS.values():
        assert unit_of(spec.unit) == (spec.unit, 1.0)


@pytest.mark.parametrize(
    "text", ["Nm", "NM", "N m", "kN", "KN", "V", "bar", "\u00b0C", "s", "\u00b0S", "\u00b0W"]
)
def test_what_is_no_unit_of_a_channel_is_not_taken_for_one(text: str) -> None:
    assert known_unit(text) is None
    with pytest.raises(InputError, match="unknown; "):
        unit_of(text)


@pytest.mark.parametrize("text", ["", " ", "[]", "()"])
def test_nothing_is_no_unit(text: str) -> None:
    assert known_unit(text) is None


@pytest.mark.parametrize(
    ("text", "near"), [("mmm", "mm"), ("met", "metre"), ("m/s^3", "m/s^2"), ("degre", "deg")]
)
def test_an_unknown_unit_is_told_with_one_like_it(text: str, near: str) -> None:
    with pytest.raises(InputError, match=r"did you mean .*\? state one such as mm") as caught:
        unit_of(text)
    meant = str(caught.value).partition("did you mean ")[2].partition("?")[0]
    assert unit_of(meant).si == unit_of(near).si


@pytest.mark.slow
@settings(deadline=None, max_examples=200)
@given(st.text(max_size=300))
def test_any_text_is_a_unit_or_refused_in_one_line(text: str) -> None:
    if known_unit(text) is None:
        with pytest.raises(InputError) as caught:
            unit_of(text)
        assert str(caught.value).isprintable()
        assert len(str(caught.value)) < 300
    else:
        assert unit_of(text).factor > 0
