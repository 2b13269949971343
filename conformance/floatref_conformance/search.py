"""The search: Hypothesis draws further cases and moves towards the limit.

A case that fails is judged like any other, and made simpler by `shrinking`; an error of the suite
ends the search. The number of cases is fixed, and the same seed draws the same ones.
"""

import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from unittest import mock

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check
from floatref_conformance.errors import SuiteError

FARTHEST = 1e3
"""Ratios of value to limit beyond this, and faults, are all as bad."""


def search(check: Check, seed: int, count: int, judge: Callable[[Case], float]) -> None:
    """Have ``judge`` try ``count`` cases of ``check``, drawn towards the largest it returns.

    ``judge`` returns the largest ratio of value to limit that it found; what it raises is raised.
    """
    if count < 1:
        return
    try:
        import hypothesis
    except ImportError as error:
        raise SuiteError("the search needs: pip install 'floatref[conformance]'") from error
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

    with _by_the_seed_alone():
        attempt()
    if raised:
        raise raised[0]


@contextmanager
def _by_the_seed_alone() -> Iterator[None]:
    """Keep Hypothesis from drawing constants of whatever modules happen to be imported."""
    from hypothesis.internal.conjecture.providers import HypothesisProvider

    nothing = mock.Mock(return_value=None)
    with mock.patch.object(HypothesisProvider, "_maybe_draw_constant", nothing, create=True):
        yield
