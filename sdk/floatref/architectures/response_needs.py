"""What the response architecture takes of a recording: what is measured of its vehicle's model."""

from dataclasses import dataclass

from floatref.architectures.response_plausible import check_sink
from floatref.errors import InputError
from floatref.response import VehicleModel, model_of
from floatref.values.block import Header
from floatref.values.channels import ChannelId
from floatref.values.needs import Needs, tracks_with
from floatref.values.recording import Recording, Setup

FORCE = "unsprung_specific_force"
"""The accelerometer whose clock is that of the blocks."""
DEFLECTION = "suspension_deflection"
EXAMPLE = (
    '"vehicle": {"model": "quarter-car", "x_m": 0, "parameters": {"sprung_kg": ..., '
    '"unsprung_kg": ..., "suspension_n_per_m": ..., "suspension_ns_per_m": ..., '
    '"tyre_n_per_m": ...}}'
)


@dataclass(frozen=True)
class Motion:
    """What is measured of the freedoms of one ``quantity``: how their channels are called.

    ``acceleration``, ``velocity`` and ``displacement`` tell whether there is such a channel.
    """

    quantity: str
    angular: bool
    acceleration: bool = False
    velocity: bool = False
    displacement: bool = False

    @property
    def force_name(self) -> str:
        """The recording's channel of its acceleration: a specific force if it is a height."""
        return self.acceleration_name if self.angular else f"{self.quantity}_specific_force"

    @property
    def acceleration_name(self) -> str:
        """The signal of its acceleration, 1 g removed."""
        return f"{self.quantity}_acceleration"

    @property
    def velocity_name(self) -> str:
        """The channel of its velocity."""
        return f"{self.quantity}_{'rate' if self.angular else 'velocity'}"

    @property
    def integral_name(self) -> str:
        """The signal of a velocity that is integrated from its acceleration."""
        return f"{self.quantity}_integral"

    @property
    def displacement_name(self) -> str:
        """The channel, or the signal, of its displacement."""
        return f"{self.quantity}_{'angle' if self.angular else 'displacement'}"

    @property
    def integrated_twice(self) -> bool:
        """Whether its displacement comes from its acceleration."""
        return self.acceleration and not self.velocity and not self.displacement

    @property
    def integrated_once(self) -> bool:
        """Whether its displacement comes from its velocity."""
        return self.velocity and not self.displacement

    @property
    def placed(self) -> bool:
        """Whether there is a displacement, measured or made."""
        return self.acceleration or self.velocity or self.displacement


def vehicle_model(setup: Setup) -> VehicleModel:
    """Return the model of the vehicle; InputError if the setup names none, or as `model_of`."""
    if setup.vehicle is None:
        raise InputError(
            "setup.vehicle: missing, and without a height sensor the road is what the vehicle's "
            f"response tells through its model; add {EXAMPLE} to the setup in recording.json"
        )
    return model_of(setup.vehicle)


def response_needs(recording: Recording) -> Needs:
    """Return the channels that tell the freedoms of the vehicle's model, of its wheel paths.

    InputError as `vehicle_model` and `check_sink`, or if no wheel path has an
    `unsprung_specific_force`.
    """
    model = vehicle_model(recording.setup)
    check_sink(model)
    named = tuple(dict.fromkeys(tyre.track for tyre in model.tyres if tyre.track))
    others = {
        name
        for motion in _motions(model)
        for name in (motion.force_name, motion.velocity_name, motion.displacement_name)
    }
    if has_deflection(model):
        others.add(DEFLECTION)
    return Needs(named or tracks_with(recording, FORCE), FORCE, tuple(sorted(others - {FORCE})))


def motions(header: Header, model: VehicleModel) -> tuple[Motion, ...]:
    """Return what the raw stream measures of the freedoms of ``model``, of every wheel path."""
    return tuple(
        Motion(
            motion.quantity,
            motion.angular,
            is_there(header, motion.force_name),
            is_there(header, motion.velocity_name),
            is_there(header, motion.displacement_name),
        )
        for motion in _motions(model)
    )


def has_deflection(model: VehicleModel) -> bool:
    """Return whether ``model`` is of one wheel, so that a deflection is body minus wheel."""
    return [freedom.quantity for freedom in model.freedoms] == ["sprung", "unsprung"]


def is_there(header: Header, name: str) -> bool:
    """Return whether every wheel path has channel ``name``."""
    return all(ChannelId(name, track) in header.channels for track in header.tracks)


def _motions(model: VehicleModel) -> tuple[Motion, ...]:
    quantities = dict.fromkeys((f.quantity, f.angular) for f in model.freedoms)
    return tuple(Motion(quantity, angular) for quantity, angular in quantities)
