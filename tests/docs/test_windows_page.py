"""The page for Windows: its C# is that of the program, which compiles where there is a compiler."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from floatref import read_profile, write_recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "windows.md").read_text(encoding="utf-8")
PROGRAM = DOCS / "examples" / "csharp" / "RoadProfile.cs"


def test_what_the_page_shows_is_in_the_program() -> None:
    blocks = re.findall(r"^```csharp\n(.*?)^```$", PAGE, re.M | re.S)
    assert len(blocks) == 2
    source = PROGRAM.read_text(encoding="utf-8")
    for block in blocks:
        assert block in source


def test_it_says_that_nothing_was_run_there() -> None:
    assert "Nothing on this page was run on\nWindows" in PAGE


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("mcs") is None, reason="there is no compiler of C# (mono-mcs)")
def test_the_program_reads_what_the_command_writes(tmp_path: Path) -> None:
    library = "-r:System.Runtime.Serialization"
    program = tmp_path / "RoadProfile.exe"
    subprocess.run(["mcs", "-warnaserror", library, f"-out:{program}", PROGRAM], check=True)
    scenario = Scenario(length_m=200.0, rate_hz=1000.0, imu=False, gnss=False, response=False)
    write_recording(simulate(scenario).recording, tmp_path / "run")
    command = ["mono", program, Path(sys.executable).with_name("floatref")]
    made = subprocess.run(
        [*command, "run", "profile"], cwd=tmp_path, capture_output=True, text=True
    )
    assert made.returncode == 0, made.stderr
    profile = read_profile(tmp_path / "profile")
    for line, track in zip(made.stdout.splitlines(), profile.tracks, strict=True):
        assert line.startswith(f"{track.name}: IRI ")
        assert line.endswith(f", {track.elevation.size} points")
    refused = subprocess.run(
        [*command, "nothing", "p"], cwd=tmp_path, capture_output=True, text=True
    )
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr.startswith("Error: nothing: not found")
