"""A scenario: a few rounded numbers and a seed from which a whole recording follows."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from reprlib import repr as shortened
from types import MappingProxyType
from typing import Any

from floatref.errors import InputError
from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.proving_ground.roads.files import FILE_ROAD, digest_files, file_of
from floatref_conformance.proving_ground.roads.random_roads import CASES, CLASSES
from floatref_conformance.proving_ground.scenario_fields import (
    in_type_of,
    number,
    refuse_unknown,
    value,
)
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle

FORMAT, FIRST_FORMAT = "floatref-scenario/2", "floatref-scenario/1"
FIRST_DEFAULTS: Mapping[str, Any] = MappingProxyType(
    {"slip_percent_per_g": 0.3, "laser_ahead_m": 0.0}
)
"""What a file of the first format, and a case of the judge, mean by a field that they do not name:
an encoder that hardly slips, and a laser at its accelerometer."""
NOT_NUMBERS = ("format", "$schema")
"""Keys of a file that are no field."""
STATIONARY = ("quiescent", "bounce")
MANOEUVRES = (
    *("constant", "coasting", "throttle", "braking", "near-stop", "stop", "dead-start"),
    *("creeping", *STATIONARY, *RUNS),
)
"""Kinds of drive, stationary tests, and the published runs by name."""
ROADS = (
    "flat",
    "measured",
    "sines",
    *(f"sayers-{name}" for name in CASES),
    *(f"iso-{name}" for name in CLASSES),
)


SECOND_DISTANCES = ("none", "gnss", "can", "optical")
"""Sources of distance beside the encoder (4.1.3)."""


@dataclass(frozen=True)
class Scenario:
    """One recording to be simulated; InputError for values out of range.

    Default, limits and meaning stand beside each field, and in docs/scenario.md. Names end with
    the unit.
    """

    seed: int = number(
        0,
        0,
        2**63 - 1,
        "draws the road, where it has no seed of its own, and the errors of every sensor",
    )
    road_seed: int = number(
        -1,
        -1,
        2**63 - 1,
        "draws the road, so that other errors and lines meet the same road; -1: `seed` does",
    )
    road: str = value(
        "sayers-normal",
        "flat, a measured profile, sine waves, of Sayers' spectrum, of an ISO 8608 class; or "
        "measured:FILE, a profile of any format or an OpenCRG surface",
    )
    iri_m_per_km: float = number(
        1.8,
        0.0,
        30.0,
        "the road is scaled to it; 0, and a file without this key, leave it as it is",
    )
    wander_m: float = number(
        0.0, 0.0, 0.5, "standard deviation of the offset of the vehicle's line in a pass (4.5.2)"
    )
    wander_within_m: float = number(
        0.0, 0.0, 0.1, "standard deviation of the wander within a pass, over some ten metres"
    )
    bump_mm: float = number(0.0, -100.0, 100.0, "height of a 3-m bump; 0: no bump")
    bump_at_m: float = number(0.0, 0.0, 1e5, "middle of the bump")
    crown_mm: float = number(
        0.0,
        -300.0,
        300.0,
        "height of a crown, a raised cosine; below 0 a dip or a gutter; 0: no crown",
    )
    crown_length_m: float = number(20.0, 1.0, 1000.0, "length of the crown")
    crown_at_m: float = number(316.0, 0.0, 1e5, "middle of the crown")
    break_percent: float = number(
        0.0, -15.0, 15.0, "change of the road's grade along a parabola; 0: no change"
    )
    break_length_m: float = number(30.0, 1.0, 1000.0, "length of the parabola")
    break_at_m: float = number(316.0, 0.0, 1e5, "middle of the parabola")
    joint_mm: float = number(
        0.0, 0.0, 30.0, "standard deviation of the step at every joint of concrete; 0: no joints"
    )
    joint_spacing_m: float = number(4.6, 1.0, 1000.0, "length of its slabs")
    patch_mm: float = number(
        0.0, 0.0, 100.0, "standard deviation of the height of patches; 0: no patches"
    )
    patches_per_km: float = number(0.0, 0.0, 200.0, "number of patches in a wheel path")
    vehicle: str = value("loaded-van", "a whole vehicle, or the linear model of a paper")
    manoeuvre: str = value(
        "constant",
        "kind of drive, a stationary test, or a published run, which sets all numbers of the drive",
    )
    speed_kmh: float = number(
        72.0, 0.0, 150.0, "initial speed; simulated speed of a stationary test"
    )
    event_speed_kmh: float = number(
        11.0, 0.0, 150.0, "at the end of a brake; the fastest of a creep"
    )
    deceleration_g: float = number(
        0.2, 0.01, 1.0, "of brakes; of coasting and throttle the (de)celeration"
    )
    dwell_s: float = number(
        5.0, 0.0, 600.0, "time at a standstill, or of coasting after a near stop"
    )
    event_at_m: float = number(
        316.0, 0.0, 1e5, "where the brake is released, the stop lies, or coast and throttle begin"
    )
    stops: int = number(1, 1, 100, "number of stops, the first at `event_at_m`")
    stop_spacing_m: float = number(80.0, 1.0, 1e4, "between stops")
    final_speed_kmh: float = number(58.0, 0.0, 150.0, "after the event")
    length_m: float = number(500.0, 10.0, 1e5, "true distance driven")
    grade_percent: float = number(0.0, -20.0, 20.0, "of the lane, uphill positive")
    cross_slope_percent: float = number(0.0, -15.0, 15.0, "of the lane, left side up positive")
    curvature_per_km: float = number(0.0, -50.0, 50.0, "of the course, left turn positive, in 1/km")
    sensors: float = number(1.0, 0.0, 100.0, "factor on all errors of `SensorSuite`; 0 is ideal")
    encoder_error_percent: float = number(
        0.0, -50.0, 50.0, "scale error of the encoder beside the one that is drawn"
    )
    slip_percent_per_g: float = number(
        2.5, 0.0, 100.0, "of the encoder's wheel; fitted to Table 5.5; 3.3.1.3, 3.3.9: 3 to 12"
    )
    radius_percent: float = number(
        0.0,
        -5.0,
        5.0,
        "growth of that wheel's radius from 16 to 97 km/h, up to 1 (3.3.1.1); calibrated at 72",
    )
    warming_percent: float = number(
        0.0, -5.0, 5.0, "its growth as the tyre warms up in a long drive (3.3.9: no figure)"
    )
    laser_ahead_m: float = number(0.105, -2.0, 2.0, "the laser ahead of the accelerometer")
    laser_line_mm: float = number(
        0.0,
        0.0,
        300.0,
        "width of a line laser across the lane, which makes one bridged height of it (4.3: 100 mm) "
        "and by it the truth; 0: a point laser",
    )
    latency_ms: float = number(0.0, 0.0, 100.0, "age of a reading of the laser when it is recorded")
    friction_nm: float = number(
        0.0, 0.0, 10000.0, "moment about pitch at which the suspension's leaf springs slide, in N·m"
    )
    progression_per_m2: float = number(
        0.0, 0.0, 1000.0, "of progressive springs, in 1/m²: their force is k·d·(1 + p·d²)"
    )
    encoder_per_side: bool = value(
        False, "whether the encoder of the wheel on each side is recorded, beside the shared one"
    )
    second_distance: str = value(
        "none",
        "a second source of distance that is recorded: none, gnss (speed over ground), can (wheel "
        "speed of the vehicle bus) or optical (fifth wheel)",
    )
    imu: bool = value(True, "whether horizontal accelerometers and gyros are recorded")
    gnss: bool = value(True, "whether the channels of a receiver are recorded")
    response: bool = value(True, "whether the channels of the vehicle's response are recorded")
    tracks: tuple[str, ...] = value(("left", "right"), "names of the wheel paths")
    rate_hz: float = number(16000.0, 1000.0, 64000.0, "of the accelerometers")
    gyro_rate_hz: float = number(100.0, 10.0, 10000.0, "of the gyros")
    profile_interval_m: float = number(
        0.00508, 0.001, 1.0, "of the truth, and what the recording asks for"
    )

    def __post_init__(self) -> None:
        """Refuse wrong types, names and numbers; InputError names the field."""
        for each in fields(self):
            given = in_type_of(each, getattr(self, each.name))
            object.__setattr__(self, each.name, given)
        if file_of(self.road) is None:
            refuse_unknown("road", self.road, ROADS)
        refuse_unknown("manoeuvre", self.manoeuvre, MANOEUVRES)
        refuse_unknown("second_distance", self.second_distance, SECOND_DISTANCES)
        find_vehicle(self.vehicle, self.friction_nm, self.progression_per_m2)
        if self.speed_kmh == 0 and self.manoeuvre not in ("dead-start", *RUNS):
            raise InputError(f"speed_kmh is 0; {self.manoeuvre} needs a speed above 0")

    def to_dict(self) -> dict[str, Any]:
        """Return the plain JSON object of this scenario."""
        return {"format": FORMAT, **asdict(self), "tracks": list(self.tracks)}

    @classmethod
    def from_dict(cls, document: object) -> "Scenario":
        """Return the scenario of a JSON object, with defaults for the keys that it lacks.

        Raises InputError for an unknown format or key, or a value that makes no scenario.
        """
        if not isinstance(document, Mapping):
            raise InputError("a scenario is a JSON object of its numbers")
        if document.get("format", FORMAT) not in (FORMAT, FIRST_FORMAT):
            found = shortened(document["format"])
            raise InputError(f"format {found}: unknown, expected {FORMAT!r}")
        if document.get("format") == FIRST_FORMAT:
            document = {**FIRST_DEFAULTS, **document}
        if str(document.get("road")).startswith(FILE_ROAD):
            document = {"iri_m_per_km": 0.0, **document}
        numbers = {key: value for key, value in document.items() if key not in NOT_NUMBERS}
        for key in numbers:
            refuse_unknown("key", str(key), tuple(f.name for f in fields(cls)))
        return cls(**numbers)

    @property
    def hash(self) -> str:
        """SHA-256 of the scenario's canonical JSON, in hexadecimal.

        Of a road that is a file it also holds the content; InputError if that cannot be read.
        """
        document = self.to_dict()
        path = file_of(self.road)
        if path is not None:
            document["road_files"] = digest_files(path)
        text = json.dumps(document, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()


LIMITS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        f.name: (f.metadata["lowest"], f.metadata["highest"])
        for f in fields(Scenario)
        if "lowest" in f.metadata
    }
)
"""Smallest and largest value of every number."""


def scenario_of_run(name: str, seed: int = 0, **changes: Any) -> Scenario:
    """Return the scenario of a published run or `ref_72`; InputError if it is unknown."""
    refuse_unknown("run", name, tuple(RUNS))
    return replace(Scenario(seed=seed, manoeuvre=name), **changes)


def repeat_passes(scenario: Scenario, count: int) -> tuple[Scenario, ...]:
    """Return ``count`` passes over one road: the errors and the line of each are drawn anew.

    The first is ``scenario``; the seeds of the others follow its own.
    """
    road = scenario.seed if scenario.road_seed < 0 else scenario.road_seed
    seeds = range(scenario.seed, scenario.seed + count)
    return tuple(replace(scenario, seed=seed, road_seed=road) for seed in seeds)
