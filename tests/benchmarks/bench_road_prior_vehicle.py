"""What a run tells of its vehicle, and what the next run gains by it.

Three stops of each vehicle, with the same sensors on roads of their own. Each is processed as it
is, and with what the two others have told. Beside the tilt learned is that of the vehicle's own
springs. Run as

    python tests/benchmarks/bench_road_prior_vehicle.py
"""

from math import degrees

import numpy as np
from road_prior_adversities import Adversity, stop
from road_prior_measuring import OURS, compared, quietly, simulated
from tables import show

from floatref.cli.vehicle import combine_estimates
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.simulate import Simulation
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES

STOPS = ((0.2, 1.8), (0.4, 1.8), (0.3, 4.0))
"""Deceleration in g and IRI of the road in m/km."""
RATE_HZ = 2000.0
PITCH, ALONG = 1, 4
COLUMNS = ("vehicle", "tilt of its springs, °/g", "learned in each of three runs, °/g", "1-sigma")
COLUMNS += ("cross correlation", "lowest", "with what two runs told", "lowest")


def per_g(tilt: float) -> float:
    """Return a pitch angle in degrees per g from one in rad per m/s²."""
    return degrees(tilt) * STANDARD_GRAVITY


def case(name: str, number: int) -> tuple[Adversity, Simulation]:
    """Return one stop of a vehicle, and its recording."""
    g, iri = STOPS[number]
    road = {"iri_m_per_km": iri, "road_seed": number}
    found = Adversity(name, "", stop(vehicle=name, deceleration_g=g, rate_hz=RATE_HZ, **road))
    return found, simulated(found, 0)


def main() -> None:
    """Print a line for each vehicle."""
    lines = []
    for name, vehicle in VEHICLES.items():
        own = np.linalg.solve(vehicle.stiffness(), vehicle.forcing()[:, ALONG])[PITCH]
        runs = [case(name, number) for number in range(len(STOPS))]
        plain = [quietly(made.recording, OURS, {}) for _, made in runs]
        learned = [profile.provenance["learned"] for profile in plain]
        found: list[list[float]] = [[], []]
        for number, (made, profile) in enumerate(zip(runs, plain, strict=True)):
            others = combine_estimates([run for k, run in enumerate(learned) if k != number])
            again = quietly(made[1].recording, OURS, others)
            for each, values in zip((profile, again), found, strict=True):
                tracks = compared(made[1], each, made[0].where_m)
                values += [track.cross_correlation for track in tracks]
        tilts = ", ".join(f"{per_g(one['tilt_expected']):.2f}" for one in learned)
        sigma = f"{per_g(combine_estimates(learned)['tilt_sigma']):.2f}"
        figures = [f"{f(values):.3f}" for values in found for f in (np.mean, np.min)]
        lines.append([name, f"{per_g(abs(float(own))):.2f}", tilts, sigma, *figures])
    show("What a run learns of its vehicle", COLUMNS, lines, 150)


if __name__ == "__main__":
    main()
