"""Grading the limits: an error of 1.5 times a limit fails, one of 0.67 times passes."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check, Taken
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import Description
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.judge.verdict import Measurement
from floatref_conformance.proving_ground.scenario import Scenario

NOMINAL = Description("perfect", "1", "temporal", ())
AddError = Callable[[Profile, Taken, str], Profile]
"""Puts an error into the perfect profile of a recording, which has its label within the case."""


def keep_profile(profile: Profile, taken: Taken, label: str) -> Profile:
    """Return ``profile``."""
    return profile


@dataclass
class Roads:
    """Recordings and their perfect profiles, made once for all errors that are put in."""

    taken: dict[Scenario, Taken] = field(default_factory=dict)

    def of(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario``."""
        if scenario not in self.taken:
            self.taken[scenario] = make_taken(scenario)
        return self.taken[scenario]


@dataclass(frozen=True)
class TruthBench:
    """Answers every recording with its truth, filtered, and ``spoil`` applied to it."""

    roads: Roads
    add_error: AddError = keep_profile
    description: Description = NOMINAL

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels of the capabilities."""
        return self.roads.of(restrict_channels(self.description, scenario))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the spoilt truth."""
        return self.add_error(make_perfect(taken), taken, label)


TOO_MUCH, ALLOWED = 1.5, 0.67
TOLERANCE = 0.15
"""A known error may be read so much too large or too small, as a share of it."""
UNSPOILT = 0.2
"""Largest reading of the truth itself, as a share of a limit, where a limit is that of an error."""
Put = Callable[[float], AddError]
"""Returns what puts in an error of so much, in the unit of the quantity."""


@dataclass(frozen=True)
class Graded:
    """One quantity of one case, and how an error of it is put in.

    Attributes:
        names: of the measurements that hold it; more than one where the better one counts.
        put: puts it in.
        classes: that it is graded for.
        is_error: whether the truth itself reads next to nothing.
        alone: whether all else keeps its limits while this one is used up to two thirds.
        limit: the limit, where it may be that of either of two quantities.
    """

    names: tuple[str, ...]
    put: Put
    classes: tuple[DeviceClass, ...] = tuple(DeviceClass)
    is_error: bool = True
    alone: bool = True
    limit: float | None = None


@dataclass(frozen=True)
class Situation:
    """A case of a check, and the quantities that are graded in it.

    Attributes:
        check, case, graded: what is judged.
        condition: that of the check's limits, empty if they have none.
        description: of the device whose place the truth takes.
    """

    check: Check
    case: Case
    graded: tuple[Graded, ...]
    condition: str = ""
    description: Description = NOMINAL


@dataclass(frozen=True)
class Limit:
    """What became of one limit; all readings are shares of the limit.

    Attributes:
        check, quantity, device_class: which limit; the quantity with its condition.
        unspoilt: what the truth itself reads.
        too_much: what an error of `TOO_MUCH` times the limit reads.
        allowed: what one of `ALLOWED` times the limit reads.
        beside: largest reading of any other quantity meanwhile, with its name.
        is_error, alone: as `Graded` has it.
    """

    check: str
    quantity: str
    device_class: DeviceClass
    truth_reading: float
    too_much: float
    allowed: float
    beside: tuple[float, str]
    is_error: bool = True
    alone: bool = True

    @property
    def faults(self) -> tuple[str, ...]:
        """What does not hold, in words."""
        found = []
        if self.is_error and self.truth_reading > UNSPOILT:
            found.append(f"the truth itself reads {self.truth_reading:.2f} of it")
        if not self.too_much > 1.0:
            found.append(f"{TOO_MUCH} times the limit passes")
        if not self.allowed <= 1.0:
            found.append(f"{ALLOWED} times the limit fails")
        for put, read in ((TOO_MUCH, self.too_much), (ALLOWED, self.allowed)):
            if abs(read / put - 1.0) > TOLERANCE:
                found.append(f"{put} times the limit reads {read:.2f}")
        if self.alone and self.beside[0] > 1.0:
            found.append(f"{ALLOWED} times the limit fails {self.beside[1]}")
        return tuple(found)


def grade(situation: Situation, roads: Roads) -> Iterator[Limit]:
    """Yield every limit of ``situation``'s graded quantities, once judged on both sides."""
    judge = _Judge(situation, roads)
    for graded in situation.graded:
        for device_class in graded.classes:
            truth = _worst(judge(None, 0.0), graded.names, device_class)
            if truth is None:
                continue
            limit = graded.limit or truth.limits[device_class]
            much, little = (judge(graded, factor * limit) for factor in (TOO_MUCH, ALLOWED))
            name = graded.names[0]
            yield Limit(
                situation.check.id,
                f"{name}, {situation.condition}" if situation.condition else name,
                device_class,
                truth.ratio(device_class),
                _ratio(much, graded.names, device_class),
                _ratio(little, graded.names, device_class),
                _beside(little, graded.names, device_class),
                graded.is_error,
                graded.alone,
            )


@dataclass
class _Judge:
    """Judges each amount of each error once, however many classes have that limit."""

    situation: Situation
    roads: Roads
    done: dict[tuple[str, float], Sequence[Measurement]] = field(default_factory=dict)

    def __call__(self, graded: Graded | None, amount: float) -> Sequence[Measurement]:
        key = ("" if graded is None else graded.names[0], round(amount, 9))
        if key not in self.done:
            spoil = keep_profile if graded is None else graded.put(amount)
            bench = TruthBench(self.roads, spoil, self.situation.description)
            self.done[key] = self.situation.check.judge(self.situation.case, bench)
        return self.done[key]


def _worst(
    measured: Sequence[Measurement], names: tuple[str, ...], device_class: DeviceClass
) -> Measurement | None:
    here = [m for m in measured if m.quantity in names and device_class in m.limits]
    return max(here, key=lambda m: m.ratio(device_class), default=None)


def _ratio(
    measured: Sequence[Measurement], names: tuple[str, ...], device_class: DeviceClass
) -> float:
    worst = _worst(measured, names, device_class)
    return 0.0 if worst is None else worst.ratio(device_class)


def _beside(
    measured: Sequence[Measurement], names: tuple[str, ...], device_class: DeviceClass
) -> tuple[float, str]:
    others = [(m.ratio(device_class), m.quantity) for m in measured if m.quantity not in names]
    return max(others, default=(0.0, ""))


def find_ungraded(check: Check, limits: Sequence[Limit]) -> tuple[str, ...]:
    """Return quantity and class of every limit that ``check`` publishes and none of ``limits`` is.

    A class that has no number in words has no limit.
    """
    done = {(limit.quantity, limit.device_class) for limit in limits if limit.check == check.id}
    return tuple(
        f"{check.id}: {quantity}, class {device_class}"
        for quantity, device_class in _list_published(check.limits)
        if (quantity, device_class) not in done
    )


def _list_published(
    limits: Mapping[str, Mapping[DeviceClass, str]],
) -> Iterator[tuple[str, DeviceClass]]:
    for quantity, words in limits.items():
        for device_class, word in words.items():
            if any(c.isdigit() for c in word):
                yield quantity, device_class
