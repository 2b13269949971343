"""Grade the limits: an error of 1.5 times a limit fails, one of 0.67 times passes."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check, Taken
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import Description
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.proving_ground.scenario import Scenario

NOMINAL = Description("perfect", "1", "temporal", ())
AddError = Callable[[Profile, Taken, str], Profile]
"""Puts an error into the perfect profile of a recording; the label names it in the case."""


def keep_profile(profile: Profile, taken: Taken, label: str) -> Profile:
    """Return ``profile``."""
    return profile


@dataclass
class Roads:
    """Recordings and their perfect profiles, simulated once for all errors."""

    taken: dict[Scenario, Taken] = field(default_factory=dict)

    def of(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario``."""
        if scenario not in self.taken:
            self.taken[scenario] = make_taken(scenario)
        return self.taken[scenario]


@dataclass(frozen=True)
class TruthBench:
    """Answers every recording with its filtered truth, changed by ``add_error``."""

    roads: Roads
    add_error: AddError = keep_profile
    description: Description = NOMINAL

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels of the capabilities."""
        return self.roads.of(restrict_channels(self.description, scenario))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the truth with the error."""
        return self.add_error(make_perfect(taken), taken, label)


TOO_MUCH, ALLOWED = 1.5, 0.67
TOLERANCE = 0.15
"""Largest deviation of the measured error from the known one, as a share of it."""
LARGEST_OF_TRUTH = 0.2
"""Largest value measured of the truth itself, as a share of the limit of an error."""
Put = Callable[[float], AddError]
"""Returns a function that puts in an error of the given size, in the unit of the quantity."""


@dataclass(frozen=True)
class Graded:
    """One quantity of one case, and the function that puts in an error of it.

    Attributes:
        names: names of its measurements; more than one where the better one counts.
        put: puts in the error.
        classes: the classes for which it is graded.
        is_error: whether its value for the truth itself is nearly 0.
        alone: whether all other quantities are within their limits at two thirds of this one.
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
        condition: the condition of the check's limits; empty for limits without one.
        description: description of the device that the truth replaces.
    """

    check: Check
    case: Case
    graded: tuple[Graded, ...]
    condition: str = ""
    description: Description = NOMINAL


@dataclass(frozen=True)
class Limit:
    """The result of one limit; all values are shares of the limit.

    Attributes:
        check, quantity, device_class: which limit; the quantity with its condition.
        truth_reading: value measured of the truth itself.
        too_much: value measured of an error of `TOO_MUCH` times the limit.
        allowed: value measured of an error of `ALLOWED` times the limit.
        beside: largest value of any other quantity at that error, with its name.
        is_error, alone: as in `Graded`.
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
        """The faults of the limit, one sentence each."""
        found = []
        if self.is_error and self.truth_reading > LARGEST_OF_TRUTH:
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
    """Yield every limit of ``situation``'s graded quantities, judged on both sides."""
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
    """Judges each size of each error once, also if several classes have the same limit."""

    situation: Situation
    roads: Roads
    done: dict[tuple[str, float], Sequence[Measurement]] = field(default_factory=dict)

    def __call__(self, graded: Graded | None, amount: float) -> Sequence[Measurement]:
        key = ("" if graded is None else graded.names[0], round(amount, 9))
        if key not in self.done:
            add_error = keep_profile if graded is None else graded.put(amount)
            bench = TruthBench(self.roads, add_error, self.situation.description)
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
    """Return quantity and class of every published limit of ``check`` that is not in ``limits``.

    A class whose text has no number has no limit.
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
