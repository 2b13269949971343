"""`conformance scenario`: every key with its default, as a table and as a schema."""

import json
from dataclasses import fields

from click.testing import CliRunner

from floatref_conformance.cli.scenario import scenario
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.scenario_file import scenario_schema


def test_every_key_is_listed_with_its_default() -> None:
    result = CliRunner().invoke(scenario, env={"COLUMNS": "200"})
    assert result.exit_code == 0, result.output
    rows = {line.split()[0]: line for line in result.output.splitlines() if line.strip()}
    for field in fields(Scenario):
        default = list(field.default) if isinstance(field.default, tuple) else field.default
        assert json.dumps(default) in rows[field.name]
    assert "-300 to 300" in rows["crown_mm"]


def test_the_schema_is_printed_whole() -> None:
    result = CliRunner().invoke(scenario, ["--json"])
    assert json.loads(result.output) == scenario_schema()
