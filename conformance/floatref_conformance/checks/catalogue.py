"""The ids of the whole suite in the order of its list, and the requirement of each."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

IDS: Mapping[str, str] = {
    "quiescent": "standing still with the engine on, the profile is flat",
    "bounce": "body motion over a standing wheel does not reach the profile",
    "constant-speed": "the profile follows the road at constant speed",
    "low-speed": "the profile follows the road, or says where not, below 16 km/h",
    "coasting": "the profile follows the road while the vehicle coasts",
    "throttle": "the profile follows the road under throttle",
    "braking": "the profile follows the road under braking",
    "near-stop": "the error of a near stop is bounded and flagged",
    "stop": "the error of a stop is bounded and flagged",
    "dead-start": "the error of a start from rest is bounded and flagged",
    "waveband": "each waveband is passed as the filter says",
    "repeatability": "two passes over one road agree",
    "distance": "features lie where they are",
    "invariance": "what must not matter does not matter",
    "faults": "missing and damaged samples are flagged and stay local",
}


@dataclass(frozen=True)
class LeftOut:
    """A check that is not run, the reason, and the clause of the check."""

    id: str
    reason: str
    clause: str = ""


def not_built(built: Iterable[str]) -> tuple[LeftOut, ...]:
    """Return the checks of the suite's list that are not among ``built``."""
    return tuple(LeftOut(id_, "not built yet") for id_ in IDS if id_ not in set(built))
