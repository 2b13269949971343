"""A scenario file is read or refused in one line; its schema is that of the fields."""

from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from floatref.errors import InputError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.scenario_file import read_scenario, scenario_schema
from floatref_conformance.schemas import read_schema


def test_file_errors_name_the_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.json: No such file"):
        read_scenario(tmp_path / "none.json")
    broken = tmp_path / "broken.json"
    broken.write_text("{", encoding="utf-8")
    with pytest.raises(InputError, match=r"broken\.json: not JSON"):
        read_scenario(broken)
    broken.write_text('{"rate_hz": 1}', encoding="utf-8")
    with pytest.raises(InputError, match=r"broken\.json: rate_hz is 1"):
        read_scenario(broken)


@pytest.mark.parametrize("depth", [300, 100_000])
def test_nested_lists_are_refused_in_one_short_line(tmp_path: Path, depth: int) -> None:
    nested = tmp_path / "nested.json"
    for text in ("{}", '{{"tracks": {}}}', '{{"road": {}}}', '{{"seed": {}}}', '{{"format": {}}}'):
        nested.write_text(text.format("[" * depth + "]" * depth), encoding="utf-8")
        with pytest.raises(InputError, match=r"nested\.json: ") as caught:
            read_scenario(nested)
        assert len(str(caught.value)) < len(str(tmp_path)) + 200


def test_the_shipped_schema_is_that_of_the_fields() -> None:
    """`conformance scenario --json` writes it anew."""
    assert read_schema("floatref-scenario-2") == scenario_schema()


def test_every_field_has_a_meaning_and_a_default_that_keeps_its_limits() -> None:
    schema = scenario_schema()
    Draft202012Validator.check_schema(schema)
    assert set(schema["properties"]) == {f.name for f in fields(Scenario)} | {"format", "$schema"}
    assert all(f.metadata["meaning"] for f in fields(Scenario))
    defaults = {
        name: rule["default"] for name, rule in schema["properties"].items() if name[0] != "$"
    }
    Draft202012Validator(schema).validate(defaults)
    assert Scenario.from_dict(defaults) == Scenario()


@pytest.mark.parametrize(
    "wrong",
    [{"seed": 1.5}, {"rate_hz": 1}, {"manoeuvre": "fly"}, {"imu": 1}, {"tracks": []}, {"crown": 1}],
)
def test_what_the_schema_refuses_is_refused(wrong: Any) -> None:
    assert not Draft202012Validator(scenario_schema()).is_valid(wrong)
    with pytest.raises(InputError):
        Scenario.from_dict(wrong)
