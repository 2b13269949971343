"""From a plan to its worksheet: the numbers of `floatref compare`, and what stops or does not."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from floatref.errors import InputError
from floatref.files import write_profile, write_recording
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify import certifying
from floatref_conformance.certify.certifying import certify
from floatref_conformance.certify.judging.contents import RunSheet, Worksheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.plan.converting import convert_all
from floatref_conformance.certify.plan.cutting import within
from floatref_conformance.certify.plan.plan_document import (
    DistancePlan,
    Plan,
    Processing,
    SectionPlan,
    StationaryPlan,
)
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

pytestmark = pytest.mark.slow

CORRELATIONS = CertificationLimits(runs=2, distance_percent=None, height_percent=None)


def certified(plan: Plan, limits: CertificationLimits = CORRELATIONS, **how: Any) -> Worksheet:
    return certify(plan, Processing(**how), limits, DeviceClass.NOMINAL)


def section(folder: Path, *runs: str | Path, **more: Any) -> Plan:
    """Return the plan of one section over runs of `folder`, or of other places."""
    paths = tuple(folder / "runs" / run for run in runs)
    return Plan((SectionPlan("road", folder / "reference", paths, **more),))


def only(worksheet: Worksheet) -> RunSheet:
    (sheet,) = worksheet.sections
    (run,) = sheet.runs
    return run


def test_a_reference_that_cannot_be_read_ends_it(written: Path, tmp_path: Path) -> None:
    (tmp_path / "bad").mkdir()
    (tmp_path / "bad" / "profile.json").write_text("{")
    good = section(written, "run-1").sections[0]
    with pytest.raises(InputError, match=r"reference .*profile.json: not JSON"):
        certified(Plan((replace(good, reference=tmp_path / "bad"),)))


@pytest.mark.posix
def test_the_reference_is_no_run(written: Path, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(written / "reference")
    with pytest.raises(InputError, match="link: is the reference itself"):
        certified(section(written, "run-1", tmp_path / "link"))


def test_a_run_that_starts_elsewhere_is_moved_and_said(
    written: Path, ten_runs: tuple[Profile, ...], tmp_path: Path
) -> None:
    write_profile(replace(ten_runs[0], start_m=37.5), tmp_path / "late")
    run = only(certified(section(written, tmp_path / "late")))
    assert any("37.50 m farther along" in line for line in run.notes)
    assert min(track.accuracy for track in run.tracks) > 0.98


def test_what_was_said_of_a_reference_is_in_its_section(
    written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def with_warning(paths: Any, *rest: Any) -> Any:
        return {
            path: replace(one, notes=(f"warning of {path.name}",))
            for path, one in convert_all(paths, *rest).items()
        }

    monkeypatch.setattr(certifying, "convert_all", with_warning)
    (sheet,) = certified(section(written, "run-1")).sections
    assert sheet.reference_notes == ("warning of reference",)


def test_a_run_over_the_section_alone_is_taken_as_it_is(
    written: Path, ten_runs: tuple[Profile, ...], tmp_path: Path
) -> None:
    write_profile(within(ten_runs[0], 60.0, 140.0), tmp_path / "short")
    run = only(certified(section(written, tmp_path / "short", stretch_m=(60.0, 140.0))))
    assert (run.notes, run.error) == ((), "")
    assert max(track.missing_m for track in run.tracks) == 0.0


def test_a_run_the_other_way_in_millimetres_is_turned_and_said(
    written: Path, ten_runs: tuple[Profile, ...], tmp_path: Path
) -> None:
    left, right = (1000.0 * track.elevation[::-1] for track in ten_runs[0].tracks)
    tracks = (ProfileTrack.of("left", right), ProfileTrack.of("right", left))
    write_profile(replace(ten_runs[0], tracks=tracks), tmp_path / "back")
    run = only(certified(section(written, tmp_path / "back")))
    assert any("reversed" in line for line in run.notes)
    assert any("in mm" in line for line in run.notes)
    assert min(track.accuracy for track in run.tracks) > 0.98


def test_sections_share_what_is_read_and_progress_is_told(written: Path) -> None:
    one = section(written, "run-1", "run-2").sections[0]
    plan = Plan((one, replace(one, name="part", stretch_m=(50.0, 150.0))))
    warnings: list[tuple[str, float]] = []
    certify(
        plan, Processing(), CORRELATIONS, DeviceClass.NOMINAL, lambda *step: warnings.append(step)
    )
    parts = [done for _, done in warnings]
    assert parts == sorted(parts)
    assert (parts[0], parts[-1]) == (0.0, 1.0)
    assert sum(doing.startswith("read run-1") for doing, _ in warnings) == 1


def test_tests_at_rest_and_readings_are_judged_with_the_rest(
    written: Path, ten_runs: tuple[Profile, ...], tmp_path: Path
) -> None:
    still = replace(
        ten_runs[0],
        tracks=tuple(
            ProfileTrack.of(t.name, 1e-5 * t.elevation + k * 1e-7)
            for k, t in enumerate(ten_runs[0].tracks)
        ),
    )
    write_profile(still, tmp_path / "still")
    good = section(written, "run-1", "run-2")
    rest = StationaryPlan(tmp_path / "still", (50.0, 190.0))
    plan = replace(good, quiescent=rest, distance=DistancePlan(1000.0, (1000.1, 1000.2)))
    limits = replace(CORRELATIONS, distance_percent=0.15)
    assert certified(plan).verdict is Verdict.PASS
    shaken = replace(plan, bounce=StationaryPlan(written / "runs" / "run-3", (50.0, 190.0)))
    assert certified(shaken).verdict is Verdict.FAIL
    longer = replace(plan, distance=DistancePlan(1000.0, (1003.0, 1003.0)))
    assert certified(longer, limits).verdict is Verdict.FAIL


def test_recordings_are_processed_on_the_way(tmp_path: Path) -> None:
    drive = Scenario(road_seed=4, length_m=420.0, rate_hz=2000.0, imu=False, gnss=False)
    drive = replace(drive, response=False, profile_interval_m=0.05, sensors=0.3)
    for seed in (1, 2):
        made = simulate(replace(drive, seed=seed))
        write_recording(made.recording, tmp_path / f"run-{seed}")
    write_profile(made.truth, tmp_path / "truth")
    runs = tuple(tmp_path / f"run-{seed}" for seed in (1, 2))
    plan = Plan((SectionPlan("road", tmp_path / "truth", runs, (130.0, 290.9)),))
    worksheet = certified(plan, pipeline="temporal-matched-hpf")
    (sheet,) = worksheet.sections
    assert worksheet.verdict is Verdict.PASS
    for run in sheet.runs:
        assert run.error == ""
        assert run.notes[0] == "processed by temporal-matched-hpf"
        assert len(run.tracks) == 2
    assert sheet.pairs["left"][0, 1] > 0.98
