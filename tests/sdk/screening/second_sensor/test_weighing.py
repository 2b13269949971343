"""Doubts of a whole recording: who hears of them, and how long runs are put together."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.screening.damage.damaged_samples import Damage
from floatref.screening.damage.spikes import find_spikes
from floatref.screening.findings import Facts, Screening
from floatref.screening.second_sensor import weighing
from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.weighing import weigh_recording
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.needs import Needs
from floatref.values.recording import Channel, Recording
from floatref_conformance.faults.fault_list import FAULTS
from floatref_conformance.proving_ground import Scenario, simulate

LEFT, RIGHT = (ChannelId("height", track) for track in ("left", "right"))
BODY = ChannelId("sprung_specific_force", "left")


@pytest.fixture(scope="module")
def healthy() -> Recording:
    return simulate(Scenario(rate_hz=1000.0, length_m=400.0)).recording


def screened(recording: Recording, doubt: Doubt, needs: Needs | None = None) -> Screening:
    """Return the screening of ``recording`` with one ``doubt``."""
    facts = Facts(recording)
    facts.__dict__["doubts"] = (doubt,)
    return replace(Screening.of(recording, needs), facts=facts)


def test_a_fatal_doubt_refuses_a_pipeline_that_reads_the_channel(healthy: Recording) -> None:
    with pytest.raises(InputError, match="exchanged"):
        _ = screened(healthy, Doubt((LEFT, RIGHT), "exchanged", True)).cautions


def test_a_pipeline_that_reads_one_of_two_suspects_is_warned(healthy: Recording) -> None:
    found = screened(healthy, Doubt((LEFT, BODY), "one of both", True))
    assert "one of both" in found.cautions
    assert found.doubts


def test_a_pipeline_that_does_not_read_it_hears_nothing(healthy: Recording) -> None:
    found = screened(healthy, Doubt((BODY,), "wrong", True))
    assert "wrong" not in found.cautions
    assert not found.doubts


def test_a_doubt_that_is_not_fatal_is_a_warning(healthy: Recording) -> None:
    assert "a line" in screened(healthy, Doubt((LEFT,), "a line")).cautions


@pytest.mark.slow
@pytest.mark.parametrize("pieces", [1, 2])
def test_a_fault_of_the_whole_run_is_one_however_long_the_run(
    healthy: Recording, pieces: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert not weigh_recording(healthy)
    monkeypatch.setattr(weighing, "PIECE_S", 20.0 / pieces)
    (doubt,) = weigh_recording(FAULTS["laser-scale-2"].damage(healthy))
    assert doubt.suspects == (LEFT,)
    assert doubt.whole_run
    assert doubt.fatal


@pytest.mark.slow
def test_in_a_long_run_a_piece_that_is_wrong_is_a_stretch(
    healthy: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(weighing, "PIECE_S", 6.0)

    def halve(name: ChannelId, values: FloatArray) -> FloatArray:
        if name != ChannelId("vertical_specific_force", "left"):
            return values
        rest = 9.80665
        late = np.arange(values.size) > 0.7 * values.size
        return np.where(late, rest + 0.5 * (values - rest), values)

    channels = tuple(replace(c, values=halve(c.id, c.values)) for c in healthy.channels)
    found = [d for d in weigh_recording(replace(healthy, channels=channels)) if not d.whole_run]
    assert found
    assert all(not doubt.fatal for doubt in found)
    assert all(doubt.spans[0][0] > 9.0 for doubt in found)


def test_a_channel_is_looked_through_for_spikes_once_however_long_the_run(
    healthy: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked: list[ChannelId] = []

    def count(channel: Channel) -> Damage:
        looked.append(channel.id)
        return find_spikes(channel)

    monkeypatch.setattr(weighing, "find_spikes", count)
    monkeypatch.setattr(weighing, "PIECE_S", 5.0)
    weigh_recording(healthy)
    assert looked
    assert len(looked) == len(set(looked))
