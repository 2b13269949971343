"""Native samples become SI samples as the map says, however they are cut into pieces."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping.channel_map.conversion import Conversion
from floatref.mapping.channel_map.entries import ChannelEntry
from floatref.mapping.channel_map.units import unit_of
from floatref.values.native import Column

few = settings(deadline=None, max_examples=80)
HEIGHTS = ("m", "mm", "in", "ft", "um")
finite = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-6)


def conversion(channel: str = "height", unit: str = "m", **more) -> Conversion:
    return Conversion(ChannelEntry("c", channel, unit=unit, **more), Column("c"))


def converted(
    made: Conversion, values: Sequence[float], times: Sequence[float] | None = None, cuts=()
) -> np.ndarray:
    """Return all of ``values``, given to ``made`` in pieces that end at ``cuts``."""
    samples = np.asarray(values, np.float64)
    when = np.arange(samples.size) / 100 if times is None else np.asarray(times, np.float64)
    pieces = zip(np.split(samples, sorted(cuts)), np.split(when, sorted(cuts)), strict=True)
    return np.concatenate([made(piece, time) for piece, time in pieces])


@st.composite
def cut_samples(draw: st.DrawFn) -> tuple[list[float], list[int]]:
    values = draw(st.lists(st.one_of(finite, st.just(math.nan)), min_size=1, max_size=40))
    return values, draw(st.lists(st.integers(0, len(values)), max_size=6))


def travelled(speeds: Sequence[float], times: Sequence[float]) -> list[float]:
    distance, found, before = 0.0, [], None
    for v, t in zip(speeds, times, strict=True):
        if math.isnan(v):
            found.append(math.nan)
            continue
        if before is not None:
            distance += (t - before[1]) * (v + before[0]) / 2
        found.append(distance)
        before = (v, t)
    return found


@pytest.mark.slow
@few
@given(
    values=st.lists(finite, min_size=1, max_size=30),
    unit=st.sampled_from(HEIGHTS),
    scale=finite.filter(bool),
    offset=finite,
    sign=st.sampled_from([1, -1]),
)
def test_si_is_sign_times_unit_times_scale_times_sample_plus_offset(
    values: list[float], unit: str, scale: float, offset: float, sign: int
) -> None:
    made = conversion(unit=unit, scale=scale, offset=offset, sign=sign)
    size = {"m": 1.0, "mm": 1e-3, "in": 0.0254, "ft": 0.3048, "um": 1e-6}[unit]
    wanted = [sign * size * (scale * x + offset) for x in values]
    room = 1e-13 * size * max(abs(scale * x) + abs(offset) for x in values)
    np.testing.assert_allclose(converted(made, values), wanted, rtol=1e-13, atol=room)
    made.finish()
    assert made.warnings == []


@few
@given(given_=cut_samples(), integrates=st.booleans(), wraps=st.booleans())
def test_how_samples_are_cut_into_pieces_does_not_matter(
    given_: tuple[list[float], list[int]], integrates: bool, wraps: bool
) -> None:
    values, cuts = given_
    made = [
        conversion("distance", "km/h" if integrates else "m", wrap=1e6 if wraps else None)
        for _ in range(2)
    ]
    whole, pieces = converted(made[0], values), converted(made[1], values, cuts=cuts)
    np.testing.assert_allclose(pieces, whole, rtol=1e-12, atol=1e-9)
    np.testing.assert_array_equal(np.isnan(pieces), np.isnan(values))


@few
@given(
    steps=st.lists(st.integers(-49, 49), min_size=1, max_size=60),
    start=st.integers(-300, 300),
    lost=st.sets(st.integers(0, 60)),
    cuts=st.lists(st.integers(0, 60), max_size=5),
    signed=st.booleans(),
)
def test_a_counter_goes_on_where_it_starts_again(
    steps: list[int], start: int, lost: set[int], cuts: list[int], signed: bool
) -> None:
    wrap = 200
    true = start + np.cumsum([0, *steps])
    native = np.mod(true, wrap).astype(float)
    if signed:
        native[native >= wrap / 2] -= wrap
    # Lost readings are bridged as long as less than half a turn lies between those that are there.
    lost = {i for i in lost if i < native.size and i % 2}
    native[list(lost)] = np.nan
    found = converted(
        conversion("distance", scale=0.5, wrap=wrap), native, cuts=[c for c in cuts if c <= 60]
    )
    there = ~np.isnan(native)
    np.testing.assert_array_equal(np.isnan(found), ~there)
    np.testing.assert_allclose(
        found[there] - found[there][0], 0.5 * (true[there] - true[there][0]), atol=1e-9
    )
    assert found[0] == 0.5 * native[0]


@pytest.mark.parametrize("sample", [65537.0, -70000.0])
def test_a_counter_beyond_its_wrap_is_refused(sample: float) -> None:
    with pytest.raises(InputError, match=r"wrap is 65536, but a sample is .*; correct wrap"):
        converted(conversion("distance", wrap=65536), [1.0, sample])


@few
@given(
    rows=st.lists(
        st.tuples(st.one_of(st.floats(0, 200), st.just(math.nan)), st.floats(0, 0.5)),
        min_size=1,
        max_size=50,
    ),
    cuts=st.lists(st.integers(0, 50), max_size=5),
    start=st.floats(-1e3, 1e3),
)
def test_a_speed_is_integrated_by_the_trapezoidal_rule(
    rows: list[tuple[float, float]], cuts: list[int], start: float
) -> None:
    speeds, steps = zip(*rows, strict=True)
    times = start + np.cumsum(steps)
    made = conversion("distance", "km/h")
    found = converted(made, speeds, times, [c for c in cuts if c <= len(rows)])
    wanted = travelled([v / 3.6 for v in speeds], times.tolist())
    np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-9)
    made.finish()
    assert made.warnings == ["a speed, integrated into the distance"]


@few
@given(
    values=st.lists(st.sampled_from([-1.0, 0.0, 1.0, 65535.0, 65534.0]), min_size=1, max_size=30)
)
def test_codes_for_missing_are_missing_and_nothing_else(values: list[float]) -> None:
    found = converted(conversion(unit="mm", scale=2.0, missing=(-1.0, 65535.0)), values)
    for native, si in zip(values, found, strict=True):
        if native in (-1.0, 65535.0):
            assert math.isnan(si)
        else:
            assert si == pytest.approx(0.002 * native)


def test_a_code_is_no_count() -> None:
    made = conversion("distance", wrap=100, missing=(65535.0,))
    found = converted(made, [98, 99, 65535, 0, 1])
    np.testing.assert_array_equal(found, [98, 99, np.nan, 100, 101])


@pytest.mark.parametrize("wrap", [None, 100])
def test_infinite_samples_are_missing_and_told(wrap: float | None) -> None:
    made = conversion("distance", wrap=wrap)
    found = converted(made, [1.0, np.inf, -np.inf, 2.0], cuts=[2])
    np.testing.assert_array_equal(found, [1.0, np.nan, np.nan, 2.0])
    made.finish()
    assert made.warnings == ["2 samples are infinite; taken as missing"]


def test_samples_that_overflow_are_missing_and_told() -> None:
    made = conversion(scale=1e30, offset=-1e30)
    np.testing.assert_array_equal(converted(made, [1e300, 1.0]), [np.nan, 0.0])
    made.finish()
    assert made.warnings == ["1 samples are infinite; taken as missing"]


def test_the_samples_of_an_adapter_stay_as_they_were() -> None:
    values = np.array([1.0, -1.0, np.inf])
    converted(conversion(missing=(-1.0,)), values)
    np.testing.assert_array_equal(values, [1.0, -1.0, np.inf])


def test_the_unit_of_the_file_counts_where_the_map_says_none() -> None:
    made = Conversion(ChannelEntry("c", "height"), Column("c", "mm"))
    assert converted(made, [250.0]).item() == pytest.approx(0.25)
    assert made.unit == "mm"


@pytest.mark.parametrize("given_", ["", " "])
def test_a_channel_without_a_unit_may_have_none_in_the_file(given_: str) -> None:
    made = Conversion(ChannelEntry("c", "gnss_quality"), Column("c", given_))
    assert converted(made, [4.0]).item() == 4.0
    with pytest.raises(InputError, match="the file gives no unit; state it in the map"):
        Conversion(ChannelEntry("c", "height"), Column("c", given_))


@pytest.mark.parametrize(
    ("channel", "unit", "file", "message"),
    [
        ("height", "m", "deg", "the map says m, the file deg; correct the map, or scale"),
        ("distance", "m", "km/h", "the map says m, the file km/h"),
        ("height", "g", "", "unit 'g' is not a unit of height; expected one of m"),
        ("pitch_rate", "deg", "", "unit 'deg' is not a unit of pitch_rate; expected one of rad/s"),
        ("height", "km/h", "", "is not a unit of height"),
        ("distance", None, "counts", 'give scale, how many m one is, and unit = "m"'),
        ("height", None, "volts", "unit 'volts': unknown"),
        ("height", "volts", "", "unit 'volts': unknown"),
        ("gnss_quality", "m", "", "is not a unit of gnss_quality"),
    ],
)
def test_units_that_cannot_be_are_refused(
    channel: str, unit: str | None, file: str, message: str
) -> None:
    with pytest.raises(InputError) as caught:
        Conversion(ChannelEntry("c", channel, unit=unit), Column("c", file))
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("unit", "file", "scale", "warned"),
    [
        ("mm", "m", 1.0, True),
        ("m", "counts", 1.0, True),
        ("mm", "mm", 1.0, False),
        ("mm", "[MM]", 1.0, False),
        ("m", "V", 0.25, False),
        ("m", "mm", 0.001, False),
        ("m", "furlong", 1.0, False),
    ],
)
def test_a_map_that_overrules_the_file_is_told(
    unit: str, file: str, scale: float, warned: bool
) -> None:
    made = Conversion(ChannelEntry("c", "height", unit=unit, scale=scale), Column("c", file))
    assert made.warnings == (
        [f"the file says unit {file}, the map {unit}; the map counts"] if warned else []
    )
    assert converted(made, [2.0]).item() == pytest.approx(unit_of(unit).factor * scale * 2.0)
