"""The study: every fault in every drive, and what every pipeline makes of it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial

from floatref.errors import FloatrefError, InputError
from floatref.values.display.similar_names import suggest
from floatref.values.recording import Recording
from floatref_conformance.devices.builtin import make, process_with_warnings
from floatref_conformance.faults.fault_list import FAULTS, find_fault
from floatref_conformance.faults.outcomes import Outcome, Truth, judge
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.worker_pool import map_in_order

RATE_HZ = 8000.0
"""Sampling rate of the accelerometers: half of 16 kHz takes half the time, as in the families."""
DRIVES = {
    "constant": Scenario(rate_hz=RATE_HZ),
    "stop": Scenario(rate_hz=RATE_HZ, manoeuvre="stop"),
}
"""72 km/h over a road of 1.8 m/km, and a stop of 5 s on it: default vehicle, sensors and road."""
PIPELINES = (
    "temporal-basic",
    "temporal-adaptive-hpf-spatial-backward",
    "road-prior-smoother",
    "road-prior-smoother-spatial",
    "kalman-smoother-reflection",
    "response-joint-input-state",
)
"""Without suppression; the best suppression of chapter 5; the default device and its spatial form;
IMU and GNSS; no height sensor."""
NOMINAL = ("distance", "vertical_specific_force", "height")
NOMINAL_PIPELINES = PIPELINES[:4]
NOMINAL_SENSORS = ("accelerometer", "laser", "sides", "encoder")
"""Channels of a profiler without IMU, GNSS and response, pipelines that need no more, and what can
be faulty then."""
HEALTHY = ""
"""Name of the recording without a fault."""


@dataclass(frozen=True)
class Trial:
    """What one pipeline made of one fault in one drive, and its new warnings or the refusal."""

    fault: str
    drive: str
    pipeline: str
    outcome: Outcome
    lines: tuple[str, ...] = ()


@dataclass(frozen=True)
class StudySettings:
    """Which faults, drives and pipelines; all by default. InputError for an unknown name.

    ``nominal`` recordings have accelerometers, lasers and an encoder alone.
    """

    faults: tuple[str, ...] = tuple(FAULTS)
    drives: tuple[str, ...] = tuple(DRIVES)
    pipelines: tuple[str, ...] = PIPELINES
    jobs: int = 1
    seed: int = 0
    nominal: bool = False

    def __post_init__(self) -> None:
        """Refuse unknown names."""
        for name in self.faults:
            find_fault(name)
        for name in self.pipelines:
            make(name)
        for name in self.drives:
            if name not in DRIVES:
                raise InputError(f"drive {name}: unknown; {suggest(name, DRIVES, 'known:')}")


@dataclass
class Study:
    """All trials, and the settings that made them; ``healthy`` are those without a fault."""

    settings: StudySettings
    trials: list[Trial] = field(default_factory=list)
    healthy: list[Trial] = field(default_factory=list)

    def of(self, outcome: Outcome, tellable: bool | None = None) -> list[Trial]:
        """Return the trials with ``outcome``, of faults that a recording can show if asked for."""
        return [
            trial
            for trial in self.trials
            if trial.outcome is outcome
            and (tellable is None or bool(FAULTS[trial.fault].twin) is not tellable)
        ]


def make_study(settings: StudySettings, watch: Callable[[str], None] | None = None) -> Study:
    """Return the study of ``settings``; ``watch`` is called after every fault in a drive."""
    made = Study(settings)
    work = [(fault, drive) for drive in settings.drives for fault in (HEALTHY, *settings.faults)]
    try_one = partial(
        try_fault, pipelines=settings.pipelines, seed=settings.seed, nominal=settings.nominal
    )
    with map_in_order(try_one, settings.jobs, *zip(*work, strict=True)) as results:
        for (fault, drive), trials in zip(work, results, strict=True):
            (made.trials if fault else made.healthy).extend(trials)
            if watch is not None:
                watch(f"{drive}: {fault or 'healthy'}")
    return made


def try_fault(
    fault: str, drive: str, pipelines: Sequence[str], seed: int = 0, nominal: bool = False
) -> tuple[Trial, ...]:
    """Return what each of ``pipelines`` makes of ``drive`` with ``fault``, by their names.

    ``nominal`` recordings have the channels of `NOMINAL` alone.
    """
    recording, truth = drive_healthy(drive)
    faulty = FAULTS[fault].damage(recording, seed) if fault else recording
    if nominal:
        kept = tuple(c for c in faulty.channels if c.id.name in NOMINAL)
        faulty = replace(faulty, channels=kept)
    return tuple(_try(fault, drive, name, faulty, truth) for name in pipelines)


def _try(fault: str, drive: str, pipeline: str, faulty: Recording, truth: Truth) -> Trial:
    usual = _healthy_lines(drive, pipeline) if fault else ()
    try:
        profile, lines = process_with_warnings(faulty, pipeline)
    except FloatrefError as refusal:
        return Trial(fault, drive, pipeline, Outcome.REFUSED, (str(refusal),))
    new = tuple(line for line in lines if line not in usual)
    return Trial(fault, drive, pipeline, judge(truth, profile, bool(new)), new)


@cache
def drive_healthy(drive: str) -> tuple[Recording, Truth]:
    """Return the recording and the truth of a drive, simulated once in each process."""
    from floatref_conformance.checks.driving.layout import layout_of
    from floatref_conformance.proving_ground.simulate import simulate
    from floatref_conformance.table.passes import encoder_along_truth

    scenario = DRIVES[drive]
    made = simulate(scenario)
    (ends,) = layout_of(scenario).stretches
    return made.recording, Truth(made.truth, encoder_along_truth(made), *ends)


@cache
def _healthy_lines(drive: str, pipeline: str) -> tuple[str, ...]:
    return process_with_warnings(drive_healthy(drive)[0], pipeline)[1]
