"""Pages name all there is: commands, settings, columns, checks, devices, formats and decisions."""

import re
from pathlib import Path

import click
import numpy as np
import pytest

import floatref
from floatref import Profile, ProfileTrack
from floatref.batch.jobs.manifest import COLUMNS as MANIFEST_COLUMNS
from floatref.batch.results.positions import LONGEST_GAP_S
from floatref.batch.results.summary import COLUMNS
from floatref.cli.allan.allan_report import SETTINGS
from floatref.cli.main import main as floatref_command
from floatref.engine.plugins import plugins
from floatref_adapters.formats.erd.erd_header import parse_header
from floatref_adapters.formats.erd.erd_profile import Erd
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.cli.main import main as conformance_command
from floatref_conformance.judge.trial import MOST_HANGS
from floatref_conformance.plugins import load_registry

DOCS = Path(__file__).parents[2] / "docs"
PAGES = "allan", "batch", "commands", "conformance", "profile-formats"
ALLAN, BATCH, COMMANDS, JUDGE, FORMATS = (
    (DOCS / f"{name}.md").read_text(encoding="utf-8") for name in PAGES
)


def test_the_page_on_noise_names_every_setting_with_its_coefficient_and_channel() -> None:
    rows = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| \$([NK])\$, .+ \| (.+) \|$", ALLAN, re.M)
    symbols = {name: symbol for names, symbol, _ in rows for name in re.findall(r"`(\w+)`", names)}
    expected = {"white_noise": "N", "random_walk": "K"}
    assert symbols == {name: expected[term] for name, (_, term) in SETTINGS.items()}


def test_every_column_of_the_summary_is_explained_in_order() -> None:
    table = BATCH.partition("## What a row says")[2].partition("\n\n`summary.parquet`")[0]
    cells = re.findall(r"^\| (`.+?) \| .* \|$", table, re.MULTILINE)
    assert re.findall(r"`(\w+)`", " ".join(cells)) == list(COLUMNS)
    assert f"gaps of more than {LONGEST_GAP_S:g} s" in table


def test_the_columns_of_a_manifest_are_those_that_are_read() -> None:
    (said,) = re.findall(r"a column (`file`.+?)\. Paths", BATCH, re.DOTALL)
    assert tuple(re.findall(r"`(\w+)`", said)) == MANIFEST_COLUMNS


def test_every_check_has_its_place_in_the_table():
    table = JUDGE[JUDGE.index("| check |") : JUDGE.index("`conformance list` names")]
    assert re.findall(r"`([a-z-]+)`", table) == list(IDS)


def test_every_kind_of_device_is_shown():
    kinds = load_registry().kinds
    assert kinds.keys() >= {"builtin", "exec", "python", "files", "mutant"}
    for kind in kinds.values():
        assert f"| `{kind.usage}` |" in JUDGE, kind.usage


def test_exit_codes_are_those_of_the_verdicts():
    for verdict in Verdict:
        shown = re.search(rf"\*\*{verdict.value}\*\* \((?:exit code )?(\d)", JUDGE)
        assert shown is not None
        assert int(shown[1]) == verdict.exit_code


def test_the_number_of_hangs_is_the_judges():
    assert MOST_HANGS == 3
    assert "after three hangs" in " ".join(JUDGE.split())


SHOWN = re.findall(r"^<!-- help: (.+) -->$", COMMANDS, re.M)


@pytest.mark.parametrize(
    ("name", "group"), [("floatref", floatref_command), ("conformance", conformance_command)]
)
def test_every_command_is_shown(name: str, group: click.Group) -> None:
    names = [f"{name} {command}" for command in group.list_commands(click.Context(group))]
    assert [shown for shown in SHOWN if shown.split()[0] == name] == [name, *names]


def test_every_public_name_is_in_the_api() -> None:
    page = (DOCS / "api" / "index.md").read_text(encoding="utf-8")
    for name in floatref.__all__:
        assert name == "__version__" or f"[`{name}`][floatref." in page, name


def test_every_decision_is_listed_and_in_the_site() -> None:
    index = (DOCS / "decisions" / "index.md").read_text(encoding="utf-8")
    site = (DOCS.parent / ".mkdocs.yml").read_text(encoding="utf-8")
    for record in (DOCS / "decisions").glob("0*.md"):
        assert f"({record.name})" in index
        assert f"decisions/{record.name}" in site


(EXAMPLE,) = re.findall(
    r"^```text\n(ERD.*?)^```$", (DOCS / "erd.md").read_text(encoding="utf-8"), re.M | re.S
)


def test_the_table_has_every_format_with_its_suffix() -> None:
    table = [
        [cell.strip(" `") for cell in line.split("|")[2:-1]]
        for line in FORMATS.splitlines()
        if line.startswith(("| | `", "| suffix |"))
    ]
    known = plugins().profile_formats().values()
    assert table == [[f.name for f in known], [f.suffix or "no suffix" for f in known]]


def test_the_example_is_what_is_written(tmp_path: Path) -> None:
    shown = EXAMPLE.splitlines()
    count = int(shown[1].split(",")[1])
    left, right = np.zeros(count), np.zeros(count)
    left[:2], right[:2] = (-0.0010431, -0.0010512), (-0.0008210, -0.0008196)
    tracks = (ProfileTrack.of("left", left, np.arange(count) > 0), ProfileTrack.of("right", right))
    path = tmp_path / "run.erd"
    Erd().write(Profile(0.00508, tracks, pipeline="temporal-basic"), path)
    written = path.read_text("ascii").splitlines()
    assert [line.rstrip() for line in written[: len(shown)]] == shown


def test_the_example_is_read() -> None:
    header = parse_header(EXAMPLE.encode())
    assert [channel.short for channel in header.channels] == ["LElev", "LValid", "RElev"]
    assert (header.step, header.start, header.key) == (0.00508, 0.0, 5)
