"""MDF 4 and TDMS: what is written comes back on its own clock, bit by bit or within a quantum."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Channel, Recording, UniformClock
from floatref.engine.plugins import plugins
from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.mdf4 import write_mdf4
from floatref_adapters.testing.tdms import write_tdms

Make = Callable[..., st.SearchStrategy[Recording]]
Check = Callable[..., None]
VALUES = st.floats(-1e6, 1e6)


class Form(NamedTuple):
    """A format: names of wheel paths that it holds, and samples that it holds as integers."""

    adapter: Any
    write: Callable[..., None]
    tracks: st.SearchStrategy[str]
    samples: st.SearchStrategy[float | None]


FORMS = {
    "mdf4": Form(
        Mdf4(),
        write_mdf4,
        st.text("aß中 .#2", min_size=1, max_size=4).filter(lambda name: name == name.strip()),
        st.none() | VALUES,
    ),
    # TDMS has no mark of missing samples among integers.
    "tdms": Form(Tdms(), write_tdms, st.text("aß中 .'/#2", min_size=1, max_size=4), VALUES),
}
every_form = pytest.mark.parametrize("name", FORMS)


@pytest.mark.slow
@every_form
@settings(deadline=None, max_examples=40)
@given(data=st.data())
def test_a_recording_comes_back_to_the_last_bit(
    name: str,
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    recordings: Make,
    check_round_trip: Check,
) -> None:
    form = FORMS[name]
    recording = data.draw(recordings(form.tracks))
    path = tmp_path_factory.mktemp(name) / "run.dat"
    form.write(recording, path)
    assert form.adapter.recognises(path)
    check_round_trip(form.adapter, recording, path, lambda _: 0.0)


@pytest.mark.slow
@every_form
@settings(deadline=None, max_examples=25)
@given(data=st.data(), quantum=st.sampled_from([1e-6, 0.01, 0.3]))
def test_integers_are_within_half_a_quantum_and_missing_samples_stay_missing(
    name: str,
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    quantum: float,
    recordings: Make,
    check_round_trip: Check,
) -> None:
    form = FORMS[name]
    recording = data.draw(recordings(form.tracks, form.samples))
    path = tmp_path_factory.mktemp(name) / "run.dat"
    form.write(recording, path, {"height": quantum})
    stored = {"height": quantum / 2 + 4 * np.spacing(1e6)}
    check_round_trip(form.adapter, recording, path, lambda c: stored.get(c.id.name, 0.0))


@every_form
def test_floatref_finds_the_adapter_through_its_entry_point(name: str) -> None:
    assert plugins().adapters()[name].summary == FORMS[name].adapter.summary


def test_missing_samples_are_not_written_as_integers_of_tdms(tmp_path: Path) -> None:
    channel = Channel.of("height", np.array([1.0, np.nan]), UniformClock.of(10.0))
    with pytest.raises(ValueError, match="missing samples cannot be stored in integers"):
        write_tdms(Recording((channel,)), tmp_path / "a.tdms", {"height": 0.001})
