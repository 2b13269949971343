"""What a drafted map says beside its entries: signs, second meanings, the vehicle to be stated."""

from collections.abc import Iterable, Iterator

from floatref.mapping.guesses import Guess

SIGNS = {
    "vertical_specific_force": "+9.8 at rest",
    "height": "range down to the road, positive",
    "gnss_pitch": "nose down positive: sign = -1 if the receiver reports nose up",
    "gnss_roll": "left side up positive",
    "pitch_rate": "right-handed about +Y (left): nose down positive",
    "yaw_rate": "right-handed about +Z (up): left turn positive",
    "roll_rate": "right-handed about +X (forward): left side up positive",
    "unsprung_specific_force": "+9.8 at rest",
    "rear_unsprung_specific_force": "+9.8 at rest",
    "sprung_specific_force": "+9.8 at rest",
    "equipment_specific_force": "+9.8 at rest",
    "suspension_deflection": "against rest, positive where the wheel hangs lower",
    "rear_suspension_deflection": "against rest, positive where the wheel hangs lower",
    "pitch_angle": "against rest, nose down positive",
    "roll_angle": "against rest, left side up positive",
}
"""What is easily the other way round."""
EITHER = {"height": "; to the axle it is suspension_deflection"}
"""What a channel that is not sure may be instead."""
NOSE_DOWN = ("gnss_pitch", "pitch_rate", "pitch_angle", "pitch_acceleration")
"""What is the other way round where an adapter's note says so."""
VEHICLE = """
# [setup.vehicle]  # for an estimate of the road from the response
# model = "quarter-car"  # the corner that is measured
# x_m = 0.0  # its wheel ahead of the one point of the vehicle
# parameters.sprung_kg = 0
# parameters.unsprung_kg = 0
# parameters.suspension_n_per_m = 0
# parameters.suspension_ns_per_m = 0
# parameters.tyre_n_per_m = 0"""
"""The table that a map has where wheels are measured, to be completed."""


def remark(found: Guess) -> str:
    """Return the comment behind the channel of an entry, "" for none."""
    either = "" if found.sure else EITHER.get(found.channel, "")
    return f"  # {SIGNS[found.channel]}{either}" if found.channel in SIGNS else ""


def turned(found: Guess, note: str) -> bool:
    """Tell whether the ``note`` of an adapter says that ``found`` is the other way round."""
    return found.channel in NOSE_DOWN and "nose up positive" in note


def vehicle(found: Iterable[Guess | None]) -> Iterator[str]:
    """Yield the table of the vehicle if an accelerometer of a wheel is among ``found``."""
    if any(g is not None and g.channel.endswith("unsprung_specific_force") for g in found):
        yield VEHICLE
