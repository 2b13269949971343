"""How much the road-prior smoother depends on each of its constants.

A few recordings, simulated once, are processed with the defaults and with each constant smaller and
larger, and compared with the road under the laser as in `bench_road_prior_limits.py`. Run as

    python tests/benchmarks/bench_road_prior_sensitivity.py [--only CONSTANT...] [--json FILE]
        [--page FILE]
"""

import argparse
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from kind_drives import KIND
from road_prior_adversities import STOP, Adversity, stop
from road_prior_changes import crack, injured
from road_prior_measuring import OURS, Found, compared, quietly, simulated
from tables import show, write_page

from floatref.builtin_pipelines.road_prior import CONSTANTS, EXPECTED, ROAD_PRIOR
from floatref_conformance.proving_ground.drives.runs import RUNS, SECTION_START_M
from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import Simulation

RATE_HZ, SLOW_RATE_HZ = 8000.0, 4000.0
CREEP_M = 250.0
ASPHALT = "sayers-asphalt-long-waves"
FACTORS: Mapping[str, tuple[float, float]] = {
    "pitch_hz": (1 / 1.5, 1.5),
    "pitch_damping": (1 / 3, 2.0),
}
USUAL_FACTORS = 1 / 3, 3.0
"""For constants that are not in `FACTORS`."""
USUAL = "defaults"
COLUMNS = (
    *("constant", "value", "lowest", "median", "largest loss", "of"),
    *("largest IRI error, %", "within 2 sigma, %", "fewest, %"),
)


@dataclass(frozen=True)
class Row:
    """What one value of one constant comes to; its name is "defaults" where none was changed.

    Attributes:
        constant: its name.
        value: what it is set to.
        factor: how many times the default that is.
        cases: how each wheel path compares, by the name of the case.
    """

    constant: str
    value: float
    factor: float
    cases: Mapping[str, tuple[Found, ...]]

    @property
    def lowest(self) -> Mapping[str, float]:
        """Lowest cross correlation of each case."""
        return {n: min(f.cross_correlation for f in each) for n, each in self.cases.items()}

    def summary(self, usual: "Row") -> dict[str, Any]:
        """Return plain figures; ``usual`` is the row of the defaults."""
        found = [each for case in self.cases.values() for each in case]
        lowest = self.lowest
        losses = {name: usual.lowest[name] - own for name, own in lowest.items()}
        case = max(losses, key=lambda name: losses[name])
        fewest = {n: min(f.within_percent for f in each) for n, each in self.cases.items()}
        figures = {
            "lowest": min(lowest.values()),
            "median": float(np.median([f.cross_correlation for f in found])),
            "largest_loss": losses[case],
            "iri_error_percent": max((f.iri_error_percent for f in found), key=abs),
            "within_percent": float(np.median([f.within_percent for f in found])),
            "fewest_percent": min(fewest.values()),
        }
        row: dict[str, Any] = {"constant": self.constant, "value": self.value}
        row |= {"factor": self.factor, "of": case}
        row["fewest_of"] = min(fewest, key=lambda name: fewest[name])
        row |= {name: round(figure, 4) for name, figure in figures.items()}
        return row | {"cases": {name: round(each, 4) for name, each in lowest.items()}}


def of_run(name: str) -> Adversity:
    place = RUNS[name].event_location_m
    assert place is not None
    scenario = scenario_of_run(name, imu=False, gnss=False, **KIND)
    return Adversity(name, "", scenario, SECTION_START_M + place)


def cases() -> Iterator[Adversity]:
    """Yield what is driven: each its own severity of one kind."""
    yield from map(of_run, ("sg_2.1s_0.33g", "sg_10.7s_0.20g", "brk_49-34_0.84g"))
    speeds = {"speed_kmh": 4.0, "event_speed_kmh": 5.0, "length_m": CREEP_M}
    creep = stop(manoeuvre="creeping", rate_hz=SLOW_RATE_HZ, **speeds)
    yield Adversity("creeping", "4 to 5 km/h", creep, CREEP_M / 2)
    soft = stop(vehicle="soft-van", deceleration_g=0.3, road=ASPHALT)
    yield Adversity("soft-van", "0.3 g", soft)
    slow = {"speed_kmh": 31.0, "final_speed_kmh": 31.0, "dwell_s": 1.5, "deceleration_g": 0.26}
    yield Adversity(
        "pickup", "0.26 g", stop(vehicle="pickup", road=ASPHALT, iri_m_per_km=0.8, **slow)
    )
    yield Adversity("edge", "5 mm", STOP, road=crack(5.0))
    gap = injured("accelerometer-dropout", 0.5, ahead_m=8.0)
    yield Adversity("no acceleration", "0.5 s", STOP, change=gap)


def driven(case: Adversity) -> Simulation:
    """Return the run of ``case`` at no more than `RATE_HZ`."""
    slower = replace(case.scenario, rate_hz=min(case.scenario.rate_hz, RATE_HZ))
    return simulated(replace(case, scenario=slower), 0)


def label(case: Adversity) -> str:
    return f"{case.kind}, {case.severity}".rstrip(", ")


def values(only: tuple[str, ...]) -> Iterator[tuple[str, float, float]]:
    """Yield name, value and factor of what is changed."""
    (pipeline,) = (each for each in ROAD_PRIOR if each.name == OURS)
    # What is vouched for changes no elevation, and nothing is expected of the vehicle.
    for name in [each for each in CONSTANTS if each not in ("most_sigma_share", *EXPECTED)]:
        for factor in FACTORS.get(name, USUAL_FACTORS):
            if name.startswith(only or ("",)):
                yield name, factor * pipeline.settings[name], factor


def measured(
    made: Mapping[str, tuple[Simulation, float]], name: str, value: float, factor: float
) -> Row:
    found = {}
    settings = {name: value} if name in CONSTANTS else {}
    for case, (simulation, where_m) in made.items():
        profile = quietly(simulation.recording, OURS, settings)
        found[case] = tuple(compared(simulation, profile, where_m))
    return Row(name, value, factor, found)


def cells(row: Mapping[str, Any]) -> list[str]:
    line = [f"`{row['constant']}`", f"{row['value']:.3g} ({row['factor']:.2g} ×)"]
    if row["constant"] == USUAL:
        line = [USUAL, ""]
    line += [f"{row[name]:.3f}" for name in ("lowest", "median")]
    loss = row["largest_loss"]
    line += [f"{loss:.3f}", row["of"]] if round(loss, 3) > 0 else ["0.000", ""]
    line.append(f"{row['iri_error_percent']:+.1f}")
    return [*line, *(f"{row[f'{name}_percent']:.1f}" for name in ("within", "fewest"))]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", default=[], help="begins of constants")
    parser.add_argument("--json", type=Path, help="figures, written as they come")
    parser.add_argument("--page", type=Path, help="Markdown page whose table is replaced")
    return parser.parse_args()


def main() -> None:
    """Print a line for each value as it is there, and the table."""
    given, lines, figures = arguments(), [], []
    made = {label(case): (driven(case), case.where_m) for case in cases()}
    usual = measured(made, USUAL, 1.0, 1.0)
    for name, value, factor in ((USUAL, 1.0, 1.0), *values(tuple(given.only))):
        row = usual if name == USUAL else measured(made, name, value, factor)
        figures.append(row.summary(usual))
        lines.append(cells(figures[-1]))
        print(" | ".join(lines[-1]), flush=True)
        if given.json:
            given.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    show("Cross correlation with the road, one constant changed at a time", COLUMNS, lines, 150)
    if given.page:
        write_page(given.page, lines, COLUMNS)


if __name__ == "__main__":
    main()
