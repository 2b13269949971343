"""GNSS readings that the filter does not believe are counted, and told by channel."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.estimators.kalman.inputs import GNSS
from floatref.estimators.models.kalman_values import BELIEVED_AT

RATE, SECONDS, ORIGIN_S = 200, 8.0, 17.25
WILD = (1.5, -3.0, 0.3, -0.3)
LIMITS = ("0.2 m", "0.5 m/s", "0.0524 rad", "0.0524 rad")
laws = settings(deadline=None, max_examples=6)
both = pytest.mark.parametrize("stage", [KalmanFilter, KalmanSmoother])


def line(drive, kind, at, count):
    first = ORIGIN_S + drive.at[at] / RATE
    readings = "1 reading" if count == 1 else f"{count} readings"
    return (
        f"channel {GNSS[kind]}: {readings} left out, more than {LIMITS[kind]} and ten times the "
        f"expected 1-σ off, the first at {first:.6g} s; check the receiver there, and the profile "
        "around it"
    )


@both
@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    wild=st.dictionaries(
        st.integers(0, 3), st.sets(st.integers(60, 130), min_size=1, max_size=10), max_size=4
    ),
)
def test_wild_readings_are_told_by_channel_and_sound_ones_are_not(
    drive, through, stage, seed, wild
):
    drawn, made = drive(seed, SECONDS, RATE), stage(Plan(), Noise())
    for kind, lost in wild.items():
        drawn.y[sorted(lost), kind] += WILD[kind]
    through(made, drawn, range(300, len(drawn.u), 300))
    expected = [line(drawn, kind, min(wild[kind]), len(wild[kind])) for kind in sorted(wild)]
    assert list(made.warnings()) == expected


@both
@pytest.mark.parametrize("leap", [1.0, -1.0])
def test_of_a_leap_the_readings_are_told_before_it_is_taken_for_another_datum(
    drive, through, stage, leap
):
    drawn, made = drive(5, SECONDS, RATE), stage(Plan(), Noise())
    drawn.y[80:, 0] += leap
    through(made, drawn)
    assert made.warnings() == (line(drawn, 0, 80, BELIEVED_AT - 1),)


@both
def test_heights_that_do_not_insist_are_left_out_however_many_they_are(drive, through, stage):
    """Every third reading is wild, more of them than are believed in a row."""
    drawn, made = drive(6, 10.0, RATE), stage(Plan(), Noise())
    wild = range(30, 120, 3)
    assert len(wild) > BELIEVED_AT
    drawn.y[wild, 0] += WILD[0]
    through(made, drawn)
    assert made.warnings() == (line(drawn, 0, 30, len(wild)),)


@both
def test_before_the_first_sample_there_is_nothing_to_tell(drive, stage):
    made = stage(Plan(), Noise())
    made.start(drive(1, 0.1, RATE).header)
    assert made.warnings() == ()
