"""The page on tuning: its kinds, thresholds and bounds are those of the code."""

import re
from pathlib import Path

from floatref.cli.tune.tune_report import FEELS
from floatref.tuning.levels import DENSITY_DOWN, PER_OCTAVE, REACH, TUNED
from floatref.tuning.preliminary_runs import (
    HEAVY_G,
    HIGH_KMH,
    LONG_STOP_S,
    LOW_KMH,
    RECOMMENDED,
    Kind,
)
from floatref.tuning.preparation import LEAST_CORRELATION
from floatref.tuning.procedure import MOST, PRIORITY, ROUNDS
from floatref.tuning.run_scores import AROUND_M, LEAST_M
from floatref.tuning.search import COARSE, LEAST_GAIN, TOLERANCE
from floatref.tuning.sensitivity import FACTORS

PAGE = (Path(__file__).parents[2] / "docs" / "tuning.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())


def test_every_kind_is_in_the_table_with_what_is_recommended_and_taken() -> None:
    rows = re.findall(r"^\| ([a-z ]+) \| (.+) \| (.+) \|$", PAGE, re.M)
    found = {kind: (text, taken) for kind, text, taken in rows if kind != "kind"}
    taken = {
        Kind.LOW: f"up to {LOW_KMH:g} km/h",
        Kind.HIGH: f"from {HIGH_KMH:g} km/h on",
        Kind.LIGHT: f"below {HEAVY_G:g} g",
        Kind.HEAVY: f"from {HEAVY_G:g} g on",
        Kind.SHORT: f"below {LONG_STOP_S:g} s",
        Kind.LONG: f"from {LONG_STOP_S:g} s on",
    }
    assert found == {kind: (text, taken[kind]) for kind, text in RECOMMENDED.items()}


def test_the_page_names_what_is_tuned() -> None:
    (names,) = re.findall(r"four are tuned: (.+?)\.", TEXT)
    assert tuple(re.findall(r"`(\w+)`", names)) == TUNED


def test_numbers_are_those_of_the_code() -> None:
    assert (COARSE, PER_OCTAVE, REACH, DENSITY_DOWN, PRIORITY, ROUNDS) == (4, 2, 12, 4, 2.0, 3)
    for text in (
        f"within {AROUND_M:g} m of the critical location",
        f"by less than {TOLERANCE:g} count as equal, gains below {LEAST_GAIN:g} as zero",
        f"{MOST} at most",
        f"(× {FACTORS[0]:.2f}) and up (× {FACTORS[-1]:.2f})",
        f"by more than {FEELS:g}, a warning",
        f"correlation with the reference is below {LEAST_CORRELATION:g}",
        f"less than {LEAST_M:g} m in common",
    ):
        assert text in TEXT, text
