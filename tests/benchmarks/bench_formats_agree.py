"""Print whether a stop is the same profile through every native format as from its directory.

The run sg_10.7s_0.20g is simulated, written in each format that can hold a whole recording, and
read back through a channel map that `floatref channels --draft-map` drafted. Once as it is, in
float64; once in the quanta of a logger, stored as integers where the format has them. Beside the
difference in elevation stands the propagated quantum: by how much at most a dither of half a
quantum, drawn anew and put onto the recording itself, moves the profile. Run as
``python tests/benchmarks/bench_formats_agree.py [--pipeline temporal-basic]``.
"""

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from kind_drives import KIND

from floatref import Profile, Recording, process, read_native
from floatref.engine.recordings.readers import native_of, reader_of
from floatref.mapping.draft.drafting import draft_map
from floatref.measures import iri
from floatref_adapters.testing import WRITERS
from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate

RUN = "sg_10.7s_0.20g"
QUANTA = {"vertical_specific_force": 1e-3, "height": 1e-5, "distance": 1e-4}
"""Of 16 bits over ±3 g, of a laser of 10 µm, and of decimals of a distance."""
DITHERS = 5


def mapped(path: Path) -> Recording:
    """Return the recording in ``path`` through a drafted map beside it."""
    reader = reader_of(path, None)
    with native_of(reader, path, {}) as native:
        text = draft_map(native, path, reader.name)
    chart = path.with_suffix(".toml")
    chart.write_text(text, encoding="utf-8")
    return read_native(path, chart).recording


def dithered(recording: Recording, seed: int) -> Recording:
    """Return ``recording`` with up to half a quantum on every sample."""
    draw = np.random.default_rng(seed)
    channels = []
    for channel in recording.channels:
        half = QUANTA[channel.id.name] / 2
        noise = draw.uniform(-half, half, channel.values.size)
        # An encoder that goes back by a tenth of a millimetre would be another fault.
        values = np.maximum.accumulate(channel.values + noise)
        keep = channel.id.name == "distance"
        channels.append(replace(channel, values=values if keep else channel.values + noise))
    return replace(recording, channels=tuple(channels))


def farthest(profile: Profile, reference: Profile) -> float:
    """Return the largest difference in elevation in m, both wheel paths taken together."""
    return max(
        float(np.nanmax(np.abs(track.elevation - reference.track(track.name).elevation)))
        for track in profile.tracks
    )


def iri_off(profile: Profile, reference: Profile) -> float:
    """Return the largest difference in IRI in per cent."""
    return max(
        100 * abs(iri(track.elevation, profile.interval_m) / iri(there, profile.interval_m) - 1)
        for track in profile.tracks
        for there in (reference.track(track.name).elevation,)
    )


def nominal(recording: Recording) -> Recording:
    return replace(recording, channels=tuple(c for c in recording.channels if c.id.name in QUANTA))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pipeline", default="temporal-basic")
    pipeline = parser.parse_args().pipeline
    recording = nominal(simulate(scenario_of_run(RUN, **KIND)).recording)
    reference = process(recording, pipeline)
    moved = max(
        farthest(process(dithered(recording, seed), pipeline), reference) for seed in range(DITHERS)
    )
    print(f"{RUN}, {pipeline}: propagated quantum {1e6 * moved:.3g} um")
    print("format    MB  float64: um  IRI %   quanta: MB  um  of the quantum  IRI %")
    with tempfile.TemporaryDirectory() as folder:
        for suffix, write in WRITERS.items():
            row = []
            for quanta in (None, QUANTA):
                path = Path(folder) / f"run{'' if quanta is None else '-quanta'}{suffix}"
                write(recording, path, quanta)
                profile = process(mapped(path), pipeline)
                off = farthest(profile, reference)
                row.append((path.stat().st_size / 1e6, off, iri_off(profile, reference)))
            (size, off, iri_), (size_q, off_q, iri_q) = row
            print(
                f"{suffix:8s} {size:5.1f} {1e6 * off:8.3g} {iri_:8.4f} {size_q:8.1f} "
                f"{1e6 * off_q:8.3g} {off_q / moved:8.2f} {iri_q:8.4f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
