"""Where every command reads or writes a file that somebody else may have made.

A key is a command and one of its parameters, as `named_places` finds them in the real groups; the
words call the command with `{x}` in that place. `{run}`, `{csv}`, `{profile}` and `{report}` are
sound files, `{out}` is a new name. `test_attacks.py` holds the lists complete.
"""

from collections.abc import Iterator

import click

from floatref.cli.main import main as floatref
from floatref_conformance.cli.main import main as conformance

READ = {
    "floatref process source": "process {x} --out {out}",
    "floatref process --map": "process {csv} --map {x} --out {out}",
    "floatref process --settings": "process {run} --settings {x} --out {out}",
    "floatref iri profile": "iri {x}",
    "floatref iri --recording": "iri {profile} --gis {out}.geojson --recording {x}",
    "floatref iri --map": "iri {profile} --gis {out}.geojson --recording {csv} --map {x}",
    "floatref roughness profile": "roughness {x}",
    "floatref roughness --recording": "roughness {profile} --gis {out}.geojson --recording {x}",
    "floatref roughness --map": (
        "roughness {profile} --gis {out}.geojson --recording {csv} --map {x}"
    ),
    "floatref straightedge profile": "straightedge {x}",
    "floatref compare reference": "compare {x} {profile}",
    "floatref compare profile": "compare {profile} {x}",
    "floatref view sources": "view {x} --out {out}.html",
    "floatref view --recording": "view {profile} --recording {x} --out {out}.html",
    "floatref view --map": "view {csv} --map {x} --out {out}.html",
    "floatref plot source": "plot {x} --out {out}.png",
    "floatref plot --map": "plot {csv} --map {x} --out {out}.png",
    "floatref convert source": "convert {x} --out {out}.csv",
    "floatref convert --map": "convert {csv} --map {x} --out {out}.mcap",
    "floatref pipelines recording": "pipelines {x}",
    "floatref pipelines --map": "pipelines {csv} --map {x}",
    "floatref channels file": "channels {x}",
    "floatref channels --dbc": "channels {can} --dbc {x}",
    "floatref allan recording": "allan {x}",
    "floatref live --follow": "live --follow {x} --out {out}",
    "floatref live --token-file": "live --listen 0 --token-file {x} --out {out}",
    "floatref tune recordings": "tune {x} --reference {profile} --out {out}.json",
    "floatref tune --reference": "tune {run} --reference {x} --out {out}.json",
    "floatref tune --settings": (
        "tune {run} --reference {profile} --settings {x} --out {out}.json"
    ),
    "floatref vehicle profiles": "vehicle {x} --out {out}.json",
    "floatref vehicle --slip": "vehicle --slip {x} {run} --out {out}.json",
    "conformance run --waive": "run --check quiescent --waive {x}",
    "conformance submit --waive": "submit --check quiescent --waive {x} --out {out}.zip",
    "conformance submit --device-file": (
        "submit --check quiescent --device-file {x} --out {out}.zip"
    ),
    "conformance submit --statement": "submit --check quiescent --statement {x} --out {out}.zip",
    "conformance submit --sign": "submit --check quiescent --sign {x} --out {out}.zip",
    "conformance verify archive": "verify {x}",
    "conformance verify --signers": "verify {csv} --signers {x}",
    "conformance verify --device-file": "verify {csv} --device-file {x}",
    "conformance simulate run": "simulate {x}.json --out {out}",
    "conformance replay case": "replay {x} --device builtin:temporal-basic",
    "conformance matrix reports": "matrix {report} {x}",
    "conformance certify --plan": "certify --plan {x}",
    "conformance certify --practice": "certify {profile} --reference {profile} --practice {x}",
    "conformance practices name": "practices {x}",
    "conformance certify --settings": (
        "certify {run} --reference {profile} --section 0:100 --settings {x}"
    ),
    "conformance certify --map": "certify {run} --reference {profile} --section 0:100 --map {x}",
    "conformance certify runs": "certify {x} {x} --reference {profile} --section 0:100",
    "conformance certify --reference": "certify {profile} --reference {x} --section 0:100",
}
TEXTS = {
    "conformance certify --practice",
    "conformance practices name",
    "conformance simulate run",
    "conformance certify runs",
    "conformance certify --reference",
}
"""Those of a parameter that is not declared as a path, but may be one."""
WRITTEN = {
    "floatref process --out": "process {run} --out {x}",
    "floatref process --plot": "process {run} --out {out} --plot {x}.png",
    "floatref iri --gis": "iri {profile} --recording {run} --gis {x}.geojson",
    "floatref roughness --gis": "roughness {profile} --recording {run} --gis {x}.geojson",
    "floatref compare --plot": "compare {profile} {profile} --plot {x}.png",
    "floatref view --out": "view {profile} --out {x}.html",
    "floatref plot --out": "plot {profile} --out {x}.png",
    "floatref convert --out": "convert {profile} --out {x}.csv",
    "floatref channels --map": "channels {csv} --map {x}",
    "floatref allan --settings": "allan {run} --settings {x}",
    "floatref allan --plot": "allan {run} --plot {x}.png",
    "floatref tune --out": "tune {run} --reference {profile} --out {x}",
    "floatref tune --plot": "tune {run} --reference {profile} --out {out}.json --plot {x}.png",
    "floatref live --out": "live --out {x}",
    "floatref vehicle --out": "vehicle {profile} --out {x}",
    "conformance run --report": "run --check quiescent --report {x}",
    "conformance simulate --out": "simulate const_16 --out {x}",
    "conformance simulate --truth": "simulate const_16 --out {out} --truth {x}",
    "conformance submit --out": "submit --check quiescent --out {x}",
    "conformance matrix --out": "matrix {report} --out {x}.html",
    "conformance sample --out": "sample --out {x} network",
    "conformance export --out": "export --out {x}",
    "conformance certify --report": "certify {profile} --reference {profile} --report {x}",
    "conformance table --plot": "table --plot {x}.png",
    "conformance faults --out": "faults --out {x}",
}
ELSEWHERE = {
    "floatref batch": "tests/sdk/batch: it writes a failure of a file as a row, on workers",
}
"""Commands that other tests attack, and where."""


def named_places() -> Iterator[str]:
    """Yield command and parameter for every path that a command of the real groups takes."""
    for program, group in (("floatref", floatref), ("conformance", conformance)):
        for name in group.list_commands(click.Context(group)):
            command = group.get_command(click.Context(group), name)
            assert command is not None
            for parameter in command.params:
                if isinstance(parameter.type, click.Path) or _is_tuple_of_paths(parameter.type):
                    yield f"{program} {name} {_name(parameter)}"


def _is_tuple_of_paths(kind: object) -> bool:
    types = getattr(kind, "types", ())
    return any(isinstance(each, click.Path) for each in types)


def _name(parameter: click.Parameter) -> str:
    if isinstance(parameter, click.Option):
        return max(parameter.opts, key=len)
    return str(parameter.name)
