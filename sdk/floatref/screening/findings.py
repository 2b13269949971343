"""The screening of a recording before it is processed: computed once for all users."""

from dataclasses import dataclass, field, replace
from functools import cache, cached_property

from floatref.errors import InputError
from floatref.screening.gnss_height import gnss_faults
from floatref.screening.imu_and_gnss import ImuUse, check_kinematics
from floatref.screening.plausibility import Examine, examine, examine_channel
from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.weighing import weigh_recording
from floatref.screening.travel import Travel
from floatref.values.arrays import IndexArray
from floatref.values.needs import Needs, nominal_needs
from floatref.values.recording import Recording


@dataclass(frozen=True, eq=False)
class Facts:
    """Facts about a recording that hold for every pipeline; each is computed when first read."""

    recording: Recording

    @cached_property
    def gnss_faults(self) -> IndexArray:
        """Stuck readings of gnss_height: first index and the one behind, shape (k, 2)."""
        return gnss_faults(self.recording)

    @cached_property
    def travel(self) -> Travel:
        """The travel speed along the run."""
        return Travel.of(self.recording)

    @cached_property
    def doubts(self) -> tuple[Doubt, ...]:
        """Faults that sensors of the same motion show, of whatever channel."""
        return weigh_recording(self.recording)

    @cached_property
    def examined(self) -> Examine:
        """A function that examines a channel, each once."""
        return cache(examine_channel)


@dataclass(frozen=True, eq=False)
class Screening:
    """The screening of a recording for one pipeline.

    Attributes:
        recording: the recording.
        needs: the channels that the pipeline reads.
        imu: its use of IMU and GNSS; None if it uses neither.
        facts: facts that do not depend on the pipeline.
    """

    recording: Recording
    needs: Needs
    imu: ImuUse | None
    facts: Facts = field(repr=False)

    @classmethod
    def of(
        cls,
        recording: Recording,
        needs: Needs | None = None,
        imu: ImuUse | None = None,
        known: "Screening | None" = None,
    ) -> "Screening":
        """Return the screening for a pipeline; without ``needs``, it reads the nominal channels.

        Results of ``known`` for the same channels are reused.
        """
        needs = nominal_needs(recording) if needs is None else needs
        if known is None or known.recording.channels is not recording.channels:
            return cls(recording, needs, imu, Facts(recording))
        same = (recording.setup, needs, imu) == (known.recording.setup, known.needs, known.imu)
        return known if same else replace(known, recording=recording, needs=needs, imu=imu)

    @property
    def gnss_faults(self) -> IndexArray:
        """As `Facts.gnss_faults`."""
        return self.facts.gnss_faults

    @property
    def travel(self) -> Travel:
        """As `Facts.travel`."""
        return self.facts.travel

    @cached_property
    def doubts(self) -> tuple[Doubt, ...]:
        """The doubts about channels that the pipeline reads."""
        read = {channel.id for channel in self.needs.channels(self.recording)}
        return tuple(d for d in self.facts.doubts if read.intersection(d.suspects))

    @cached_property
    def cautions(self) -> tuple[str, ...]:
        """One line for each thing that a user should know, each once.

        Raises InputError for a recording that cannot be processed.
        """
        lines = examine(self.recording, self.needs, self.facts.examined)
        read = {channel.id for channel in self.needs.channels(self.recording)}
        for doubt in self.doubts:
            if doubt.fatal and read.issuperset(doubt.suspects):
                raise InputError(doubt.line)
        lines = (*lines, *(doubt.line for doubt in self.doubts))
        if self.imu is None:
            return lines
        return (*lines, *check_kinematics(self.recording, self.imu, self.gnss_faults))
