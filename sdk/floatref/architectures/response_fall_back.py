"""The road from the vehicle's response for where a height sensor dropped out."""

from floatref.architectures.fall_back import DropOut
from floatref.architectures.response_needs import FORCE
from floatref.values.profile import Profile

PIPELINE = "response-joint-input-state"


def road_from_response(asked: DropOut) -> Profile | None:
    """Return what `PIPELINE` makes of the recording; None if it has no wheel accelerometer.

    Raises InputError as the pipeline does, for a setup without a vehicle among others.
    """
    if not any(asked.recording.find(FORCE, track) for track in asked.gaps):
        return None
    return asked.process(PIPELINE, {"interval_m": asked.profile.interval_m})
