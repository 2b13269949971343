"""The search for failing cases, and the simplest case that still fails.

A failing case is judged like any other case, and simplified by `simplify`; an error of the suite
ends the search. The number of cases is fixed, and the same seed draws the same cases.

The budget is a number of cases, so that the same run finds the same case on any machine.
Hypothesis' own shrinking is limited by time, and does not minimise the count of changed numbers.
"""

import zlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from importlib.util import find_spec
from unittest import mock

from floatref.errors import InputError, missing_extra
from floatref_conformance.checks.case import FROM_DEVICE, Case
from floatref_conformance.checks.interface import Check

FARTHEST = 1e3
"""Largest ratio of value to limit that the search distinguishes; faults count as this ratio."""


def check_installed() -> None:
    """Raise InputError now if the package that searches is missing."""
    if find_spec("hypothesis") is None:
        raise missing_extra("the search for failing cases needs hypothesis", "conformance")


def search(check: Check, seed: int, count: int, judge: Callable[[Case], float]) -> None:
    """Call ``judge`` with ``count`` cases of ``check``, drawn towards its largest value.

    ``judge`` returns the largest ratio of value to limit of a case; its exceptions are passed on.
    """
    if count < 1:
        return
    import hypothesis
    from hypothesis import HealthCheck, Phase, Verbosity, given, settings, target

    tried = 0
    raised: list[BaseException] = []

    @hypothesis.seed(zlib.crc32(f"{seed} {check.id}".encode()))
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        derandomize=False,
        phases=(Phase.generate, Phase.target),
        suppress_health_check=list(HealthCheck),
        verbosity=Verbosity.quiet,
    )
    @given(check.strategy())
    def attempt(case: Case) -> None:
        nonlocal tried
        if tried < count and not raised:
            tried += 1
            try:
                ratio = judge(case)
            except (Exception, SystemExit) as error:
                raised.append(error)
            else:
                target(min(ratio, FARTHEST))

    with _without_constants():
        attempt()
    if raised:
        raise raised[0]


@contextmanager
def _without_constants() -> Iterator[None]:
    """Prevent Hypothesis from drawing constants of the modules that are imported."""
    from hypothesis.internal.conjecture.providers import HypothesisProvider

    nothing = mock.Mock(return_value=None)
    with mock.patch.object(HypothesisProvider, "_maybe_draw_constant", nothing, create=True):
        yield


def simplify(case: Case, base: Case, budget: int, fails: Callable[[Case], bool]) -> Case:
    """Return a case that still ``fails``, with few numbers that differ from those of ``base``.

    First all numbers are taken from ``base`` at once, then halves of them, down to single ones,
    until no more can be replaced or ``budget`` cases have been tried.
    """
    shrinker = _Shrinker(base, budget, fails)
    names = _differing_names(case, base)
    size = len(names)
    while size and shrinker.left:
        for start in range(0, len(names), size):
            case = shrinker.try_without(case, names[start : start + size])
        names = _differing_names(case, base)
        size = min(size // 2, len(names)) if size > 1 else 0
    return case


@dataclass
class _Shrinker:
    base: Case
    left: int
    fails: Callable[[Case], bool]
    tried: set[Case] = field(default_factory=set)

    def try_without(self, case: Case, names: Sequence[str]) -> Case:
        """Return ``case`` with ``names`` as in the base, if that case still fails."""
        try:
            simpler = _replace_numbers(case, self.base, names)
        except InputError:
            return case
        if not names or not self.left or simpler == case or simpler in self.tried:
            return case
        self.left -= 1
        self.tried.add(simpler)
        return simpler if self._fails(simpler) else case

    def _fails(self, case: Case) -> bool:
        """Return whether a case fails; numbers that make no drive do not fail."""
        try:
            return self.fails(case)
        except InputError:
            return False


def _differing_names(case: Case, base: Case) -> list[str]:
    """Return the names of the numbers that differ between two cases."""
    names = [
        f.name
        for f in fields(case.scenario)
        if f.name not in FROM_DEVICE
        and getattr(case.scenario, f.name) != getattr(base.scenario, f.name)
    ]
    own = {*case.variation, *base.variation}
    return names + sorted(n for n in own if case.variation.get(n) != base.variation.get(n))


def _replace_numbers(case: Case, base: Case, names: Sequence[str]) -> Case:
    """Return ``case`` with the numbers ``names`` taken from ``base``."""
    known = {f.name for f in fields(case.scenario)}
    scenario = {n: getattr(base.scenario, n) for n in names if n in known}
    variation = dict(case.variation)
    for name in names:
        if name not in known:
            variation.pop(name, None)
            if name in base.variation:
                variation[name] = base.variation[name]
    return replace(case, scenario=replace(case.scenario, **scenario), variation=variation)
