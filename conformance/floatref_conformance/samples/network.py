"""Sample of a network: five short recordings in two folders, with a stop and a damaged file."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from floatref.files import write_recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

LENGTH_M = 500.0
DRIVE = Scenario(length_m=LENGTH_M, rate_hz=4000.0, imu=False, response=False)
DRIVES = {
    "north/run-1": replace(DRIVE, iri_m_per_km=1.2),
    "north/run-2": replace(DRIVE, iri_m_per_km=2.4),
    "south/run-3": replace(DRIVE, manoeuvre="stop"),
    "south/run-4": replace(DRIVE, iri_m_per_km=1.6, crown_mm=40.0),
    "south/run-10": replace(DRIVE, iri_m_per_km=3.2),
}
"""What is driven, by the name of the recording; each on a road of its own."""
DAMAGED = "south/run-4"
CUT = "left.height.f64"


def write_network(folder: Path, seed: int, report: Callable[[str], None]) -> None:
    """Write the sample into ``folder``, an empty one; ``report`` is called with each part's name.

    The second half of one file of `DAMAGED` is missing, as after a copy that broke off.
    """
    for number, (name, drive) in enumerate(DRIVES.items()):
        report(name)
        place = folder / name
        place.parent.mkdir(exist_ok=True)
        write_recording(simulate(replace(drive, seed=seed + number)).recording, place)
    cut = folder / DAMAGED / CUT
    content = cut.read_bytes()
    cut.write_bytes(content[: len(content) // 2])
