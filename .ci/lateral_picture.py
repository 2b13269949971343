"""Take the picture of docs/certify.md of agreement against the lateral separation of two runs.

    python .ci/lateral_picture.py

Five passes of the proving ground wander by 8 cm from each other and by 3 cm within a pass, at
70 km/h on a road of 2 m/km. Their positions are those of the simulated receiver.
"""

import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path

from terminal import browser_page, environment

from floatref import write_profile, write_recording
from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.scenario import repeat_passes

IMAGE = Path(__file__).parents[1] / "docs" / "images" / "certify-lateral.png"
TEXT = "Agreement of each pair against the distance between their lines."
DRIVE = Scenario(
    seed=77000,
    length_m=320.0,
    speed_kmh=70.0,
    iri_m_per_km=2.0,
    wander_m=0.08,
    wander_within_m=0.03,
    rate_hz=2000.0,
    profile_interval_m=0.0254,
    imu=False,
    response=False,
)
PLAN = """format = "conformance-plan/1"
profiler = "five passes that wander"

[[sections]]
name = "main"
reference = "reference"
runs = ["run-*"]
from_m = 70.0
to_m = 230.93
"""


def make_runs(folder: Path) -> None:
    """Write the plan, the road along the middle line, and the recordings of all passes."""
    (folder / "plan.toml").write_text(PLAN, encoding="utf-8")
    middle = replace(DRIVE, wander_m=0.0, wander_within_m=0.0)
    write_profile(simulate(middle).truth, folder / "reference")
    for number, drive in enumerate(repeat_passes(DRIVE, 5), 1):
        write_recording(simulate(drive).recording, folder / f"run-{number}")


def main() -> None:
    """Certify the passes, and take the picture of the worksheet."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_runs(folder)
        words = ["conformance", "certify", "--plan", "plan.toml", "--report", "report"]
        # The code tells that a criterion was not judged: nothing was parked here.
        subprocess.run(words, cwd=folder, env=environment(folder / ".cache"), check=False)
        with browser_page(1000) as opened:
            page = opened((folder / "report" / "worksheet.html").as_uri())
            page.locator("figure").filter(has_text=TEXT).screenshot(path=IMAGE)


if __name__ == "__main__":
    main()
