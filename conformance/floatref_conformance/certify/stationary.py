"""Recorded stationary tests of AASHTO R 57-14: the IRI of a parked vehicle, wheel path by path."""

from collections.abc import Sequence

from floatref.values.profile import Profile
from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.plan import StationaryPlan
from floatref_conformance.certify.worksheet import StationarySheet


def stationary_sheet(
    id_: str,
    plan: StationaryPlan,
    profile: Profile | None,
    limits: CertificationLimits,
    said: Sequence[str] = (),
    error: str = "",
) -> StationarySheet:
    """Return the sheet of test ``id_``, ``quiescent`` or ``bounce``.

    Without ``profile`` the test counts as missing, for the reason in ``error``.
    """
    raise NotImplementedError
