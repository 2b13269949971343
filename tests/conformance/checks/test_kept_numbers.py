"""Numbers of a kept case that make no sense are refused by name, and not charged to the device."""

import json
from dataclasses import replace

import pytest
from click.testing import CliRunner

from floatref.errors import InputError
from floatref_conformance.case_files import document
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.sameness.invariance import InvarianceCheck
from floatref_conformance.checks.sameness.repeatability import RepeatabilityCheck
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.main import main
from floatref_conformance.judge.bench import make_taken
from floatref_conformance.plugins import load_registry

CHECKS = load_registry().checks
CASES = [*InvarianceCheck().cases(1, Effort.QUICK), *FaultsCheck().cases(1, Effort.QUICK)]
EVERYWHERE = ("encoder-rolling-back", "gnss-never-fixed")
"""Faults without a place: a vehicle rolls back where it stands."""
OWN = [
    (case, key)
    for case in CASES
    for key in case.variation
    if key != "at_m" or case.variation["fault"] not in EVERYWHERE
]
"""Their own numbers."""
SECOND = {"second_seed": 1, "second_speed_kmh": 60.0, "second_vehicle": "minivan"}
DRIVEN = [id_ for id_ in CHECKS if id_ not in ("quiescent", "bounce")]


def judged(bench, case, **scenario):
    slow = {"rate_hz": 1000.0, "tracks": ("left",), **scenario}
    return CHECKS[case.check].judge(
        replace(case, scenario=replace(case.scenario, **slow)), bench(augmented=True)
    )


def with_number(case, key, value):
    """Return the case with another value of its own, without that one for None."""
    others = {name: found for name, found in case.variation.items() if name != key}
    return replace(case, variation=others if value is None else {**others, key: value})


@pytest.mark.slow
@pytest.mark.parametrize(("case", "key"), OWN, ids=lambda part: getattr(part, "name", part))
@pytest.mark.parametrize("value", [None, "x", True, 1e300])
def test_a_number_that_is_missing_or_none_is_refused_by_its_name(right_bench, case, key, value):
    with pytest.raises(InputError, match=f"^variation {key} ") as caught:
        judged(right_bench, with_number(case, key, value))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("key", SECOND)
@pytest.mark.parametrize("value", [True, 1e300, -1e9, "x y"])
def test_a_second_pass_that_cannot_be_is_refused_by_its_name(right_bench, key, value):
    case = replace(RepeatabilityCheck().simplest, variation={**SECOND, key: value})
    with pytest.raises(InputError, match=f"^variation {key}: "):
        judged(right_bench, case)


def test_a_name_that_a_second_pass_does_not_have_is_refused(right_bench):
    with pytest.raises(
        InputError, match="variation second_sped_kmh: unknown; did you mean second_speed_kmh"
    ):
        judged(right_bench, with_number(RepeatabilityCheck().simplest, "second_sped_kmh", 60.0))


@pytest.mark.parametrize("id_", DRIVEN)
def test_a_parked_vehicle_is_refused_where_it_has_to_drive(right_bench, id_):
    with pytest.raises(InputError, match="manoeuvre quiescent"):
        judged(right_bench, CHECKS[id_].simplest, manoeuvre="quiescent")


@pytest.mark.parametrize("changes", [{"manoeuvre": "constant"}, {"speed_kmh": 1.0}])
@pytest.mark.parametrize("id_", ["quiescent", "bounce"])
def test_a_vehicle_that_drives_or_hardly_pretends_to_is_refused(right_bench, id_, changes):
    with pytest.raises(InputError, match=r"is parked|length_m is \d"):
        judged(right_bench, CHECKS[id_].simplest, **changes)


@pytest.mark.parametrize("id_", ["constant-speed", "waveband", "repeatability", "invariance"])
def test_a_drive_that_is_too_short_is_not_charged_to_the_device(right_bench, id_):
    with pytest.raises(InputError, match="must lie 106 m from"):
        judged(right_bench, CHECKS[id_].simplest, length_m=250.0)


def test_features_that_do_not_fit_into_a_drive_are_refused(right_bench):
    with pytest.raises(InputError, match="must lie 106 m from"):
        judged(right_bench, CHECKS["distance"].simplest, manoeuvre="constant", length_m=150.0)


@pytest.mark.slow
@pytest.mark.parametrize("id_", ["constant-speed", "invariance"])
def test_a_flat_road_has_no_iri_that_could_be_wrong(id_):
    class Flat:
        """Delivers the truth, which is flat."""

        def simulate(self, scenario):
            return make_taken(replace(scenario, rate_hz=1000.0, imu=False, gnss=False))

        def run(self, taken, label=""):
            return taken.truth

    case = CHECKS[id_].simplest
    level = replace(case.scenario, road="flat", bump_mm=0.0, profile_interval_m=0.025)
    with pytest.raises(InputError, match="flat"):
        CHECKS[id_].judge(replace(case, scenario=level), Flat())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "key"),
    [(InvarianceCheck().cases(1, Effort.QUICK)[0], "samples"), (FaultsCheck().simplest, "fault")],
)
def test_replay_names_file_and_key_in_one_line_and_exits_with_2(tmp_path, case, key):
    path = tmp_path / "kept.json"
    wrong = with_number(case, key, "many")
    path.write_text(json.dumps(document(wrong, DeviceClass.NOMINAL, "builtin:x", "wrong")))
    answer = CliRunner().invoke(main, ["replay", str(path), "--device", "mutant:all-zeros"])
    assert answer.exit_code == 2
    assert f"{path}: variation {key} " in answer.stderr
    assert len(answer.stderr.splitlines()) == 1
