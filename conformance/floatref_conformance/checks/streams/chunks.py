"""`live-chunks`: however the samples are cut, the final points are the same."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from floatref_conformance.checks.streams.order import compare
from floatref_conformance.checks.streams.stream_check import Runs, bits, measurement
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.errors import DeviceError

QUANTITY = "change by other pieces"


@dataclass(frozen=True)
class ChunksCheck:
    """Two runs of the same samples in other pieces give the same final points."""

    id: str = "live-chunks"
    title: str = "the same samples in other pieces make the same final points"
    clause: str = "Sameness of pieces"
    derivation: str = (
        "The same samples are streamed in even pieces of half a second with all channels, and in "
        "pieces of 0.01 to 3 s, drawn by the seed, in which each channel comes for itself and in "
        "the opposite order. How a network or a driver cuts samples says nothing about the road, "
        "so every elevation and every flag of the final points must be equal."
    )
    floor: str = "The run has final points."
    limits: Mapping[str, str] = field(
        default_factory=lambda: {QUANTITY: "0, or what the device declares as tolerance_m"}
    )
    is_long: bool = False

    def judge(self, runs: Runs) -> tuple[Measurement, ...]:
        """Return the largest difference of the final points of both runs."""
        worst = compare(runs.plain.final, runs.recut.final)
        if not worst:
            raise DeviceError("stream: gave out no final point; give them at the latest at finish")
        limit = bits(runs.plain)
        return tuple(measurement(QUANTITY, n, v, "m", limit) for n, v in worst.items())
