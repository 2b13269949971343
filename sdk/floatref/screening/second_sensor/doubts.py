"""A doubt about a channel: what is wrong with it, where, and whether it can be used at all."""

from collections.abc import Sequence
from dataclasses import dataclass

from floatref.values.channels import ChannelId

WHOLE = (-float("inf"), float("inf"))
"""The stretch of a doubt about a whole run, in s."""


@dataclass(frozen=True)
class Doubt:
    """A fault that a second sensor shows.

    Attributes:
        suspects: the channels of which one is faulty.
        line: one line that names channel, value and what to do.
        fatal: whether no profile can be made of these channels; never for a fault on a stretch.
        spans: begin and end in s of each faulty stretch, in order.
        replaced: whether samples of the spans measure nothing and count as missing; else the
            profile there is not valid.
    """

    suspects: tuple[ChannelId, ...]
    line: str
    fatal: bool = False
    spans: tuple[tuple[float, float], ...] = (WHOLE,)
    replaced: bool = False

    def __post_init__(self) -> None:
        """Raise ValueError for a fault on a stretch that refuses the recording."""
        if self.fatal and not self.whole_run:
            raise ValueError(f"a fault on a stretch refuses no recording: {self.line}")

    @property
    def whole_run(self) -> bool:
        """Whether the fault lasts for the whole run."""
        return self.spans == (WHOLE,)


def names(channels: Sequence[ChannelId]) -> str:
    """Return ``channels`` as a message lists them."""
    return ", ".join(str(name) for name in channels)
