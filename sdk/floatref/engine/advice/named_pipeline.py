"""What a pipeline that a user names cannot measure in a recording, and which one can.

`auto` takes a pipeline by the channels; a name may ask for one that the recording does not suit.
"""

from collections.abc import Iterator, Mapping, Sequence

from floatref.engine.choosing import has_channels, lost_reference, usable
from floatref.engine.run import Result
from floatref.engine.validity_and_sigma import Reach
from floatref.interfaces.pipeline import Pipeline
from floatref.screening.travel import Travel
from floatref.values.display.short_text import join_some
from floatref.values.recording import Recording

MOST_PLACES = 3
"""Number of places that a line names; of more it says how many."""


def other_for_channels(
    recording: Recording, pipeline: Pipeline, known: Mapping[str, Pipeline]
) -> str:
    """Return, to follow a refusal, which pipeline has its channels where ``pipeline`` lacks one.

    It is empty where no channel of ``pipeline`` is missing, or no pipeline of `auto` has its own.
    """
    if has_channels(recording, pipeline):
        return ""
    able = next(usable(recording, known), None)
    return f"; {able.pipeline} can be taken, with the channels of this recording" if able else ""


def without_reference(
    recording: Recording, pipeline: Pipeline, known: Mapping[str, Pipeline]
) -> Iterator[str]:
    """Yield one line if ``pipeline`` has no GNSS height to use, and which one needs no GNSS."""
    able = next(usable(recording, known), None)
    if able is not None and able.pipeline != pipeline.name:
        lost = lost_reference(recording, pipeline)
        if lost:
            yield f"{pipeline.name} has no reference: {lost}; {able.pipeline} needs no GNSS"


def lost_at_stops(
    recording: Recording, result: Result, known: Mapping[str, Pipeline]
) -> Iterator[str]:
    """Yield one line if the pipeline of ``result`` loses the road at stops that are recorded.

    It names them, the slow travel, and the pipeline that measures there. The vehicle's places are
    those that its screening has found. Where the run is too near to its ends for any
    pipeline, there is no line.
    """
    profile = result.profile
    if known[profile.pipeline].through_stops is not False:
        return
    run_in_m = Reach.of(profile.settings).run_in_m
    inside = profile.start_m + run_in_m, profile.start_m + profile.length_m - run_in_m
    lost = list(_lost(result.screening.travel, profile.settings.get("slow_mps"), inside))
    if lost:
        able = next((c for c in usable(recording, known) if known[c.pipeline].through_stops), None)
        other = "no pipeline" if able is None else able.pipeline
        yield (
            f"{profile.pipeline} cannot measure {' and '.join(lost)}: {other} can, with the "
            "channels of this recording"
        )


def _lost(travel: Travel, slow_mps: float | None, inside: tuple[float, float]) -> Iterator[str]:
    """Yield what is lost between two places in m: the stops, and slow travel that is no stop."""
    low, high = inside
    stops = [place for place in travel.stops_m() if low < place < high]
    if stops:
        places = [f"{place:.0f} m" for place in stops]
        yield f"the {'stop' if len(stops) == 1 else 'stops'} at {join_some(places, MOST_PLACES)}"
    slow = () if slow_mps is None else travel.slow_stretches_m(slow_mps)
    creeping = [
        (begin, end)
        for begin, end in slow
        if low < end and begin < high and not _holds(travel.stops_m(), begin, end)
    ]
    if creeping:
        places = [f"{begin:.0f} to {end:.0f} m" for begin, end in creeping]
        yield f"travel below {slow_mps:.3g} m/s from {join_some(places, MOST_PLACES)}"


def _holds(places: Sequence[float], begin: float, end: float) -> bool:
    return any(begin <= place <= end for place in places)
