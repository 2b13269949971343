"""What a map says of clocks fits together, and is exact."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest

from floatref.mapping import read_map

HEAD = 'format = "floatref-map/1"\n'
LASER = '[[channels]]\nnative = "laser"\nchannel = "height"\n'

Save = Callable[[str | bytes], Path]
Refusal = Callable[[Path], str]


@pytest.mark.parametrize(
    ("given", "rate"),
    [
        ("1000", Fraction(1000)),
        ("0.1", Fraction(1, 10)),
        ("33.333333333333336", Fraction(100, 3)),
        ('"48000/7"', Fraction(48000, 7)),
        ('"16000"', Fraction(16000)),
        ("1e7", Fraction(10**7)),
        ("0.001", Fraction(1, 1000)),
    ],
)
def test_rates_are_exact(save: Save, given: str, rate: Fraction) -> None:
    chart = read_map(save(f"{HEAD}[[clocks]]\nrate_hz = {given}\n{LASER}"))
    assert chart.clocks[0].rate == rate


@pytest.mark.parametrize("given", ['"1/0"', '"0/1"', '"0"', '"99999999999"', '"1/999999999999"'])
def test_a_rate_that_no_sensor_has_is_refused(save: Save, refusal: Refusal, given: str) -> None:
    line = refusal(save(f'{HEAD}[[clocks]]\nstream = "a"\nrate_hz = {given}\n{LASER}'))
    assert line.startswith('clock of the source, stream "a": rate_hz is ')


@pytest.mark.parametrize(
    "given", ["0", "-5", "1e8", '"-5"', '" 5"', '"5\\n"', '"x"', "[]", '"1/2/3"']
)
def test_what_is_no_rate_is_refused(save: Save, refusal: Refusal, given: str) -> None:
    assert "expected a rate in Hz" in refusal(save(f"{HEAD}[[clocks]]\nrate_hz = {given}\n{LASER}"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([], "has no content; write align"),
        (["offset_s = 1"], 'offset_s is given; write align = "offset" or'),
        (["rate_hz = 5", "offset_s = 1"], "offset_s is given; write align"),
        (["drift_ppm = 1"], 'drift_ppm is given; write align = "offset"'),
        (['align = "gnss"', "drift_ppm = 1"], "drift_ppm is given"),
        (['align = "pulse"'], 'align is "pulse"; did you mean pulses?'),
        (['align = "pulses"'], "needs pulses and base_pulses"),
        (['align = "pulses"', 'pulses = "a"'], "needs pulses and base_pulses"),
        (['pulses = "a"', 'base_pulses = "b"'], 'pulses is given; write align = "pulses"'),
        (['align = "offset"', 'base_pulses = "b"'], "base_pulses is given"),
        (['align = "offset"', 'base_time = "b"'], 'base_time is given; write align = "gnss"'),
        (['base_pps = "b"'], "base_pps is given"),
        (['align = "gnss"', 'base_pps = "b"', 'base_time = "c"'], "keep one of them"),
        (["start_s = 1"], "start_s is given; write rate_hz as well"),
        (['align = "offset"', "start_s = 1"], "start_s is given"),
    ],
)
def test_what_a_clock_says_has_to_fit_together(
    save: Save, refusal: Refusal, lines: list[str], message: str
) -> None:
    text = "\n".join(["[[clocks]]", 'stream = "a"', *lines])
    assert message in refusal(save(f"{HEAD}{text}\n{LASER}"))


@pytest.mark.parametrize(
    "lines",
    [
        ['align = "offset"'],
        ['align = "offset"', "offset_s = 1", "drift_ppm = -3"],
        ['align = "pulses"', 'pulses = "a"', 'base_pulses = "b"', "offset_s = 1"],
        ['align = "gnss"'],
        ['align = "gnss"', 'base_time = "t"'],
        ['align = "gnss"', 'base_pps = "t"', "offset_s = 5"],
        ["rate_hz = 100", "start_s = 0"],
        ['align = "offset"', "rate_hz = 100"],
    ],
)
def test_every_way_of_aligning_can_be_said(save: Save, lines: list[str]) -> None:
    text = "\n".join(["[[clocks]]", *lines])
    assert len(read_map(save(f"{HEAD}{text}\n{LASER}")).clocks) == 1


def test_a_clock_given_twice_is_refused(save: Save, refusal: Refusal) -> None:
    clock = '[[clocks]]\nstream = "a"\nrate_hz = 5\n'
    assert "given twice; keep one entry" in refusal(save(HEAD + clock + clock + LASER))
