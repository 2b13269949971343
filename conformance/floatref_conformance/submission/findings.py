"""What `conformance verify` found: what contradicts, what caught it, and what was repeated."""

from dataclasses import dataclass, field
from enum import StrEnum


class CaughtBy(StrEnum):
    """What shows that an archive is not as it was submitted."""

    CHECKSUMS = "checksums"
    SIGNATURE = "signature"
    REPETITION = "repetition"


@dataclass(frozen=True)
class Finding:
    """One contradiction: what caught it, the member of the archive, and what is wrong there."""

    caught_by: CaughtBy
    where: str
    what: str


@dataclass
class Verification:
    """What came of the verification of one archive.

    Attributes:
        claimed: the verdict that the archive states.
        about: what was judged, how, what was waived, and what its submitter states, in lines.
        signature: who signed it, or that nobody did, in one line.
        findings: all that contradicts.
        repeated, not_repeated: what was repeated here, and what was not, with the reason.
        undecided: what has to be at hand before the archive can be repeated at all; empty
            where it could be.
    """

    claimed: str = ""
    about: tuple[str, ...] = ()
    signature: str = ""
    findings: list[Finding] = field(default_factory=list)
    repeated: list[str] = field(default_factory=list)
    not_repeated: list[str] = field(default_factory=list)
    undecided: str = ""

    def contradict(self, where: str, what: str) -> None:
        """Add a contradiction that only repetition shows."""
        self.findings.append(Finding(CaughtBy.REPETITION, where, what))

    @property
    def is_confirmed(self) -> bool:
        """Whether the archive was repeated, and nothing contradicts."""
        return not self.findings and not self.undecided
