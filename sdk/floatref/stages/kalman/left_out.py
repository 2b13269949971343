"""What a user is told of GNSS readings that the filter did not believe."""

from collections.abc import Iterator

from floatref.kernels.kalman_layout import REJECTED, REJECTED_AT
from floatref.stages.kalman.inputs import GNSS
from floatref.stages.kalman.track import FLOORS
from floatref.values.arrays import FloatArray

UNITS = ("m", "m/s", "rad", "rad")


def left_out(memories: FloatArray, origin_s: float, step: float) -> Iterator[str]:
    """Yield a line for each channel of GNSS with readings that were left out.

    ``memories``, shape (tracks, MEMORY), are those of the filters of all wheel paths, which read
    the same; sample 0 was at ``origin_s``, and ``step`` in s lies between two.
    """
    for kind, (channel, floor, unit) in enumerate(zip(GNSS, FLOORS, UNITS, strict=True)):
        counts = memories[:, REJECTED + kind]
        if not counts.any():
            continue
        at = memories[counts > 0.0, REJECTED_AT + kind].min()
        count = int(counts.max())
        readings = "1 reading" if count == 1 else f"{count} readings"
        yield (
            f"channel {channel}: {readings} left out, more than {floor:.3g} {unit} and ten times "
            f"the expected 1-σ off, the first at {origin_s + at * step:.6g} s; check the receiver "
            "there, and the profile around it"
        )
