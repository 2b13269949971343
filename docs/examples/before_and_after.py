"""Both engines at a stop, as they are and with every change of their pages, by one command each.

`python docs/examples/before_and_after.py temporal_engine`, or `spatial_engine`, drives a simulated
van over the stop of run sg_5.8s_0.20g, makes the record that the engine reads, applies each change
of its README.md to a copy, and prints what comes out. It needs git, and `conformance` installed.
"""

import argparse
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from floatref import InputError, Profile, ProfileTrack, read_recording, short_interval_roughness
from floatref_reference.chapter_5.section_5_8 import captured

HERE = Path(__file__).parent
RUN, G = "sg_5.8s_0.20g", 9.80665
RATE_HZ, SPACING_M, PULSE_M = 4000.0, 0.024, 0.0003
ENDS_M = 60.0
"""At both ends of a run no filter has settled."""


def drive():
    """Return acceleration, height and distance of one wheel path over the stop, in SI units."""
    scenario = {"format": "floatref-scenario/2", "manoeuvre": RUN, "iri_m_per_km": 1.8}
    scenario |= {"imu": False, "gnss": False, "tracks": ["main"], "rate_hz": RATE_HZ}
    with tempfile.TemporaryDirectory() as folder:
        case, run = Path(folder, "case.json"), Path(folder, "run")
        case.write_text(json.dumps(scenario), encoding="utf-8")
        simulate = (sys.executable, "-m", "floatref_conformance", "simulate", case, "--out", run)
        subprocess.run(simulate, check=True, stdout=subprocess.DEVNULL)
        recording = read_recording(run)
        names = (("vertical_specific_force", "main"), ("height", "main"), ("distance", None))
        force, height, distance = (np.array(recording.channel(*name).values) for name in names)
    return force - G, height, distance


def changes(name):
    """Return the changes of an engine's page by heading."""
    page = (HERE / name / "README.md").read_text(encoding="utf-8")
    return dict(re.findall(r"^## ([^\n]+)\n.*?^```diff\n(.*?)^```$", page, re.M | re.S))


def make_engine(name, folder, heading=None):
    """Return the engine as a module, in ``folder``, with the change under ``heading`` if given."""
    file = folder / "engine.py"
    file.write_bytes((HERE / name / "engine.py").read_bytes())
    if heading is not None:
        (folder / "change.patch").write_text(changes(name)[heading], encoding="utf-8", newline="\n")
        alone = {**os.environ, "GIT_CEILING_DIRECTORIES": str(folder.parent)}
        subprocess.run(["git", "apply", "change.patch"], cwd=folder, env=alone, check=True)
    spec = importlib.util.spec_from_file_location("engine", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def temporal_record(engine, driven):
    """Return the record of ``driven`` that the temporal engine reads."""
    acceleration, height, distance = driven
    record = np.empty(height.size, engine.SAMPLE)
    record["accel_g"], record["range_mm"] = 1.0 + acceleration / G, 1000.0 * height
    record["pulses"] = np.round(distance / PULSE_M) - round(distance[0] / PULSE_M)
    return record


def spatial_record(driven):
    """Return the lines of ``driven`` that the spatial engine reads."""
    acceleration, height, step = (x.astype(float) for x in captured(*driven, RATE_HZ, SPACING_M))
    timer = np.round(1e6 * np.cumsum(step)).astype(int)
    columns = timer.tolist(), (1e4 * acceleration).tolist(), (1e6 * height).tolist()
    return [f"{t},{a!r},{h!r}" for t, a, h in zip(*columns, strict=True)]


def profile_of(name, engine, driven):
    """Return the profile of an engine in m."""
    temporal = name == "temporal_engine"
    record = temporal_record(engine, driven) if temporal else spatial_record(driven)
    return 0.001 * engine.run(record)


def figures(profile):
    """Return peak of the roughness and IRI in m/km, without the ends of the run."""
    ends = round(ENDS_M / SPACING_M)
    inner = profile[ends:-ends]
    whole = Profile(SPACING_M, (ProfileTrack.of("main", inner),)).iri()["main"]
    return short_interval_roughness(inner, SPACING_M).max(), whole.all_m_per_km


def main():
    """Print the figures of the engine as it is, and with each change."""
    parser = argparse.ArgumentParser(description="Both engines at a stop, before and after.")
    parser.add_argument("engine", choices=("temporal_engine", "spatial_engine"))
    name = parser.parse_args().engine
    driven = drive()
    print(f"{f'{name}, run {RUN}':<45} peak m/km  IRI m/km")
    for heading in (None, *changes(name)):
        with tempfile.TemporaryDirectory() as folder:
            profile = profile_of(name, make_engine(name, Path(folder), heading), driven)
        peak, roughness = figures(profile)
        print(f" {heading or 'as it is':<44} {peak:9.1f} {roughness:9.2f}")


if __name__ == "__main__":
    try:
        main()
    except (InputError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"Error: {error}")
    except KeyboardInterrupt:
        print("Interrupted", file=sys.stderr)
        sys.exit(130)
