"""What `floatref channels --map` tells of a recording is what is in it."""

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from floatref.files.document import plain
from floatref.mapping import read_native
from floatref.mapping.channel_map.entries import ChannelEntry, ChannelMap
from floatref.mapping.report import inspect_reading

Put = Callable[..., Path]


def test_a_channel_is_summed_up(put: Put, make_stream, a_drive) -> None:
    run = a_drive()
    run["height"][[3, 5]] = np.nan
    report = inspect_reading(
        read_native(put(make_stream("s", run, rate=Fraction(1000), first_tick=4)))
    )
    assert [c["channel"] for c in report["channels"]] == list(run)
    height = report["channels"][1]
    good = run["height"][~np.isnan(run["height"])]
    assert height["native"] == "s/height"
    assert (height["unit"], height["count"], height["missing"]) == ("m", 8000, 2)
    assert (height["rate_hz"], height["begin_s"], height["end_s"]) == (
        1000.0,
        4.0,
        4.0 + 7999 / 1000,
    )
    assert (height["least"], height["greatest"]) == (good.min(), good.max())
    assert height["mean"] == pytest.approx(good.mean(), rel=1e-12)
    assert report["clocks"] == []
    assert len(report["warnings"]) == 1
    assert report["warnings"][0].startswith("channel height (s/height): 2 of 8000 samples missing")


def test_what_cannot_be_processed_is_a_warning_with_the_native_name(
    put: Put, make_stream, a_drive
) -> None:
    run = a_drive()
    run["vertical_specific_force"] /= 9.80665
    chart = ChannelMap(
        tuple(ChannelEntry(f"s/{n}x", n, unit={"distance": "m", "height": "m"}.get(n, "m/s^2"))
              for n in run)
    )  # fmt: skip
    source = put(make_stream("s", {f"{n}x": v for n, v in run.items()}, rate=Fraction(1000)))
    warnings = inspect_reading(read_native(source, chart))["warnings"]
    assert warnings == [
        "cannot be processed yet: channel vertical_specific_force (s/vertical_specific_forcex): "
        "mean is 1, expected about 9.8 m/s^2; looks like g, multiply by 9.80665 "
        "(map: unit = 'g')"
    ]


def test_a_single_sample_has_no_rate(put: Put, make_stream) -> None:
    source = put(make_stream("s", {"height": [0.3]}, ticks=[5]))
    report = inspect_reading(read_native(source))
    text = json.dumps(plain(report, "report"), allow_nan=False)
    assert json.loads(text)["channels"][0]["rate_hz"] is None
