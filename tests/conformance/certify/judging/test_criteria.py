"""What passes, fails, is missing or is reported alone, and what is said of it."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from floatref_conformance.certify.judging.contents import Criterion, Judged
from floatref_conformance.certify.judging.criteria import verdict_of
from floatref_conformance.certify.judging.limits import CertificationLimits, limits_of
from floatref_conformance.certify.judging.sections import Run
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass

NOISY_M = 3e-3


def criterion(sheet, id_, track=""):
    (found,) = [c for c in sheet.criteria if (c.id, c.track) == (id_, track)]
    return found


def failed(sheet):
    """Return the criteria that failed, with their wheel paths."""
    return {(c.id, c.track) for c in sheet.criteria if c.judged is Judged.FAIL}


@pytest.mark.slow
@pytest.mark.parametrize("device_class", DeviceClass)
def test_perfect_runs_pass_every_class_with_a_correlation_of_one(
    sheet_of, reference, run_over, device_class
):
    limits = replace(limits_of(device_class), runs=3)
    sheet = sheet_of(tuple(run_over(seed, noise_m=1e-12) for seed in range(1, 4)), limits)
    assert failed(sheet) == set()
    for track in ("left", "right"):
        for id_ in ("repeatability", "accuracy"):
            assert criterion(sheet, id_, track).value == pytest.approx(1.0, abs=1e-9)
            assert criterion(sheet, id_, track).judged is Judged.PASS
        assert criterion(sheet, "iri-bias", track).value == pytest.approx(0.0, abs=1e-6)


@pytest.mark.slow
def test_of_the_errors_of_the_iri_the_largest_comes_first_whatever_its_sign(sheet_of, run_over):
    runs = [run_over(k, height=h) for k, h in enumerate((1.03, 0.9, 1.06), 1)]
    sheet = sheet_of(tuple(runs), CertificationLimits(runs=3, iri_bias_percent=1.0))
    named = criterion(sheet, "iri-bias", "left").reason
    assert named.index("run-2") < named.index("run-3") < named.index("run-1")


@pytest.mark.slow
def test_the_averages_are_over_all_pairs_and_over_all_runs(sheet_of, ten_runs):
    sheet = sheet_of(ten_runs)
    pairs = sheet.pairs["left"]
    upper = [pairs[i, j] for i in range(10) for j in range(i + 1, 10)]
    assert len(upper) == 45
    assert criterion(sheet, "repeatability", "left").value == pytest.approx(np.mean(upper))
    scores = [t.accuracy for run in sheet.runs for t in run.tracks if t.track == "left"]
    assert criterion(sheet, "accuracy", "left").value == pytest.approx(np.mean(scores))


@pytest.mark.slow
def test_wheel_paths_are_judged_apart(sheet_of, ten_runs, run_over):
    noisy = [run_over(seed, noise_m=NOISY_M) for seed in range(1, 11)]
    mixed = tuple(
        replace(good, tracks=(good.tracks[0], bad.tracks[1]))
        for good, bad in zip(ten_runs, noisy, strict=True)
    )
    assert failed(sheet_of(mixed)) >= {("repeatability", "right"), ("accuracy", "right")}
    assert not {track for _, track in failed(sheet_of(mixed))} & {"left"}


@pytest.mark.parametrize(
    ("above", "judged"), [(0.0, Judged.PASS), (-0.01, Judged.PASS), (1e-9, Judged.FAIL)]
)
def test_a_correlation_at_its_limit_passes_and_below_fails(sheet_of, ten_runs, above, judged):
    sheet = sheet_of(ten_runs[:2])
    for id_ in ("repeatability", "accuracy"):
        limit = criterion(sheet, id_, "left").value + above
        again = sheet_of(ten_runs[:2], CertificationLimits(**{id_: limit}))
        assert criterion(again, id_, "left").judged is judged
        assert criterion(again, id_, "left").limit == limit


@pytest.mark.slow
def test_a_run_below_the_limit_is_named_though_the_average_passes(sheet_of, ten_runs, run_over):
    sheet = sheet_of((*ten_runs[:9], run_over(10, noise_m=1e-3)))
    found = criterion(sheet, "accuracy", "left")
    assert found.judged is Judged.PASS
    assert found.reason.startswith("below 0.9 by itself: run-10 at 0.")
    assert "run-1 " not in found.reason


def test_one_bad_run_is_blamed_for_the_pairs_of_all_others(sheet_of, ten_runs, run_over):
    bad = Run("torn", "torn.erd", (), None, "line 3 is cut short")
    spoilt = Run("spoilt", "", (), run_over(3, distance=1.01))
    good = (Run(f"run-{k}", "", (), p) for k, p in enumerate(ten_runs[:3]))
    found = criterion(sheet_of((bad, spoilt, *good)), "repeatability", "left")
    assert found.judged is Judged.FAIL
    assert found.reason.startswith("the other runs agree to 0.99")
    assert " without spoilt at 0." in found.reason
    assert "run-" not in found.reason


@pytest.mark.slow
def test_of_many_runs_below_the_worst_are_named_and_the_rest_counted(sheet_of, run_over):
    sheet = sheet_of(tuple(run_over(seed, noise_m=NOISY_M) for seed in range(1, 9)))
    found = criterion(sheet, "accuracy", "right")
    scores = {run.name: t.accuracy for run in sheet.runs for t in run.tracks if t.track == "right"}
    worst = sorted(scores, key=scores.get)
    assert found.judged is Judged.FAIL
    places = [found.reason.find(f"{name} at {scores[name]:.3f}") for name in worst]
    assert places[:5] == sorted(places[:5])
    assert min(places[:5]) > 0
    assert found.reason.endswith("; and 3 more")


@pytest.mark.slow
def test_fewer_runs_than_asked_for_leave_the_verdict_open(sheet_of, ten_runs):
    sheet = sheet_of(ten_runs[:9])
    found = criterion(sheet, "runs")
    assert (found.value, found.limit, found.judged) == (9, 10, Judged.MISSING)
    assert found.reason == "9 of the 10 runs that are asked for"
    assert criterion(sheet, "repeatability", "left").judged is Judged.PASS


@pytest.mark.slow
def test_a_run_that_cannot_be_used_is_named_and_does_not_count(sheet_of, ten_runs):
    bad = Run("torn", "torn.erd", (), None, "line 3 is cut short")
    runs = (bad, *(Run(f"run-{k}", "", (), p) for k, p in enumerate(ten_runs)))
    named = "not used: torn (line 3 is cut short)"
    enough, few = criterion(sheet_of(runs), "runs"), criterion(sheet_of(runs[:10]), "runs")
    assert (enough.judged, enough.value, enough.reason) == (Judged.PASS, 10, named)
    assert (few.judged, few.value) == (Judged.MISSING, 9)
    assert named in few.reason


def test_one_run_has_no_pairs_and_no_run_has_nothing(sheet_of, ten_runs):
    one, none = sheet_of(ten_runs[:1]), sheet_of(())
    assert criterion(one, "repeatability", "left").judged is Judged.MISSING
    assert criterion(one, "repeatability", "left").reason.startswith("it takes two runs")
    assert criterion(one, "accuracy", "left").judged is Judged.PASS
    assert {c.judged for c in none.criteria} == {Judged.MISSING, Judged.REPORTED}
    assert verdict_of(none.criteria) is Verdict.INCOMPLETE


def test_a_hole_beyond_the_share_fails_and_names_run_and_wheel_path(sheet_of, ten_runs, without):
    runs = (without(ten_runs[0], "left", 1000, 100), *ten_runs[1:3])
    found = criterion(sheet_of(runs), "coverage")
    assert found.judged is Judged.FAIL
    assert found.value == pytest.approx(100 * 5.0 / 200.05)
    assert found.reason == "without elevation: run-1, left: 5.0 m"


@pytest.mark.slow
def test_a_small_hole_and_flags_are_told_and_not_judged(sheet_of, ten_runs, without, reference):
    small = without(ten_runs[0], "left", 1000, 60)
    doubted = without(ten_runs[1], "right", 1000, 1000, flags_only=True)
    sheet = sheet_of(
        (small, doubted, ten_runs[2]), reference=without(reference, "left", 0, 20, flags_only=True)
    )
    assert criterion(sheet, "coverage").judged is Judged.PASS
    found = criterion(sheet, "flagged")
    assert (found.judged, found.value) == (Judged.REPORTED, pytest.approx(50.0))
    assert found.reason == "the reference, left: 1.0 m; run-2, right: 50.0 m; run-1, left: 3.0 m"


def test_an_average_that_lacks_a_run_is_not_complete(sheet_of, ten_runs, without):
    sheet = sheet_of((without(ten_runs[0], "left", 0, 4001), *ten_runs[1:3]))
    found = criterion(sheet, "accuracy", "left")
    assert found.judged is Judged.MISSING
    assert found.reason == "not in the average: run-1"
    assert criterion(sheet, "accuracy", "right").judged is Judged.PASS


@pytest.mark.slow
def test_the_bias_of_the_iri_is_reported_and_judged_where_a_limit_is_given(sheet_of, run_over):
    runs = tuple(run_over(seed, height=1.04) for seed in range(1, 4))
    free = criterion(sheet_of(runs), "iri-bias", "left")
    assert (free.judged, free.limit) == (Judged.REPORTED, None)
    assert free.value == pytest.approx(4.0, abs=0.5)
    strict = criterion(
        sheet_of(runs, CertificationLimits(iri_bias_percent=3.0)), "iri-bias", "left"
    )
    assert strict.judged is Judged.FAIL
    assert "run-2 +" in strict.reason
    low = tuple(run_over(seed, height=0.96) for seed in range(1, 4))
    below = criterion(sheet_of(low, CertificationLimits(iri_bias_percent=3.0)), "iri-bias", "left")
    assert below.judged is Judged.FAIL
    assert below.value < 0


def line(judged):
    return Criterion("a", "b", "c", 0.0, None, "", True, judged)


@pytest.mark.parametrize(
    ("judged", "verdict"),
    [
        ((), Verdict.INCOMPLETE),
        ((Judged.REPORTED,), Verdict.INCOMPLETE),
        ((Judged.PASS, Judged.REPORTED), Verdict.PASS),
        ((Judged.PASS, Judged.MISSING), Verdict.INCOMPLETE),
        ((Judged.PASS, Judged.MISSING, Judged.FAIL), Verdict.FAIL),
        ((Judged.MISSING, Judged.FAIL, Judged.REPORTED), Verdict.FAIL),
    ],
)
def test_a_failure_outweighs_what_is_missing_and_that_what_passed(judged, verdict):
    for order in permutations(judged):
        assert verdict_of(map(line, order)) is verdict


@pytest.mark.parametrize(
    ("numbers", "ids", "said"),
    [
        ({"distance": 1.01}, {"distance"}, "distance 1.0"),
        ({"height": 1.03}, {"height-scale"}, "heights 3"),
    ],
)
def test_the_one_run_with_an_error_of_scale_fails_and_is_named_with_it(
    sheet_of, ten_runs, run_over, numbers, ids, said
):
    sheet = sheet_of((*ten_runs[:2], run_over(3, **numbers), ten_runs[3]))
    named_causes = {cause.text for t in sheet.runs[2].tracks for cause in t.causes}
    assert any(text.startswith(said) for text in named_causes)
    assert not any(t.causes for k in (0, 1, 3) for t in sheet.runs[k].tracks)
    lines = [c for c in sheet.criteria if c.id in ids]
    assert {c.judged for c in lines} == {Judged.FAIL}
    assert all("run-3 +" in c.reason and "run-1 " not in c.reason for c in lines)
