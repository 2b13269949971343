"""One run of a device: what it sees, and what each thing it can do wrong leads to."""

import json
import sys

import numpy as np
import pytest

from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import Effort
from floatref_conformance.judge.exercise import MIN_INTERVAL_M
from floatref_conformance.proving_ground.scenario import LIMITS


@pytest.mark.parametrize(
    ("capabilities", "more"),
    [
        ((), set()),
        (("imu",), {"longitudinal_specific_force", "pitch_rate"}),
        (("gnss",), {"gnss_height"}),
    ],
)
def test_a_device_sees_nominal_and_declared_channels_alone(
    plan, result_of, fake_device, capabilities, more
):
    device = fake_device(capabilities=capabilities)
    result_of(plan(device))
    seen = {c.id.name for c in device.seen[0][3].channels}
    assert seen == {"vertical_specific_force", "height", "distance"} | more


def test_paths_are_neutral_hold_no_truth_and_are_new_in_every_case(plan, result_of, fake_device):
    device = fake_device()
    result_of(plan(device))
    paths = [recording for recording, *_ in device.seen]
    assert len(set(paths)) == len(paths) == 2 + Effort.QUICK.searched
    for recording, profile, existed, given in device.seen:
        assert not existed
        assert recording.name == "recording.json"
        assert profile.parent == recording.parent.parent
        assert not profile.parent.exists()
        assert "toy" not in str(recording)
        assert not any(word in str(recording) for word in ("truth", "seed", "case"))
        assert (given.vendor, given.model) == ("", "")


def test_truth_is_nowhere_under_the_paths_that_a_device_gets(plan, result_of, fake_device):
    files = []

    class Nosy(fake_device):
        def run(self, recording, profile):
            files.extend(p.name for p in profile.parent.rglob("*") if p.is_file())
            super().run(recording, profile)

    result_of(plan(Nosy()))
    channels = {"vertical_specific_force", "height", "distance"}
    assert {name.removesuffix(".f64").split(".")[-1] for name in files} - channels == {"json"}


class Quitter:
    def describe(self):
        return {"name": "q", "version": "1", "architecture": "spatial", "capabilities": []}

    def run(self, recording, profile):
        sys.exit(0)


class Raiser(Quitter):
    def run(self, recording, profile):
        raise ZeroDivisionError("no\nspeed")


class Babbler(Quitter):
    text = "{not json"

    def run(self, recording, profile):
        profile.mkdir()
        (profile / "profile.json").write_text(self.text)


class Stranger(Babbler):
    text = json.dumps({"format": "profile-of-ours/9", "interval_m": 0.05, "tracks": []})


class Mute:
    """A device that cannot even describe itself."""


@pytest.mark.parametrize(
    ("device", "words"),
    [
        (Mute, "describe"),
        (Quitter, "SystemExit"),
        (Raiser, "ZeroDivisionError: no speed"),
        (Babbler, "unusable profile"),
        (Stranger, "unusable profile"),
    ],
)
def test_a_device_that_crashes_or_babbles_is_an_error_and_fails(plan, result_of, device, words):
    result = result_of(plan(device()))
    assert result.verdict is Verdict.FAIL
    assert result.checks[0].outcome is Outcome.ERROR
    assert words in result.checks[0].reason
    assert "\n" not in result.checks[0].reason
    assert result.class_reached is None


def longer(tracks):
    return {name: np.append(z, np.zeros(10)) for name, z in tracks.items()}


def holed(tracks):
    z = tracks["left"].copy()
    z[500] = np.nan
    return {**tracks, "left": z}


def absurd(tracks):
    return {name: 1e300 * (1 + z) for name, z in tracks.items()}


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (longer, "the recording goes from"),
        (holed, "track left: 1 of 801 points without elevation from 10.0 m to 50.0 m"),
        (absurd, "elevation beyond 1e+06 m"),
    ],
)
def test_an_incomplete_profile_is_an_error_that_names_what_is_missing(
    plan, result_of, fake_device, spoil, words
):
    result = result_of(plan(fake_device(spoil)))
    assert result.verdict is Verdict.FAIL
    assert result.checks[0].outcome is Outcome.ERROR
    assert words in result.checks[0].reason


def test_a_missing_elevation_where_nothing_counts_is_no_error(plan, result_of, fake_device):
    def spoil(tracks):
        return {name: np.where(np.arange(z.size) < 10, np.nan, z) for name, z in tracks.items()}

    assert result_of(plan(fake_device(spoil))).verdict is Verdict.PASS


@pytest.mark.slow
def test_a_device_may_choose_its_interval_as_long_as_it_carries_the_iri(
    plan, result_of, fake_device
):
    assert result_of(plan(fake_device(interval_m=0.04))).verdict is Verdict.PASS
    close = plan(fake_device(interval_m=0.001), searching=False)
    assert result_of(close).verdict is Verdict.PASS
    for interval_m in (0.3, 0.00099):
        refused = result_of(plan(fake_device(interval_m=interval_m), searching=False))
        assert refused.verdict is Verdict.FAIL
        assert refused.checks[0].outcome is Outcome.ERROR
        assert f"interval_m is {interval_m:g};" in refused.checks[0].reason


def test_the_closest_interval_that_may_be_asked_for_may_be_delivered():
    assert LIMITS["profile_interval_m"][0] == MIN_INTERVAL_M


@pytest.mark.parametrize(
    "said",
    [
        "a fine device",
        {"name": "x"},
        {"name": "x", "version": "1", "architecture": "magic", "capabilities": []},
        {"name": "x", "version": "1", "architecture": "spatial", "capabilities": ["truth"]},
        {"name": "x", "version": "1", "architecture": "spatial", "capabilities": [[]]},
        {"name": "x", "version": "1", "architecture": "spatial"},
    ],
)
def test_a_device_that_describes_itself_wrongly_is_an_error(plan, result_of, fake_device, said):
    device = fake_device(said=said)
    result = result_of(plan(device))
    assert result.verdict is Verdict.FAIL
    assert result.checks[0].outcome is Outcome.ERROR
    assert device.seen == []


def test_faults_reported_twice_are_the_same_text(plan, result_of):
    texts = [result_of(plan(Babbler())).checks[0].reason for _ in range(2)]
    assert texts[0] == texts[1]
