"""What the road from the vehicle's response is good for, beside a laser on the same drives.

Vans drive over simulated roads with all sensors. What each pipeline makes of a drive is compared
with the road, and with what laser and accelerometer of the same drive give, over 160.9 m, after the
IRI filter: at several speeds, and with every parameter of the vehicle off by so much.

    python tests/benchmarks/bench_response.py [--draws N] [--page FILE] [--plot FILE]
"""

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from kind_drives import KIND
from rich.progress import track as shown
from road_prior_measuring import compared, quietly, stretch
from tables import show, write_page

import floatref
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.staging import road_of, setup_of, suite_of
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle

JOINT, OBSERVER = "response-joint-input-state", "response-observer"
LASER = "road-prior-smoother"
SPEEDS_KMH = (16.1, 24.0, 40.0, 56.0, 72.0, 97.0)
ERRORS_PERCENT = (0.0, 5.0, 10.0, 20.0)
SPEED_KMH = 72.0
"""That of the drives with parameter errors."""
VEHICLES = ("loaded-van", "minivan", "pickup", "soft-van")
MIDDLE_M, LENGTH_M, INTERVAL_M = 250.0, 500.0, 0.025
ALONE_COLUMNS = ("20 % off alone", "r", "lowest", "IRI, %", "most")
APART_COLUMNS = ("vehicle", "wheel, m", "laser, m", "r", "lowest", "IRI, %")
COLUMNS = ("drives", "pipeline", "road: r", "lowest", "IRI, %", "most", "laser: r", "IRI, % ")


@dataclass(frozen=True)
class Score:
    """One wheel path: cross correlation and IRI error in %, to the road and to the laser's."""

    road: float
    road_iri: float
    laser: float
    laser_iri: float


def drive(speed_kmh: float, draw: int, known: bool = False) -> Simulation:
    """Return a drive at constant speed; ``draw`` gives road, errors and vehicle.

    The installer is up to 3 % wrong about each parameter, unless they are ``known``.
    """
    scenario = Scenario(
        seed=draw,
        vehicle=VEHICLES[draw % len(VEHICLES)],
        speed_kmh=speed_kmh,
        length_m=LENGTH_M,
        slip_percent_per_g=0.3,
        laser_ahead_m=0.0,
        imu=False,
        gnss=False,
        rate_hz=4000.0,
        profile_interval_m=INTERVAL_M,
        **KIND,
    )
    suite = suite_of(scenario)
    return simulate(scenario, suite=replace(suite, vehicle_error=0.0) if known else suite)


def misjudged(made: Simulation, percent: float, draw: int, alone: str = "") -> floatref.Recording:
    """Return the recording with each parameter, or that ``alone``, off by ``percent``.

    Signs are drawn.
    """
    setup = made.recording.setup
    assert setup.vehicle is not None
    signs = np.random.default_rng([draw, 8]).choice([-1.0, 1.0], len(setup.vehicle.parameters))
    changed = {
        name: value * (1 + percent / 100 * sign * (alone in ("", name)))
        for (name, value), sign in zip(setup.vehicle.parameters.items(), signs, strict=True)
    }
    vehicle = replace(setup.vehicle, parameters=changed)
    return replace(made.recording, setup=replace(setup, vehicle=vehicle))


def scores(made: Simulation, profile: floatref.Profile, laser: floatref.Profile) -> list[Score]:
    """Return how each wheel path compares with the road and with the laser's profile."""
    found = []
    inside = stretch(made, MIDDLE_M, laser.interval_m)
    for true, track in zip(compared(made, profile, MIDDLE_M), profile.tracks, strict=True):
        mine = iri_trace(track.elevation, profile.interval_m)[inside]
        other = iri_trace(laser.track(track.name).elevation, laser.interval_m)[inside]
        agreed = cross_correlation(other, mine, laser.interval_m, 1.0).cross_correlation
        error = 100.0 * float(np.abs(mine).mean() / np.abs(other).mean() - 1.0)
        found.append(Score(true.cross_correlation, true.iri_error_percent, agreed, error))
    return found


def line(drives: str, pipeline: str, found: list[Score]) -> list[str]:
    """Return one line of the table: means, the lowest correlation and the largest error."""
    columns = np.array([(s.road, s.road_iri, s.laser, s.laser_iri) for s in found]).T
    most = columns[1][np.argmax(np.abs(columns[1]))]
    cells = [f"{columns[0].mean():.3f}", f"{columns[0].min():.3f}"]
    cells += [f"{columns[1].mean():+.1f}", f"{most:+.1f}"]
    cells += [f"{columns[2].mean():.3f}", f"{columns[3].mean():+.1f}"]
    return [drives, pipeline, *cells]


def by_speed(draws: int) -> list[list[str]]:
    """Return lines of every speed and pipeline, with what the installer knows of the vehicle."""
    lines = []
    for speed in shown(SPEEDS_KMH, "speeds"):
        found: dict[str, list[Score]] = {name: [] for name in (JOINT, OBSERVER, LASER)}
        for draw in range(draws):
            made = drive(speed, draw)
            laser = quietly(made.recording, LASER, {})
            for name, rows in found.items():
                profile = laser if name == LASER else quietly(made.recording, name, {})
                rows += scores(made, profile, laser)
        lines += [line(f"{speed:g} km/h", name, rows) for name, rows in found.items()]
    return lines


