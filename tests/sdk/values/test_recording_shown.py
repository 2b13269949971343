"""What a recording shows of itself: one short line, and a table of all its channels."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import MOST_CHANNELS, Channel, Recording

LONGEST_LINE = 500


def recording(tracks: list[str], vendor: str = "") -> Recording:
    clock = UniformClock.of(1000.0, 5.0)
    channels = [Channel.of("distance", np.arange(2001.0), clock)]
    channels += [Channel.of("height", [0.3, np.nan], clock, track) for track in tracks]
    return Recording(tuple(channels), vendor=vendor)


@given(st.lists(st.text(min_size=1), max_size=10, unique=True), st.text())
def test_its_line_is_short_whatever_its_names(tracks: list[str], vendor: str) -> None:
    run = recording(tracks, vendor)
    for value in (run, *run.channels):
        assert len(repr(value)) <= LONGEST_LINE
        assert repr(value).isprintable()
    assert ("more)" in repr(run)) == (len(run.channels) > MOST_CHANNELS)


def test_its_line_has_duration_and_rates() -> None:
    run = recording(["left"])
    assert repr(run) == "Recording(2.00 s; distance 1000 Hz, left.height 1000 Hz)"
    assert repr(run.channels[0]) == "Channel(distance 1000 Hz, 2001 samples in m)"


def test_its_duration_is_from_the_first_to_the_last_sample_of_any_channel() -> None:
    early = Channel.of("gnss_height", [1.0, 2.0], StampedClock.of([1.0, 6.0]))
    one = Channel.of("gnss_vertical_velocity", [1.0], StampedClock.of([9.5]))
    run = Recording((*recording([]).channels, early, one))
    assert run.duration_s == 8.5
    assert "gnss_vertical_velocity –" in repr(run)


def test_its_table_has_every_channel_and_what_is_missing() -> None:
    page = recording([f"<{number}>" for number in range(9)], "A & B")._repr_html_()
    assert page.count("<tr>") == 11
    assert page.count("50.0 %") == 9
    assert "&lt;8&gt;.height" in page
    assert "A &amp; B" in page
    assert "<8>" not in page
