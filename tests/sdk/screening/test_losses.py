"""Channels that are missing, silent, wild or cut: named, reported and survived, or refused."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.screening.drives import (
    LAT,
    LONG,
    PITCH,
    ROLL,
    YAW,
    Change,
    driven,
    each,
    warnings_of,
)

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording


def without(*names: str) -> Change:
    return lambda recording: replace(
        recording, channels=tuple(c for c in recording.channels if c.id.name not in names)
    )


@pytest.mark.parametrize(
    ("gone", "gnss", "attitude", "text"),
    [
        ((ROLL,), False, False, "channel roll_rate: missing"),
        ((LONG, YAW), True, True, f"channels left.{LONG}, yaw_rate: missing"),
        (("gnss_height", "gnss_roll"), True, True, "channels gnss_height, gnss_roll: missing"),
        (("gnss_vertical_velocity",), True, False, "channel gnss_vertical_velocity: missing"),
    ],
)
def test_all_channels_that_are_missing_are_named_at_once(
    gone: tuple[str, ...], gnss: bool, attitude: bool, text: str
) -> None:
    with pytest.raises(InputError, match=rf"^{text}"):
        warnings_of(without(*gone)(driven("hill at speed")), "left", gnss=gnss, attitude=attitude)


def test_what_a_pipeline_does_not_read_may_be_missing() -> None:
    recording = driven("hill at speed")
    assert warnings_of(without("gnss_roll")(recording), "left", attitude=False) == ()
    assert warnings_of(without("gnss_height")(recording), "left", gnss=False, attitude=False) == ()
    (line,) = warnings_of(without("gnss_quality")(recording), "left")
    assert (
        line == "channel gnss_quality: missing; every reading of gnss_height is taken as RTK fixed"
    )


@settings(deadline=None, max_examples=10)
@given(
    name=st.sampled_from([ROLL, PITCH, YAW]),
    at=st.integers(0, 1300),
    length=st.integers(12, 400),
    stamped=st.booleans(),
)
def test_a_silent_gyro_is_told_and_survived(name: str, at: int, length: int, stamped: bool) -> None:
    """Whether samples are NaN or left out; the second one counts half a step to each side."""

    def silenced(channel: Channel) -> Channel:
        values = channel.values.copy()
        lost = np.zeros(values.size, np.bool_)
        lost[at : at + length] = True
        if stamped and 0 < at < at + length < values.size:
            return replace(
                channel, values=values[~lost], clock=StampedClock.of(channel.times_s[~lost])
            )
        values[lost] = np.nan
        return replace(channel, values=values)

    recording = driven("curve at speed")
    size = next(c.values.size for c in recording.channels if c.id.name == name)
    (line,) = warnings_of(each(name, silenced)(recording), "left")
    seconds = min(length, size - at) / 100
    assert line == (
        f"channel {name}: no samples for {seconds:.4g} s in 1 place, at most {seconds:.4g} s from "
        f"{at / 100:.6g} s; bridged and flagged"
    )


@pytest.mark.parametrize("value", [20.5, -30.0])
def test_a_wild_rate_is_refused(value: float) -> None:
    def wild(channel: Channel) -> Channel:
        values = channel.values.copy()
        values[77] = value
        return replace(channel, values=values)

    with pytest.raises(InputError, match=rf"^channel yaw_rate: sample 77 is {value:.4g} rad/s"):
        warnings_of(each(YAW, wild)(driven("hill at speed")), "left")


@pytest.mark.parametrize("change", [lambda c: 0.0 * c.values + np.nan, lambda c: c.values])
def test_a_run_of_a_second_is_checked_for_what_it_has(change: Callable[[Channel], Any]) -> None:
    clock = UniformClock.of(100.0)
    names = ("distance", LONG, LAT, ROLL, PITCH, YAW, "vertical_specific_force", "height")
    rng = np.random.default_rng(0)
    channels = tuple(Channel.of(n, rng.standard_normal(100), clock) for n in names)
    short = Recording(channels)
    assert warnings_of(short, "main", gnss=False, attitude=False) == ()
    gone = each(ROLL, lambda c: replace(c, values=change(c)))(short)
    if np.isnan(change(channels[0])).all():
        with pytest.raises(InputError, match=r"^channel roll_rate: no samples for 1 of"):
            warnings_of(gone, "main", gnss=False, attitude=False)


NAMES = (LONG, LAT, ROLL, PITCH, YAW, "distance", "vertical_specific_force", "gnss_height",
         "gnss_vertical_velocity", "gnss_pitch", "gnss_roll", "gnss_quality", "gnss_latitude",
         "gnss_longitude")  # fmt: skip


def spoilt(channel: Channel, kind: str, begin: float, share: float) -> Channel:
    values = channel.values.copy()
    first = int(begin * values.size)
    part = slice(first, max(first + int(share * values.size), first + 1))
    if kind in ("cut", "few"):
        kept = np.arange(values.size)[part][:: 97 if kind == "few" else 1]
        return replace(channel, values=values[kept], clock=StampedClock.of(channel.times_s[kept]))
    values[part] = {"lost": np.nan, "constant": values[first], "zero": 0.0, "wild": 1e200}[kind]
    return replace(channel, values=values)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(
    damage=st.lists(
        st.tuples(
            st.sampled_from(NAMES),
            st.sampled_from(["lost", "constant", "zero", "cut", "few", "wild", "absent"]),
            st.floats(0.0, 0.9),
            st.floats(0.1, 1.0),
        ),
        max_size=6,
    )
)
def test_whatever_is_damaged_gets_lines_or_a_refusal(
    damage: list[tuple[str, str, float, float]],
) -> None:
    """Nothing else is raised, and no arithmetic warning is let through.

    Wild samples of the nominal channels are refused before.
    """
    recording = driven("level, perfect" if len(damage) % 2 else "banked")
    for name, kind, begin, share in damage:
        if name in ("distance", "vertical_specific_force") and kind in ("wild", "absent"):
            continue
        if kind == "absent":
            recording = without(name)(recording)
        else:
            recording = each(name, lambda c, k=kind, b=begin, s=share: spoilt(c, k, b, s))(
                recording
            )
    try:
        lines = warnings_of(recording, "left")
    except InputError as error:
        lines = (str(error),)
    assert all(line.startswith(("channel", "setup.")) and "\n" not in line for line in lines)
