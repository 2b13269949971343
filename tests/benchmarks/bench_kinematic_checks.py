"""How often a wrong installation of IMU and GNSS is found, and how often a sound one is blamed.

Every vehicle of the proving ground drives every manoeuvre, with and without slopes and curves, on
several seeds; each recording is checked as it is, and with one fault after the other. Cells are
"refused + warned / recordings"; "!" counts those where another channel is blamed. Run as
``python tests/benchmarks/bench_kinematic_checks.py [seeds [drive ...]]``.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from kind_drives import KIND

from floatref.errors import InputError
from floatref.screening.gnss_height import gnss_faults
from floatref.screening.imu_and_gnss import ImuUse, check_kinematics
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES

RATE_HZ = 1000.0
STOP = {"manoeuvre": "stop"}
DRIVES: Mapping[str, Mapping[str, object]] = {
    "constant": {},
    "smooth": {"iri_m_per_km": 0.4},
    "coasting": {"manoeuvre": "coasting", "speed_kmh": 80.0, "final_speed_kmh": 70.0,
                 "deceleration_g": 0.03, "event_at_m": 200.0},
    "throttle": {"manoeuvre": "throttle", "speed_kmh": 40.0, "final_speed_kmh": 80.0,
                 "deceleration_g": 0.15},
    "braking": {"manoeuvre": "braking", "event_speed_kmh": 30.0, "deceleration_g": 0.25},
    "near-stop": {"manoeuvre": "near-stop", "dwell_s": 2.0},
    "stop": STOP,
    "dead-start": {"manoeuvre": "dead-start", "event_at_m": 0.0, "dwell_s": 8.0},
    "creeping": {"manoeuvre": "creeping", "speed_kmh": 4.0, "event_speed_kmh": 6.0,
                 "length_m": 60.0},
    "quiescent": {"manoeuvre": "quiescent"},
    "bounce": {"manoeuvre": "bounce"},
    "hill": {**STOP, "grade_percent": 8.0},
    "bank": {**STOP, "cross_slope_percent": 8.0},
    "curve": {**STOP, "curvature_per_km": 8.0},
    "banked": {**STOP, "curvature_per_km": 5.0, "cross_slope_percent": -8.0},
    "slippery": {**STOP, "slip_percent_per_g": 10.0},
}  # fmt: skip
"""Numbers of the scenarios."""
DEGREES = 180.0 / np.pi
RPQ = ("roll_rate", "pitch_rate", "yaw_rate")
ANGLES = ("gnss_roll", "gnss_pitch")
LONG, LAT = "longitudinal_specific_force", "lateral_specific_force"
Change = Callable[[Channel], Channel]


@dataclass(frozen=True)
class Fault:
    """A change of the channels that are named, and words that the answer must hold."""

    names: tuple[str, ...]
    change: Change
    words: tuple[str, ...]

    def applied(self, recording: Recording) -> Recording:
        changed = (self.change(c) if c.id.name in self.names else c for c in recording.channels)
        return replace(recording, channels=tuple(changed))


def times(factor: float) -> Change:
    """Return a change of sign or unit."""
    return lambda channel: replace(channel, values=channel.values * factor)


def exchanged(first: str, second: str) -> Fault:
    twin = {first: second, second: first}
    return Fault(
        (first, second),
        lambda c: replace(c, id=c.id._replace(name=twin[c.id.name])),
        (first, second, "exchanged"),
    )


def later(by_s: float) -> Change:
    """Return time stamps that are off."""
    return lambda c: replace(c, clock=StampedClock.of(c.times_s + by_s))


def damaged(put: Callable[[np.ndarray, int], None]) -> Change:
    """Return a change of some samples from the middle on."""

    def change(channel: Channel) -> Channel:
        values = channel.values.copy()
        put(values, values.size // 2)
        return replace(channel, values=values)

    return change


def gap(values: np.ndarray, at: int) -> None:
    """Lose a second of a gyro."""
    values[at : at + 100] = np.nan


def jump(values: np.ndarray, at: int) -> None:
    values[at:] += 1.0


def stuck(values: np.ndarray, at: int) -> None:
    """Repeat a reading for five seconds."""
    values[at : at + 100] = values[at]


def unfixed(values: np.ndarray, at: int) -> None:
    """Never get a fixed ambiguity."""
    values[:] = 5.0


def constant(values: np.ndarray, at: int) -> None:
    values[:] = 0.0


GNSS = tuple(f"gnss_{n}" for n in ("height", "vertical_velocity", "pitch", "roll", "quality",
                                   "latitude", "longitude"))  # fmt: skip
FAULTS: Mapping[str, Fault] = {
    "sound": Fault((), times(1.0), ()),
    "long. sign": Fault((LONG,), times(-1.0), (LONG, "sign")),
    "long. in g": Fault((LONG,), times(1 / 9.80665), (LONG, "looks like g")),
    "long. dead": Fault((LONG,), damaged(constant), (LONG, "every sample")),
    "long.<>lat.": exchanged(LONG, LAT),
    "lat. sign": Fault((LAT,), times(-1.0), (LAT,)),
    **{
        f"{name} sign": Fault((name,), times(-1.0), (name, "sign"))
        for name in ("roll_rate", "pitch_rate")
    },
    "yaw_rate sign": Fault(("yaw_rate",), times(-1.0), ("yaw_rate",)),
    "pitch dead": Fault(("pitch_rate",), damaged(constant), ("pitch_rate", "every sample")),
    "all in deg/s": Fault(RPQ, times(DEGREES), ("deg/s",)),
    "roll<>pitch": exchanged("roll_rate", "pitch_rate"),
    "pitch<>yaw": exchanged("pitch_rate", "yaw_rate"),
    "gnss_pitch sign": Fault(("gnss_pitch",), times(-1.0), ("gnss_pitch", "sign")),
    "gnss_roll sign": Fault(("gnss_roll",), times(-1.0), ("gnss_roll", "sign")),
    "angles in deg": Fault(ANGLES, times(DEGREES), ("looks like degrees",)),
    "angles exch.": exchanged(*ANGLES),
    "velocity sign": Fault(
        ("gnss_vertical_velocity",), times(-1.0), ("gnss_vertical_velocity", "sign")
    ),
    "epoch": Fault(GNSS, later(1.4e9), ("another epoch",)),
    "18 s early": Fault(GNSS, later(-18.0), ("time stamps",)),
    "0.2 s late": Fault(GNSS, later(0.2), ("time stamps",)),
    "jump 1 m": Fault(("gnss_height",), damaged(jump), ("gnss_height", "jumps")),
    "stuck 5 s": Fault(("gnss_height",), damaged(stuck), ("gnss_height", "stuck")),
    "never fixed": Fault(("gnss_quality",), damaged(unfixed), ("never 4",)),
    "gyro gap 1 s": Fault(("pitch_rate",), damaged(gap), ("pitch_rate", "no samples")),
}


def recordings(drive: str, seeds: int) -> Iterator[Recording]:
    """Yield what every vehicle records on a drive, once for each seed."""
    for vehicle in VEHICLES:
        for seed in range(seeds):
            common = {**KIND, "vehicle": vehicle, "seed": seed, "rate_hz": RATE_HZ}
            yield simulate(Scenario.from_dict({**common, **DRIVES[drive]})).recording


def answer(recording: Recording, words: tuple[str, ...]) -> str:
    """Return "refused", "warned", "other" for another channel, or "silent"."""
    try:
        lines = check_kinematics(
            recording, ImuUse(recording.tracks[:1], True, True), gnss_faults(recording)
        )
    except InputError as error:
        return "refused" if words and all(w in str(error) for w in words) else "other"
    if words and any(all(w in line for w in words) for line in lines):
        return "warned"
    return "other" if lines else "silent"


def without_arm(recording: Recording, by_m: float | None) -> Recording:
    """Return a setup whose antenna is off by ``by_m`` along X, or not given."""
    x, y, z = recording.setup.gnss_antenna_offset_m
    arm = (0.0, 0.0, 0.0) if by_m is None else (x + by_m, y, z)
    return replace(recording, setup=replace(recording.setup, gnss_antenna_offset_m=arm))


def tried(drive: str, seeds: int, found: dict[str, dict[str, Counter[str]]]) -> float:
    """Count the answers to every fault on one drive; return the share of real time it takes."""
    real = taken = 0.0
    for recording in recordings(drive, seeds):
        begin = time.perf_counter()
        for name, fault in FAULTS.items():
            found[name][drive][answer(fault.applied(recording), fault.words)] += 1
        for name, by_m in (("arm missing", None), ("arm 1.5 m off", 1.5)):
            faulty = without_arm(recording, by_m)
            found[name][drive][answer(faulty, ("gnss_antenna_offset_m",))] += 1
        taken += (time.perf_counter() - begin) / (len(FAULTS) + 2)
        real += recording.channel("distance", recording.tracks[0]).span_s[1]
    return taken / real


def main() -> None:
    """Print the table."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    drives = sys.argv[2:] or list(DRIVES)
    names = [*FAULTS, "arm missing", "arm 1.5 m off"]
    found = {name: {drive: Counter[str]() for drive in drives} for name in names}
    share = {drive: tried(drive, seeds, found) for drive in drives}
    print(f"{'':17}" + "".join(f"{drive[:10]:>12}" for drive in drives))
    for name, row in found.items():
        cells = []
        for count in row.values():
            wrong = f"!{count['other']}" if count["other"] else ""
            cells.append(f"{count['refused']}+{count['warned']}/{count.total()}{wrong}")
        print(f"{name:17}" + "".join(f"{cell:>12}" for cell in cells))
    print(f"{'% of real time':17}" + "".join(f"{100 * share[d]:12.2g}" for d in drives))


if __name__ == "__main__":
    main()
