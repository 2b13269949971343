"""A scenario: a few rounded numbers and a seed from which a whole recording follows."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from difflib import get_close_matches
from pathlib import Path
from reprlib import repr as shortened
from types import MappingProxyType
from typing import Any

from floatref.errors import InputError
from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.proving_ground.roads.files import FILE_ROAD, digest_files, file_of
from floatref_conformance.proving_ground.roads.random_roads import CASES, CLASSES
from floatref_conformance.proving_ground.scenario_fields import in_type_of, refuse_unknown
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle

FORMAT = "floatref-scenario/1"
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
LIMITS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "seed": (0, 2**63 - 1),
        "road_seed": (-1, 2**63 - 1),
        "iri_m_per_km": (0.0, 30.0),
        "wander_m": (0.0, 0.5),
        "wander_within_m": (0.0, 0.1),
        "bump_mm": (-100.0, 100.0),
        "bump_at_m": (0.0, 1e5),
        "speed_kmh": (0.0, 150.0),
        "event_speed_kmh": (0.0, 150.0),
        "deceleration_g": (0.01, 1.0),
        "dwell_s": (0.0, 600.0),
        "event_at_m": (0.0, 1e5),
        "stops": (1, 100),
        "stop_spacing_m": (1.0, 1e4),
        "final_speed_kmh": (0.0, 150.0),
        "length_m": (10.0, 1e5),
        "grade_percent": (-20.0, 20.0),
        "cross_slope_percent": (-15.0, 15.0),
        "curvature_per_km": (-50.0, 50.0),
        "sensors": (0.0, 100.0),
        "encoder_error_percent": (-50.0, 50.0),
        "slip_percent_per_g": (0.0, 100.0),
        "rate_hz": (1000.0, 64000.0),
        "gyro_rate_hz": (10.0, 10000.0),
        "profile_interval_m": (0.001, 1.0),
    }
)
"""Smallest and largest value of every number."""


@dataclass(frozen=True)
class Scenario:
    """One recording to be simulated; InputError for values out of range.

    Attributes:
        seed: draws the road and every sensor's errors.
        road_seed: draws the road in its place, so that other errors meet the same road; -1: off.
        road: one of `ROADS`: flat, a measured profile, sine waves, of Sayers' spectrum, or of an
            ISO 8608 class; or ``measured:FILE``, a profile of any format or an OpenCRG surface.
        iri_m_per_km: the road is scaled to it; 0 leaves the road as drawn. A scenario file with
            ``measured:FILE`` and without this number leaves the road as measured.
        wander_m: standard deviation of the offset of the vehicle's line in a pass, drawn from
            ``seed``: decimetres in print (4.5.2). Flat and sine roads are alike sideways.
        wander_within_m: standard deviation of the wander within a pass, centimetres within ten
            metres.
        bump_mm, bump_at_m: height of a 3-m bump, 0 for no bump, and where its middle lies.
        vehicle: a name of `vehicles.VEHICLES` or `vehicles.LINEAR_MODELS`.
        manoeuvre: one of `MANOEUVRES`. A published run sets all numbers of the drive itself.
        speed_kmh: initial speed; simulated speed of a stationary test.
        event_speed_kmh: at the end of a brake; the fastest of a creep.
        deceleration_g: of brakes; of coasting and throttle the (de)celeration.
        dwell_s: at a standstill, or coasting after a near stop.
        event_at_m: where the brake is released, the stop lies, or coast and throttle begin.
        stops, stop_spacing_m: how often the vehicle stops, and how far apart; the first stop lies
            at ``event_at_m``.
        final_speed_kmh: after the event.
        length_m: true distance driven.
        grade_percent: uphill positive.
        cross_slope_percent: left side up positive.
        curvature_per_km: of the course, left turn positive, in 1/km.
        sensors: factor on all errors of `SensorSuite`; 0 is ideal.
        encoder_error_percent: scale error of the encoder beside the one that is drawn.
        slip_percent_per_g: of the encoder's wheel, at the factor ``sensors`` of 1.
        imu, gnss, response: whether those channels are recorded.
        tracks: wheel paths.
        rate_hz: of the accelerometers.
        gyro_rate_hz: of the gyros.
        profile_interval_m: of the truth, and what the recording asks for.
    """

    seed: int = 0
    road_seed: int = -1
    road: str = "sayers-normal"
    iri_m_per_km: float = 1.8
    wander_m: float = 0.0
    wander_within_m: float = 0.0
    bump_mm: float = 0.0
    bump_at_m: float = 0.0
    vehicle: str = "loaded-van"
    manoeuvre: str = "constant"
    speed_kmh: float = 72.0
    event_speed_kmh: float = 11.0
    deceleration_g: float = 0.2
    dwell_s: float = 5.0
    event_at_m: float = 316.0
    stops: int = 1
    stop_spacing_m: float = 80.0
    final_speed_kmh: float = 58.0
    length_m: float = 500.0
    grade_percent: float = 0.0
    cross_slope_percent: float = 0.0
    curvature_per_km: float = 0.0
    sensors: float = 1.0
    encoder_error_percent: float = 0.0
    slip_percent_per_g: float = 0.3
    imu: bool = True
    gnss: bool = True
    response: bool = True
    tracks: tuple[str, ...] = ("left", "right")
    rate_hz: float = 16000.0
    gyro_rate_hz: float = 100.0
    profile_interval_m: float = 0.00508

    def __post_init__(self) -> None:
        """Refuse wrong types, names and numbers; InputError names the field."""
        for field in fields(self):
            value = in_type_of(
                field.name, getattr(self, field.name), field.default, LIMITS.get(field.name)
            )
            object.__setattr__(self, field.name, value)
        if file_of(self.road) is None:
            refuse_unknown("road", self.road, ROADS)
        refuse_unknown("manoeuvre", self.manoeuvre, MANOEUVRES)
        find_vehicle(self.vehicle)
        if self.speed_kmh == 0 and self.manoeuvre not in ("dead-start", *RUNS):
            raise InputError(f"speed_kmh is 0; {self.manoeuvre} needs a speed above 0")

    def to_dict(self) -> dict[str, Any]:
        """Return the plain JSON object of this scenario."""
        return {"format": FORMAT, **asdict(self), "tracks": list(self.tracks)}

    @classmethod
    def from_dict(cls, document: object) -> "Scenario":
        """Return the scenario of a JSON object; unknown keys are ignored.

        Raises InputError for an unknown format or a value that makes no scenario.
        """
        if not isinstance(document, Mapping):
            raise InputError("a scenario is a JSON object of its numbers")
        if document.get("format", FORMAT) != FORMAT:
            found = shortened(document["format"])
            raise InputError(f"format {found}: unknown, expected {FORMAT!r}")
        if str(document.get("road")).startswith(FILE_ROAD):
            document = {"iri_m_per_km": 0.0, **document}
        known = {field.name for field in fields(cls)}
        return cls(**{name: value for name, value in document.items() if name in known})

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


def scenario_of_run(name: str, seed: int = 0, **changes: Any) -> Scenario:
    """Return the scenario of a published run or `ref_72`; InputError if it is unknown."""
    if name not in RUNS:
        near = get_close_matches(name, RUNS, n=1)
        hint = f"did you mean {near[0]}?" if near else f"known: {', '.join(RUNS)}"
        raise InputError(f"run {name}: unknown; {hint}")
    return replace(Scenario(seed=seed, manoeuvre=name), **changes)


def read_scenario(path: Path) -> Scenario:
    """Return the scenario in a JSON file; InputError with one line naming the file.

    The file of a road is found from the folder of the scenario file.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; give a run or a scenario file") from error
    except ValueError as error:
        raise InputError(f"{path}: not JSON ({error}); write one object") from error
    except RecursionError as error:
        raise InputError(f"{path}: nested too deeply; write one object of numbers") from error
    try:
        scenario = Scenario.from_dict(document)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    road = file_of(scenario.road)
    return scenario if road is None else replace(scenario, road=f"{FILE_ROAD}{path.parent / road}")
