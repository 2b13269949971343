"""`conformance scenario`: the keys of a scenario file, with their defaults and limits."""

import json

import click


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print the JSON Schema.")
def scenario(as_json: bool) -> None:
    """List the keys of a scenario file, with default, limits and meaning.

    A scenario file is one JSON object; a key that it lacks has its default.
    """
    from floatref_conformance.proving_ground.scenario_file import scenario_schema

    schema = scenario_schema()
    if as_json:
        click.echo(json.dumps(schema, indent=2, ensure_ascii=False))
        return
    from rich.console import Console
    from rich.table import Table

    table = Table("key", "default", "limits", "meaning", box=None)
    for key, rule in schema["properties"].items():
        if "description" in rule:
            default = json.dumps(rule["default"])
            table.add_row(key, default, describe_limits(rule), rule["description"])
    Console().print(table, markup=False)


def describe_limits(rule: dict[str, object]) -> str:
    """Return the limits or the names that the schema of one key allows."""
    if "minimum" in rule:
        return f"{rule['minimum']:g} to {rule['maximum']:g}"
    names = rule.get("enum") or rule.get("examples") or ()
    assert isinstance(names, list | tuple)
    return ", ".join(names)
