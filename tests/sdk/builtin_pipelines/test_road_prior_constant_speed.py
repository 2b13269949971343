"""At a constant speed the road prior is the profiler that it began as."""

import numpy as np
import pytest

from floatref.engine.run import run
from floatref.measures import iri
from floatref_conformance.proving_ground import Scenario, simulate


@pytest.mark.slow
@pytest.mark.parametrize(
    ("speed_kmh", "road", "iri_m_per_km"),
    [(97.0, "measured", 1.2), (50.0, "sayers-asphalt-long-waves", 1.5), (20.0, "iso-B", 1.8)],
)
def test_its_iri_is_that_of_the_basic_profiler_and_it_vouches_for_it(
    speed_kmh: float, road: str, iri_m_per_km: float
) -> None:
    """Over 240 m, within a thousandth."""
    scenario = Scenario(
        seed=5,
        road=road,
        iri_m_per_km=iri_m_per_km,
        speed_kmh=speed_kmh,
        length_m=480.0,
        tracks=("left",),
        rate_hz=2000.0,
        profile_interval_m=0.05,
        imu=False,
        gnss=False,
    )
    recording, found = simulate(scenario).recording, []
    for pipeline in ("temporal-basic", "road-prior-smoother"):
        (track,) = run(recording, pipeline).profile.tracks
        inside = slice(2400, 7200)
        assert np.mean(track.valid[inside]) == 1.0
        found.append(iri(track.elevation[inside], 0.05))
    basic, ours = found
    assert ours == pytest.approx(basic, rel=1e-3)
