"""Small submissions: a toy check on a toy device, made once, and changed by tests."""

import json
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType

import numpy as np
import pytest
from tests.conformance.conftest import FakeDevice, ToyCheck

from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.editions import EDITION
from floatref_conformance.judge.runner import Plan, run
from floatref_conformance.registry import Registry
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.submission.case_collector import CaseCollector
from floatref_conformance.submission.checksums import SUMS, list_sums
from floatref_conformance.submission.device_again import GivenDevice
from floatref_conformance.submission.document import NAME as SUBMISSION
from floatref_conformance.submission.document import read_submission, write_json
from floatref_conformance.submission.packing import describe_plan, make_members
from floatref_conformance.submission.retracing import make_report
from floatref_conformance.submission.verifying import Wanted, read_results, verify

SPEC = "fake:device"
DEVICES = {
    "good": lambda: FakeDevice(),
    "clipping": lambda: FakeDevice(
        lambda t: {name: np.clip(z, -0.004, 0.004) for name, z in t.items()}
    ),
    "halving": lambda: FakeDevice(lambda t: {name: 0.5 * z for name, z in t.items()}),
}
KINDS = {"fake": DeviceKind("fake", "NAME", lambda name: DEVICES[name]())}
REGISTRY = Registry(KINDS, {"toy": ToyCheck()})
OTHER_EDITION = Registry(KINDS, {"toy": ToyCheck(count=3)})


def load(edition=EDITION):
    """Return the toy check as ``edition`` has it: another one draws other cases."""
    return REGISTRY if edition == EDITION else OTHER_EDITION


@cache
def made(name: str, **settings) -> MappingProxyType:
    """Return the members of the submission of a device, not to be changed."""
    plan = Plan(SPEC, DEVICES[name](), *REGISTRY.select(("toy",)), **settings)
    collected = CaseCollector(plan.device_class)
    run(plan, collected.handle)
    return MappingProxyType(make_members(plan, collected, describe_plan(plan, (), "We tried.")))


@dataclass
class Archive:
    """The members of a submission, which a test changes."""

    members: dict = field(default_factory=dict)

    def read(self, name):
        return json.loads(self.members[name])

    def edit(self, name, change):
        """Let ``change`` alter the JSON document of member ``name``."""
        document = self.read(name)
        change(document)
        self.members[name] = json.dumps(document).encode()

    def find(self, ending):
        """Return the name of the first member that ends like this."""
        return next(name for name in sorted(self.members) if name.endswith(ending))

    def folders(self, room):
        """Return the folders of a room of the archive, in order."""
        return sorted({"/".join(n.split("/")[:2]) for n in self.members if n.startswith(room)})

    def forge(self):
        """Make the report that follows from the results, as somebody with this suite can."""
        submission = read_submission(self.members[SUBMISSION])
        again = make_report(submission, read_results(self.members), load(submission.edition))
        self.members[REPORT] = write_json(again)

    def renew_sums(self):
        self.members.pop(SUMS, None)
        self.members[SUMS] = list_sums(self.members)

    def verify(self, device=None, signers=None, every_case=False):
        given = device and GivenDevice(SPEC, device)
        return verify(self.members, Wanted(signers, given, every_case), load)


@pytest.fixture
def archive():
    """Return a function that gives a submission of one of `DEVICES` to be changed."""
    return lambda name="clipping", **settings: Archive(dict(made(name, **settings)))


@pytest.fixture
def devices():
    return DEVICES
