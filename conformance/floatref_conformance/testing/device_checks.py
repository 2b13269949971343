"""The checks of the suite as tests of a device."""

import os
import shlex
from collections.abc import Callable, Sequence
from typing import ClassVar

import pytest

from floatref.values.display.similar_names import suggest
from floatref_conformance.checks.verdict import Outcome, RunResult
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Device
from floatref_conformance.editions import EDITION
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.events import Event
from floatref_conformance.judge.runner import Plan, run
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry
from floatref_conformance.render.wording import reproduction
from floatref_conformance.testing.own_device import OwnDevice


class DeviceChecks:
    """Subclass it under a name that pytest collects, and name the device.

    Every check, of the suite or of an installed plug-in, is a separate test. A check that is not
    among ``checks``, that the device skips, or that does not apply to it, is skipped: a check that
    was not run never counts as passed. An unknown check is a collection error.

    Attributes:
        device: its SPEC, as for `conformance run --device`; or a class or a function without
            arguments, whose object is made for each check and closed after it; or one object
            for all checks, which is never closed.
        device_class: the class whose limits decide.
        checks: the ids of the checks to run; all of them if empty.
        seed: draws roads and noise.
        effort: sets the number of cases.
        edition: name of the edition of the checks.
    """

    device: ClassVar[str | Callable[[], Device] | Device] = (
        "builtin:temporal-adaptive-hpf-spatial-backward"
    )
    device_class: ClassVar[str] = DeviceClass.NOMINAL.value
    checks: ClassVar[Sequence[str]] = ()
    seed: ClassVar[int] = 0
    effort: ClassVar[str] = Effort.QUICK.value
    edition: ClassVar[str] = EDITION

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Make every check that is registered a test; CollectError for an unknown one."""
        if "check" in metafunc.fixturenames:
            registry = load_registry(self.edition)
            self._refuse_unknown(registry)
            metafunc.parametrize("check", tuple(registry.checks))

    def test_the_device_passes(self, check: str, request: pytest.FixtureRequest) -> None:
        """Run one check and fail with its reason and the command that reproduces it."""
        registry = load_registry(self.edition)
        if self.checks and check not in self.checks:
            # Every registered check is a test; the class attribute ``checks`` names those to run.
            pytest.skip("not selected")
        spec, device = self._resolve(registry)
        plan = Plan(
            spec=spec,
            device=device,
            checks=(registry.check(check),),
            device_class=DeviceClass(self.device_class),
            seed=self.seed,
            effort=Effort(self.effort),
            ahead=True,
            edition=find_edition(self.edition),
        )
        result = run(plan, _ignore)
        (judged,) = result.checks
        if judged.outcome in (Outcome.SKIP, Outcome.NOT_APPLICABLE):
            # The judge tells why: no sensors for it, no package for it, or the device declined.
            pytest.skip(judged.reason)
        if judged.outcome is not Outcome.PASS:
            again = self._reproduction(result, request.node)
            pytest.fail(f"{check}: {judged.reason}; reproduce with: {again}", pytrace=False)

    def _refuse_unknown(self, registry: Registry) -> None:
        """Raise CollectError, one line, for an unknown check."""
        if isinstance(self.checks, str):
            fault = f"{self.checks!r} is a string; write ({self.checks!r},)"
        elif unknown := [id_ for id_ in self.checks if id_ not in registry.checks]:
            known = suggest(unknown[0], registry.checks, "these can be run:")
            fault = f"unknown check {', '.join(map(str, unknown))}; {known}"
        else:
            return
        raise pytest.Collector.CollectError(f"{type(self).__name__}.checks: {fault}")

    def _resolve(self, registry: Registry) -> tuple[str, Device]:
        """Return the device's SPEC, or its type's name, and the device."""
        # Not through self, which would be passed to a function as its first argument.
        device = type(self).device
        if isinstance(device, str):
            return device, registry.device(device)
        own = OwnDevice.of(device)
        return own.name, own

    def _reproduction(self, result: RunResult, test: pytest.Item) -> str:
        """Return the command that runs ``test`` again in the folder of this run."""
        if isinstance(type(self).device, str):
            return reproduction(result)
        path = os.path.relpath(test.path, test.config.invocation_params.dir)
        inside = test.nodeid.partition("::")[2]
        return shlex.join(["pytest", f"{path}::{inside}"])


def _ignore(event: Event) -> None:
    """Ignore ``event``."""