def by_error(draws: int) -> list[list[str]]:
    """Return lines of every parameter error at 72 km/h."""
    lines = []
    for percent in shown(ERRORS_PERCENT, "parameter errors"):
        found: dict[str, list[Score]] = {name: [] for name in (JOINT, OBSERVER)}
        for draw in range(draws):
            made = drive(SPEED_KMH, draw, known=True)
            laser = quietly(made.recording, LASER, {})
            recording = misjudged(made, percent, draw)
            for name, rows in found.items():
                rows += scores(made, quietly(recording, name, {}), laser)
        lines += [line(f"{percent:g} % off", name, rows) for name, rows in found.items()]
    return lines


def by_parameter(draws: int) -> list[list[str]]:
    """Return lines of the joint filter with one parameter off alone, by the largest error."""
    vehicle = drive(SPEED_KMH, 0).recording.setup.vehicle
    assert vehicle is not None
    found: dict[str, list[Score]] = {n: [] for n, value in vehicle.parameters.items() if value}
    for draw in shown(range(draws), "single parameters"):
        made = drive(SPEED_KMH, draw, known=True)
        laser = quietly(made.recording, LASER, {})
        for name, rows in found.items():
            recording = misjudged(made, ERRORS_PERCENT[-1], draw, alone=name)
            rows += scores(made, quietly(recording, JOINT, {}), laser)
    lines = [line(name, "", rows) for name, rows in found.items()]
    return [[name, *cells[:4]] for name, _, *cells in lines]


def lines_apart(draws: int) -> list[list[str]]:
    """Return for every vehicle how the road in its wheels' line compares with the laser's."""
    lines = []
    for name in VEHICLES:
        vehicle, found = find_vehicle(name), []
        for draw in range(draws):
            lengths = {"length_m": LENGTH_M, "profile_interval_m": INTERVAL_M}
            scenario = Scenario(seed=draw, **lengths, **KIND)
            road = road_of(scenario, LENGTH_M)
            laser = setup_of(scenario, vehicle, road.lateral_m).tracks["left"].reference_point_m[1]
            found.append(_compared(road, laser, vehicle.front.half_track_m))
        r, error = np.transpose(found)
        places = [f"{vehicle.front.half_track_m:.2f}", f"{laser:.2f}"]
        lines.append([name, *places, f"{r.mean():.3f}", f"{r.min():.3f}", f"{error.mean():+.1f}"])
    return lines


def _compared(road: Road, laser_m: float, wheel_m: float) -> tuple[float, float]:
    """Return cross correlation and IRI error in % of the road ``wheel_m`` left of the middle."""
    place = np.arange(0.0, LENGTH_M, INTERVAL_M)
    true, found = (
        iri_trace(high_pass(road.across(place, np.full(place.size, y)), INTERVAL_M), INTERVAL_M)[
            round(100 / INTERVAL_M) : round(-100 / INTERVAL_M)
        ]
        for y in (laser_m, wheel_m)
    )
    agreed = cross_correlation(true, found, INTERVAL_M, 1.0).cross_correlation
    return agreed, 100.0 * float(np.abs(found).mean() / np.abs(true).mean() - 1.0)


def draw_figure(lines: list[list[str]], path: Path) -> None:
    """Draw correlation and IRI error against speed and against parameter error."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 2, figsize=(9.0, 6.0), sharex="col", layout="constrained")
    for column, (unit, label) in enumerate(
        (("km/h", "speed, km/h"), ("% off", "parameters off by, %"))
    ):
        for colour, name in enumerate((JOINT, OBSERVER, LASER)):
            rows = [row for row in lines if row[1] == name and row[0].endswith(unit)]
            x = [float(row[0].split()[0]) for row in rows]
            for axis, mean, worst in ((axes[0, column], 2, 3), (axes[1, column], 4, 5)):
                axis.plot(
                    x, [float(row[mean]) for row in rows], "o-", color=f"C{colour}", label=name
                )
                axis.plot(
                    x, [float(row[worst]) for row in rows], "v", color=f"C{colour}", alpha=0.4
                )
        axes[1, column].set_xlabel(label)
    axes[0, 0].set_ylabel("cross correlation with the road")
    axes[1, 0].set_ylabel("error of the IRI, %")
    axes[0, 0].legend(fontsize=8, title="mean; triangles: worst wheel path", title_fontsize=8)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=110)


def main() -> None:
    """Print the tables, and write and draw what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=8, help="drives of each line")
    parser.add_argument("--page", type=Path, help="Markdown page whose table is replaced")
    parser.add_argument("--plot", type=Path, help="figure to draw")
    asked = parser.parse_args()
    lines = [*by_speed(asked.draws), *by_error(asked.draws)]
    alone, apart = by_parameter(asked.draws), lines_apart(asked.draws)
    show("Road from the vehicle's response", COLUMNS, lines, 120)
    show("One parameter off at 72 km/h, joint filter", ALONE_COLUMNS, alone, 120)
    show("Road in the wheels' line and in the laser's", APART_COLUMNS, apart, 120)
    if asked.page:
        write_page(asked.page, lines, COLUMNS)
        write_page(asked.page, alone, ALONE_COLUMNS)
        write_page(asked.page, apart, APART_COLUMNS)
    if asked.plot:
        draw_figure(lines, asked.plot)


if __name__ == "__main__":
    main()
