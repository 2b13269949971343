"""Units as files write them, and their factors to the SI units of our channels."""

from collections.abc import Mapping
from fractions import Fraction
from math import pi
from types import MappingProxyType
from typing import NamedTuple

from floatref.errors import InputError
from floatref.values.display.similar_names import did_you_mean

MPS = "m/s"
"""The SI unit of speed; a speed is integrated into a distance."""


class Unit(NamedTuple):
    """An SI unit, and how many of it the unit is."""

    si: str
    factor: float


G = Fraction("9.80665")
INCH = Fraction("0.0254")
MILE = 63360 * INCH
SIZES: Mapping[str, Mapping[str, Fraction | float | int]] = {
    "m": {
        "m metre meter metres meters": 1,
        "dm": Fraction(1, 10),
        "cm": Fraction(1, 100),
        "mm millimetre millimeter": Fraction(1, 1000),
        "um µm μm micrometer micron": Fraction(1, 10**6),
        "nm": Fraction(1, 10**9),
        "km kilometre kilometer": 1000,
        'in inch inches "': INCH,
        "mil thou": INCH / 1000,
        "ft foot feet '": 12 * INCH,
        "yd": 36 * INCH,
        "mi mile miles": MILE,
    },
    "m/s^2": {
        "m/s^2 m/s² m/s2 m/s/s m/s**2 m/sec^2 m/sec² m/sec2 ms^-2 ms-2 m.s^-2 m·s⁻²": 1,
        "mm/s^2 mm/s² mm/s2": Fraction(1, 1000),
        "cm/s^2 cm/s² cm/s2 gal": Fraction(1, 100),
        "g gn g_n g0 gee grav": G,
        "mg mgn milli-g": G / 1000,
        "ug µg μg": G / 10**6,
        "ft/s^2 ft/s² ft/s2": 12 * INCH,
        "in/s^2 in/s² in/s2": INCH,
    },
    "m/s": {
        "m/s mps ms^-1 m/sec": 1,
        "mm/s": Fraction(1, 1000),
        "cm/s": Fraction(1, 100),
        "km/h kmh km/hr kph kmph": Fraction(5, 18),
        "mph mi/h mi/hr": MILE / 3600,
        "kn kt kts knot knots": Fraction(1852, 3600),
        "ft/s fps": 12 * INCH,
    },
    "rad": {
        "rad radian radians": 1,
        "mrad": Fraction(1, 1000),
        "deg ° degree degrees °n °e": pi / 180,
        "arcmin": pi / 10800,
        "arcsec": pi / 648000,
    },
    "rad/s": {
        "rad/s rad/sec": 1,
        "mrad/s": Fraction(1, 1000),
        "deg/s °/s dps deg/sec degree/s degrees/s": pi / 180,
        "mdeg/s mdps": pi / 180000,
        "deg/h °/h deg/hr": pi / 648000,
        "rpm 1/min r/min": pi / 30,
    },
    "rad/s^2": {
        "rad/s^2 rad/s² rad/s2 rad/s/s rad/sec^2": 1,
        "mrad/s^2 mrad/s² mrad/s2": Fraction(1, 1000),
        "deg/s^2 deg/s² deg/s2 deg/s/s deg/sec^2 °/s^2 °/s² °/s2": pi / 180,
    },
    "1": {"1 - – none count counts cnt pulse pulses": 1, "%": Fraction(1, 100)},
}
"""Spellings by SI unit, each with how many SI units it is."""


def _table() -> Mapping[str, Unit]:
    found = {}
    for si, sizes in SIZES.items():
        for spellings, size in sizes.items():
            found.update({name: Unit(si, float(size)) for name in spellings.split()})
    return MappingProxyType(found)


UNITS = _table()
CASED = {"nm", "kn"}
"""Spellings that mean something else in capitals: newton metres, nautical miles, kilonewtons."""


def known_unit(text: str) -> Unit | None:
    """Return the unit that a file or a map writes as ``text``, None if it is not known.

    Case matters only for some spellings: `Mg` is a thousandth of g, but `Nm` is not a length.
    """
    plain = text.strip().strip("[]()").strip().replace(" ", "")
    small = plain.lower()
    return UNITS.get(plain) or (None if small in CASED else UNITS.get(small))


def unit_of(text: str) -> Unit:
    """Return the unit written as ``text``; InputError if it is not known."""
    unit = known_unit(text)
    if unit is not None:
        return unit
    hint = did_you_mean(text.strip(), UNITS)
    advice = f"{hint} state one" if hint else "state one"
    raise InputError(
        f"unit {text[:40]!r}: unknown; {advice} such as mm, g or km/h, and a scale to it"
    )
