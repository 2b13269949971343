"""`conformance certify` on ten simulated runs by a device of each class, beside `floatref compare`.

Ten drives over one road, each with errors and a speed of its own, are processed by a device of each
class; no pipeline claims class reference, for which the profiler without error stands. Of each
device the ten runs are certified against the truth, then again with one run whose encoder is 1 %
wrong, and with one whose heights are 3 % too large. Every correlation is compared with that of
`floatref compare` of the same two profiles.

    python tests/benchmarks/bench_certify.py [--runs N] [--folder DIR]
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from click.testing import CliRunner
from rich.console import Console
from rich.table import Table

from floatref.cli.main import main as floatref_command
from floatref.files import write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.interface import Taken
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.builtin import process_quietly
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

PERFECT = "without error"
DEVICES = {
    DeviceClass.NOMINAL: "road-prior-smoother",
    DeviceClass.ADEQUATE: "kalman-smoother-reflection",
    DeviceClass.REFERENCE: PERFECT,
}
SPEEDS_KMH = (40.0, 48.0, 56.0, 64.0, 72.0, 80.0, 88.0, 72.0, 56.0, 97.0)
LENGTH_M, SECTION = 400.0, "120:280.934:A1"
"""The section is 0.1 mile long, away from both ends of the drive."""
BAD = 3
"""Number of the run that is made wrong."""
DISTANCE_PERCENT, HEIGHT_PERCENT = 1.0, 3.0
COLUMNS = ("class", "device", "runs", "verdict", "accuracy", "repeat.", "pairs", "as compare")


def drive(number: int, encoder_error_percent: float = 0.0) -> Taken:
    """Return a drive over the road that all share; ``number`` draws the errors."""
    scenario = Scenario(
        seed=number,
        road_seed=5,
        speed_kmh=SPEEDS_KMH[number % len(SPEEDS_KMH)],
        length_m=LENGTH_M,
        response=False,
        encoder_error_percent=encoder_error_percent,
    )
    made = simulate(scenario)
    return Taken(made.recording, made.truth, scenario)


def measured(device: str, taken: Taken) -> Profile:
    """Return what ``device`` makes of a drive."""
    return make_perfect(taken) if device == PERFECT else process_quietly(taken.recording, device)


def higher(profile: Profile) -> Profile:
    """Return ``profile`` with heights that are `HEIGHT_PERCENT` too large."""
    factor = 1.0 + HEIGHT_PERCENT / 100.0
    tracks = (ProfileTrack.of(t.name, factor * t.elevation, t.valid) for t in profile.tracks)
    return replace(profile, tracks=tuple(tracks))


def certified(runs: list[Path], truth: Path, device_class: DeviceClass, report: Path) -> Any:
    """Return the worksheet that `conformance certify` writes of ``runs``."""
    words = ["certify", *map(str, runs), "--reference", str(truth), "--section", SECTION]
    words += ["--class", device_class.value, "--runs", str(len(runs)), "--report", str(report)]
    done = subprocess.run(
        [sys.executable, "-m", "floatref_conformance", *words], capture_output=True, text=True
    )
    if done.returncode not in (0, 1, 4):
        raise SystemExit(done.stderr)
    return json.loads((report / "worksheet.json").read_text(encoding="utf-8"))


def compared(reference: Path, profile: Path) -> dict[str, float]:
    """Return the cross correlations of `floatref compare`, by wheel path."""
    done = CliRunner().invoke(floatref_command, ["compare", str(reference), str(profile), "--json"])
    tracks = json.loads(done.stdout)["tracks"]
    return {track["name"]: track["cross_correlation"] for track in tracks}


def differences(worksheet: Any, report: Path) -> Iterator[float]:
    """Yield by how much each correlation of ``worksheet`` is not that of `floatref compare`."""
    (section,) = worksheet["sections"]
    names = [run["name"] for run in section["runs"]]
    folder = report / "runs" / section["name"]
    for j, run in enumerate(section["runs"]):
        with_truth = compared(report / "reference" / section["name"], folder / names[j])
        yield from (abs(with_truth[t["track"]] - t["accuracy"]) for t in run["tracks"])
        for i in range(j):
            pair = compared(folder / names[i], folder / names[j])
            yield from (abs(pair[t] - rows[i][j]) for t, rows in section["pairs"].items())


def main() -> None:
    """Print one row for each class and set of runs, then what the bad runs fail by."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--runs", type=int, default=10, help="drives [10]")
    options.add_argument("--folder", type=Path, help="keeps profiles and reports [none]")
    given = options.parse_args()
    if given.folder is not None:
        given.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        _print(given.runs, given.folder or Path(temporary), Console(width=110))


def _print(runs: int, folder: Path, console: Console) -> None:
    taken = [drive(number) for number in range(runs)]
    wrong = drive(BAD, DISTANCE_PERCENT)
    truth = folder / "truth"
    write_profile(taken[0].truth, truth)
    table, causes = Table(*COLUMNS), []
    for device_class, device in DEVICES.items():
        place = folder / device_class.value
        place.mkdir(parents=True)
        profiles = {f"run-{n}": measured(device, one) for n, one in enumerate(taken)}
        profiles["long"], profiles["high"] = measured(device, wrong), higher(profiles[f"run-{BAD}"])
        for name, profile in profiles.items():
            write_profile(profile, place / name)
        for bad in ("", "long", "high"):
            names = [bad if bad and n == BAD else f"run-{n}" for n in range(runs)]
            begun = time.perf_counter()
            report = place / f"report-{bad or 'good'}"
            found = certified([place / name for name in names], truth, device_class, report)
            took = time.perf_counter() - begun
            table.add_row(*_row(device_class, device, bad, found, report))
            causes += _causes(device_class, found)
            console.print(f"{device_class} {bad or 'good'}: {took:.1f} s", style="dim")
    console.print(table)
    for line in causes:
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def _row(device_class: DeviceClass, device: str, bad: str, found: Any, report: Path) -> list[str]:
    (section,) = found["sections"]
    values = {
        id_: min(one["value"] for one in section["criteria"] if one["id"] == id_)
        for id_ in ("accuracy", "repeatability")
    }
    apart = list(differences(found, report))
    worst = max(apart)
    return [
        device_class.value,
        device,
        f"one {bad}" if bad else "good",
        found["verdict"],
        f"{values['accuracy']:.4f}",
        f"{values['repeatability']:.4f}",
        str(len(apart)),
        "the same" if worst == 0 else f"{worst:.1e}",
    ]


def _causes(device_class: DeviceClass, found: Any) -> Iterator[str]:
    """Yield why runs do not agree, and why criteria failed."""
    (section,) = found["sections"]
    for run in section["runs"]:
        for track in run["tracks"]:
            for cause in track["causes"]:
                told = f"{cause['id']}: {cause['text']}"
                yield f"{device_class} {run['name']} {track['track']}: {told}"
    for one in section["criteria"]:
        if one["judged"] == "fail":
            yield f"{device_class} failed {one['id']} {one['track']}: {one['reason']}"


if __name__ == "__main__":
    main()
