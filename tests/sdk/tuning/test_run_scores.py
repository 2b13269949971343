"""Scores against a reference: shifted, scaled and damaged copies score what was done to them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.tuning.preliminary_runs import Drive, Kind
from floatref.tuning.run_scores import HOPELESS, Comparison, Score, section
from floatref.values.profile import Profile, ProfileTrack

DX = 0.05
POINTS = 6000
STEADY = Drive(Kind.HIGH, 72.0, 0.0, 0.0, ())
STOP = Drive(Kind.SHORT, 40.0, 0.3, 2.0, (150.0,))


def rough(seed: int) -> np.ndarray:
    """Elevation of white slopes: sums of steps of 1 mm."""
    return 1e-3 * np.cumsum(np.random.default_rng(seed).normal(size=POINTS))


def profile(*elevations: np.ndarray, start_m: float = 0.0, valid: slice = slice(None)) -> Profile:
    tracks = []
    for name, z in zip(("left", "right"), elevations, strict=False):
        mask = np.zeros(z.size, np.bool_)
        mask[valid] = True
        tracks.append(ProfileTrack.of(name, z, mask))
    return Profile(DX, tuple(tracks), start_m)


def compared(drive: Drive, *elevations: np.ndarray) -> Comparison:
    return Comparison(profile(*elevations), 60.0, 240.0, drive)


@settings(deadline=None, max_examples=25)
@given(st.floats(0.5, 2.0), st.integers(-20, 20), st.sampled_from([STEADY, STOP]))
def test_a_scaled_and_shifted_copy(factor: float, lag: int, drive: Drive) -> None:
    z = rough(0)
    copy = profile(factor * z, start_m=lag * DX)
    (score,) = compared(drive, z).scores(copy)
    # Behind the shift other points start the car, whose start has died away by then.
    assert score.cross_correlation == pytest.approx(min(factor, 1.0 / factor), abs=2e-3)
    assert score.offset_m == pytest.approx(lag * DX, abs=1e-9)
    assert score.roughness_error == pytest.approx(factor - 1.0, abs=0.02)
    assert np.isnan(score.iri_error if drive is STOP else score.peak_error)


def test_a_bump_counts_at_the_critical_location_and_only_there() -> None:
    z = rough(1)
    for place, raised in ((150.0, True), (100.0, False)):
        bump = z.copy()
        bump[round(place / DX) : round(place / DX) + 40] += 0.03
        (score,) = compared(STOP, z).scores(profile(bump))
        assert (score.peak_error > 0.3) is raised
        assert score.cross_correlation < 0.99


def test_the_worst_of_several_places_counts() -> None:
    z = rough(2)
    drive = Drive(Kind.SHORT, 40.0, 0.3, 2.0, (110.0, 190.0))
    bump = z.copy()
    bump[round(190.0 / DX) : round(190.0 / DX) + 40] += 0.05
    (score,) = compared(drive, z).scores(profile(bump))
    (other,) = compared(STOP, z).scores(profile(bump))
    assert score.peak_error > 0.5 > abs(other.peak_error)


def test_around_a_critical_location_both_are_seen_at_the_same_road() -> None:
    """A bump that lies within 24 m in the profile lies farther off in the reference."""
    z = rough(10)
    z[round(120.0 / DX) : round(120.0 / DX) + 40] += 0.2
    comparison = Comparison(profile(z), 60.0, 240.0, STOP, max_offset_m=10.0)
    (score,) = comparison.scores(profile(z, start_m=8.0))
    assert score.offset_m == pytest.approx(8.0)
    assert abs(score.peak_error) < 0.02


def test_every_point_counts_valid_or_not() -> None:
    z = rough(3)
    found = compared(STEADY, z).scores(profile(z[::-1].copy()))
    marked = compared(STEADY, z).scores(profile(z[::-1].copy(), valid=slice(0, 1)))
    # As texts: a NaN is not equal to itself in a dataclass, from Python 3.13 on.
    assert repr(marked) == repr(found)


def test_wheel_paths_are_matched_by_name_in_the_order_of_the_reference() -> None:
    left, right = rough(4), rough(5)
    both = Profile(DX, (ProfileTrack.of("right", right), ProfileTrack.of("left", 2.0 * left)))
    scores = compared(STEADY, left, right).scores(both)
    assert [round(s.iri_error, 2) for s in scores] == [1.0, 0.0]
    with pytest.raises(InputError, match="track right: missing"):
        compared(STEADY, left, right).scores(profile(left))


@settings(deadline=None, max_examples=25)
@given(st.floats(-1.0, 1.0), st.floats(-1.0, 10.0))
def test_the_loss_adds_what_is_missing_and_a_bounded_error(rho: float, error: float) -> None:
    expected = 1.0 - rho + min(abs(error), 1.0)
    assert Score(rho, iri_error=error).loss == pytest.approx(expected)
    assert Score(rho, peak_error=error).loss == pytest.approx(expected)
    assert Score(rho).loss == 1.0 - rho <= HOPELESS.loss


def test_the_section_lies_within_what_both_hold_valid() -> None:
    z = rough(6)
    reference = profile(z, valid=slice(1000, 5600))
    made = profile(z, start_m=-10.0, valid=slice(400, 5500))
    assert section(reference, made) == pytest.approx((50.0, -10.0 + 5499 * DX))


def test_of_a_reference_with_holes_the_longest_stretch_counts() -> None:
    z = rough(7)
    valid = np.ones(POINTS, np.bool_)
    valid[2000] = valid[5000] = False
    reference = Profile(DX, (ProfileTrack.of("left", z, valid),))
    assert section(reference, profile(z)) == pytest.approx((2001 * DX, 4999 * DX))
    # A profile's own holes are what it is compared for.
    made = Profile(DX, (ProfileTrack.of("left", z, valid),))
    assert section(profile(z), made) == pytest.approx((0.0, (POINTS - 1) * DX))


@pytest.mark.parametrize(
    ("valid", "text"),
    [
        (slice(0, 900), "the run's profile from 0.0 to 45.0 m; 50 m have to be both"),
        (slice(0, 0), "the run's profile nowhere; 50 m"),
    ],
)
def test_too_little_in_common_is_refused(valid: slice, text: str) -> None:
    with pytest.raises(InputError, match=rf"is valid from 0.0 to 299.9 m, and .*{text}"):
        section(profile(rough(8)), profile(rough(8), valid=valid))


def test_a_smooth_reference_is_refused() -> None:
    with pytest.raises(InputError, match="perfectly smooth"):
        compared(STEADY, np.zeros(POINTS)).scores(profile(rough(9)))
