"""NEES of a device that states its 1-sigma: in the result of a run, and in its report."""

import json

import numpy as np
import pytest

from floatref.files import read_profile, write_profile
from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.judge.events import RunFinished
from floatref_conformance.render.report import JsonReport

SIGMA = 2e-3


@pytest.fixture
def stating(fake_device):
    """Return a function that makes a device ``off`` by so many of the sigma that it states."""

    def make(off):
        class Stating(fake_device):
            def run(self, recording, profile):
                super().run(recording, profile)
                made = read_profile(profile)
                tracks = tuple(
                    ProfileTrack.of(
                        t.name,
                        high_pass(t.elevation, made.interval_m) + off * SIGMA,
                        sigma=np.full(t.elevation.size, SIGMA),
                    )
                    for t in made.tracks
                )
                write_profile(Profile(made.interval_m, tracks), profile, overwrite=True)

        return Stating()

    return make


@pytest.mark.parametrize("off", [1.0, 2.0])
def test_it_is_the_square_of_the_errors_over_sigma(plan, result_of, stating, off):
    (check,) = result_of(plan(stating(off), searching=False)).checks
    assert check.nees is not None
    assert check.nees.wheel_paths == check.cases * 2
    for value in (check.nees.lowest, check.nees.median, check.nees.highest):
        assert value == pytest.approx(off**2, rel=0.02)
    assert check.nees.highest_case.startswith("toy-")


def test_the_report_has_it_for_a_device_with_sigma_alone(
    tmp_path, plan, result_of, stating, fake_device
):
    for device, there in ((stating(1.0), True), (fake_device(), False)):
        result = result_of(plan(device, searching=False))
        JsonReport.into(tmp_path).handle(RunFinished(result))
        (check,) = json.loads((tmp_path / "report.json").read_text())["checks"]
        assert ("nees" in check) is there
    assert result.checks[0].nees is None
