"""The search: Hypothesis draws further cases and moves towards the limit.

Nothing is raised from within: a case that fails is judged like any other, and made simpler by
`shrinking`. The number of cases is fixed, and the same seed draws the same ones.
"""

import zlib
from collections.abc import Callable

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check

FARTHEST = 1e3
"""Ratios of value to limit beyond this, and faults, are all as bad."""


def search(check: Check, seed: int, count: int, judge: Callable[[Case], float]) -> None:
    """Have ``judge`` try ``count`` cases of ``check``, drawn towards the largest it returns.

    ``judge`` returns the largest ratio of value to limit that it found.
    """
    if count < 1:
        return
    import hypothesis
    from hypothesis import HealthCheck, Phase, Verbosity, given, settings, target

    tried = 0

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
        if tried < count:
            tried += 1
            target(min(judge(case), FARTHEST))

    attempt()
