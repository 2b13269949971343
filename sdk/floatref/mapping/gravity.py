"""Whether an accelerometer that stands upright tells gravity, and what to change in the map."""

from collections.abc import Mapping

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY

TOLERANCES: Mapping[str, float] = {
    "unsprung_specific_force": 5.0,
    "rear_unsprung_specific_force": 5.0,
    "sprung_specific_force": 2.0,
    "equipment_specific_force": 2.0,
}
"""How far the mean may be from g, in m/s²: a sensor for the 50 g of a wheel has a larger bias."""
MEANINGS = (
    (1.0, 0.5, "it looks like g, so state unit = 'g'"),
    (
        0.0,
        0.5,
        "1 g is missing, removed or never passed on by an AC-coupled sensor, so add it by "
        "offset = 9.80665, or offset = 1 where unit is 'g'",
    ),
    (-1.0, 0.5, "it looks like g, upside down, so state unit = 'g' and sign = -1"),
    (-STANDARD_GRAVITY, 5.0, "its axis points down, so state sign = -1"),
    (32.174, 5.0, "it looks like ft/s^2, so state unit = 'ft/s^2'"),
)
"""Mean that is none of an accelerometer at rest, how near it has to be, and what to do."""


def check_gravity(channel: str, mean: float) -> None:
    """Raise InputError if ``channel`` has to be about 9.8 m/s² and its ``mean`` is not.

    The mean over a drive is that at rest: what is left of the motion is the change of velocity
    over the time it took. NaN, the mean of no samples, passes.
    """
    if not abs(mean - STANDARD_GRAVITY) > TOLERANCES.get(channel, float("inf")):
        return
    likely = [said for level, near, said in MEANINGS if abs(mean - level) <= near]
    advice = likely[0] if likely else "check unit, axis and offset"
    raise InputError(f"mean is {mean:.4g}, expected about 9.8 m/s^2 of a specific force; {advice}")
