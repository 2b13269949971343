"""What a pipeline takes of a recording: wheel paths, the clock of its blocks, and channels."""

from dataclasses import dataclass

from floatref.values.recording import Channel, Recording

DISTANCE = "distance"
FORCE, HEIGHT = "vertical_specific_force", "height"
VERTICAL_FORCES = (
    FORCE,
    "unsprung_specific_force",
    "rear_unsprung_specific_force",
    "sprung_specific_force",
    "equipment_specific_force",
)
"""Accelerometers that measure 9.8 m/s² at rest."""


@dataclass(frozen=True)
class Needs:
    """Channels that a pipeline takes, beside the distance, of every wheel path.

    Attributes:
        tracks: the wheel paths, in order.
        force: the accelerometer whose clock is that of the blocks.
        others: names of further channels, of each wheel path or shared by all; what neither has
            is left out.
    """

    tracks: tuple[str, ...]
    force: str = FORCE
    others: tuple[str, ...] = (HEIGHT,)

    def channels(self, recording: Recording) -> tuple[Channel, ...]:
        """Return the channels in ``recording``, the distance first, each once.

        Raises InputError if an accelerometer that keeps time, or the distance, is missing.
        """
        found = [recording.channel(DISTANCE, self.tracks[0])]
        for track in self.tracks:
            found.append(recording.channel(self.force, track))
            others = (recording.find(name, track) for name in self.others)
            found += [channel for channel in others if channel is not None]
        return tuple({channel.id: channel for channel in found}.values())


def nominal_needs(recording: Recording) -> Needs:
    """Return accelerometer and height sensor of every wheel path that has a height."""
    return Needs(profiled_tracks(recording))


def profiled_tracks(recording: Recording) -> tuple[str, ...]:
    """Return the wheel paths that have a height, in order; InputError if there is none."""
    return tracks_with(recording, HEIGHT)


def tracks_with(recording: Recording, name: str) -> tuple[str, ...]:
    """Return the wheel paths that have a channel ``name``, in order; InputError if none has."""
    tracks = tuple(t for t in recording.tracks if recording.find(name, t) is not None)
    if not tracks:
        recording.channel(name)
    return tracks
