"""What a pipeline reads from a recording: wheel paths, the clock of its blocks, and channels."""

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
    """Channels that a pipeline reads for every wheel path, in addition to the distance.

    Attributes:
        tracks: the wheel paths, in order.
        force: the accelerometer whose clock is that of the blocks.
        others: names of further channels, of each wheel path or shared by all; a channel that is
            missing is omitted.
    """

    tracks: tuple[str, ...]
    force: str = FORCE
    others: tuple[str, ...] = (HEIGHT,)

    def channels(self, recording: Recording) -> tuple[Channel, ...]:
        """Return the channels in ``recording``, the distance first, each once.

        Raises InputError if the accelerometer that gives the clock, or the distance, is missing.
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
    """Return the wheel paths that have a height, in order; InputError if no path has one."""
    return tracks_with(recording, HEIGHT)


def tracks_with(recording: Recording, name: str) -> tuple[str, ...]:
    """Return the wheel paths that have channel ``name``, in order; InputError if no path has it."""
    tracks = tuple(t for t in recording.tracks if recording.find(name, t) is not None)
    if not tracks:
        recording.channel(name)
    return tracks
