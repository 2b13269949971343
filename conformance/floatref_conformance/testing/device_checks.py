"""The checks of the suite as tests of a device."""

from typing import ClassVar

import pytest

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Device
from floatref_conformance.events import Event
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry
from floatref_conformance.render.wording import reproduction
from floatref_conformance.runner import Plan, run
from floatref_conformance.verdict import Outcome


class DeviceChecks:
    """Subclass it under a name that pytest collects, and name the device.

    Every check is a test of its own. One that is not among ``checks``, that the device skips,
    or that does not apply to it, is skipped: what was not run never counts as passed.

    Attributes:
        device: its SPEC, as `conformance run --device` takes it, or the object itself.
        device_class: whose limits decide.
        checks: the ids of the checks to run; all of them if empty.
        seed: draws roads and noise.
        effort: sets the number of cases.
    """

    device: ClassVar[str | Device] = "builtin:temporal-adaptive-hpf-spatial-backward"
    device_class: ClassVar[str] = DeviceClass.NOMINAL.value
    checks: ClassVar[tuple[str, ...]] = ()
    seed: ClassVar[int] = 0
    effort: ClassVar[str] = Effort.QUICK.value

    @pytest.mark.parametrize("check", IDS)
    def test_the_device_passes(self, check: str) -> None:
        """Run one check and fail with its reason and the command that reproduces it."""
        registry = load_registry()
        if self.checks and check not in self.checks:
            pytest.skip("not selected")
        spec, device = self._named(registry)
        plan = Plan(
            spec=spec,
            device=device,
            checks=(registry.check(check),),
            device_class=DeviceClass(self.device_class),
            seed=self.seed,
            effort=Effort(self.effort),
            ahead=True,
        )
        result = run(plan, _ignore)
        (judged,) = result.checks
        if judged.outcome in (Outcome.SKIP, Outcome.NOT_APPLICABLE):
            pytest.skip(judged.reason)
        if judged.outcome is not Outcome.PASS:
            pytest.fail(
                f"{check}: {judged.reason}; reproduce with: {reproduction(result)}", pytrace=False
            )

    def _named(self, registry: Registry) -> tuple[str, Device]:
        """Return the device's SPEC, or its type's name, and the device."""
        if isinstance(self.device, str):
            return self.device, registry.device(self.device)
        return type(self.device).__name__, self.device


def _ignore(event: Event) -> None:
    """Take no note of ``event``."""
