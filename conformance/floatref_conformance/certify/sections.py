"""A test section: reference and runs cut to it, compared with each other, and judged."""

from collections.abc import Sequence
from dataclasses import dataclass

from floatref.values.profile import Profile
from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.plan import SectionPlan
from floatref_conformance.certify.worksheet import SectionSheet


@dataclass(frozen=True, eq=False)
class Run:
    """One run as it was read and placed on the reference's axis, not yet cut to the section.

    Attributes:
        name: told apart from the section's other runs by it.
        source: the path that was given.
        said: what had to be done to it, and warnings.
        profile: with the reference's wheel paths; None if it could not be used.
        error: why it could not; empty otherwise.
    """

    name: str
    source: str
    said: tuple[str, ...] = ()
    profile: Profile | None = None
    error: str = ""


def section_sheet(
    plan: SectionPlan, reference: Profile, runs: Sequence[Run], limits: CertificationLimits
) -> SectionSheet:
    """Return what was measured at a section, and what became of its criteria.

    ``reference`` is the whole one; runs come in the natural order of their names, whatever their
    order here. Raises InputError for a stretch that the reference does not hold, or a reference
    that is not measured all along it.
    """
    raise NotImplementedError
