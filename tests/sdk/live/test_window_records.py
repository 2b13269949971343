"""The record of all windows stays short, and says what it has left out."""

import json

from hypothesis import given
from hypothesis import strategies as st

from floatref import write_profile
from floatref.files.document import LARGEST_BYTES
from floatref.files.profile_directory import read_profile
from floatref.live.points import LivePoints, State, join_points, missing_points
from floatref.live.window_records import MOST_BYTES, describe_windows


def windows_of(sizes):
    return [
        {"begin_s": 80.0 * n, "end_s": 80.0 * n + 110.0, "settings": {"a": 1}, "text": size * "x"}
        for n, size in enumerate(sizes)
    ]


@given(st.lists(st.integers(0, 300), max_size=60), st.integers(0, 4000))
def test_first_and_last_windows_are_kept_and_the_others_counted(sizes, most_bytes):
    records = windows_of(sizes)
    found = describe_windows(records, most_bytes)
    kept = [{k: v for k, v in each.items() if k != "settings"} for each in records]
    assert len(json.dumps(found["windows"])) <= most_bytes + 2
    if "left_out" not in found:
        assert found["windows"] == kept
        return
    count = found["left_out"]["count"]
    head = (len(kept) - count + 1) // 2
    gap = kept[head : head + count]
    assert found["windows"] == kept[:head] + kept[head + count :]
    assert found["left_out"] == {
        "count": count,
        "begin_s": gap[0]["begin_s"],
        "end_s": gap[-1]["end_s"],
    }
    # With one more from the end whose turn it is, it would be too long.
    more = gap[0] if head == len(kept) - count - head else gap[-1]
    assert len(json.dumps([*found["windows"], more])) > most_bytes - 2


def test_the_profile_of_a_week_can_be_read_again(tmp_path):
    count = 7 * 24 * 3600 // 80
    points = [
        LivePoints(n, 0.1, missing_points(("left",), 1), State.FINAL, "spatial-hpf", (), record)
        for n, record in enumerate(windows_of(count * [3000]))
    ]
    write_profile(join_points(points), tmp_path / "week")
    assert MOST_BYTES < LARGEST_BYTES
    live = read_profile(tmp_path / "week").provenance["live"]
    assert len(live["windows"]) + live["left_out"]["count"] == count
