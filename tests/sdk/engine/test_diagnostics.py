"""`run` with diagnostics: the record of the innovations, and nothing else changes."""

import numpy as np
import pytest

from floatref.engine.run import run
from floatref.errors import InputError
from floatref.interfaces.drop_out import DropOut

PIPELINE = "road-prior-smoother"


@pytest.fixture
def both(steady):
    """Return a run with and one without diagnostics."""
    times = np.arange(6000) / 500.0
    height = 0.3 + 0.005 * np.cos(7.0 * times) + 4e-5 * np.random.default_rng(0).normal(size=6000)
    made = steady(12.0, 500.0, height=height)
    return run(made, PIPELINE, diagnostics=True), run(made, PIPELINE)


def test_the_record_has_them_if_asked(both):
    kept, plain = both
    (kinds,) = kept.profile.provenance["innovations"].values()
    assert kinds["height"]["count"] == pytest.approx(6000, abs=5)
    assert "innovations" not in plain.profile.provenance
    assert not plain.innovations
    (own,) = kept.innovations.values()
    assert own["height"].count == kinds["height"]["count"]


def test_the_profile_is_the_same_bit_for_bit(both):
    kept, plain = both
    for one, other in zip(kept.profile.tracks, plain.profile.tracks, strict=True):
        np.testing.assert_array_equal(one.elevation, other.elevation)
        np.testing.assert_array_equal(one.sigma, other.sigma)
        np.testing.assert_array_equal(one.valid, other.valid)
    rest = {k: v for k, v in kept.profile.provenance.items() if k != "innovations"}
    assert rest == dict(plain.profile.provenance)


@pytest.mark.parametrize("pipeline", ["temporal-hpf", "spatial-basic"])
def test_a_pipeline_without_a_filter_is_refused(steady, pipeline):
    with pytest.raises(InputError, match=rf"^pipeline {pipeline}: has no filter with innovations"):
        run(steady(), pipeline, diagnostics=True)


def test_a_fall_back_adds_nothing_to_the_record(steady, monkeypatch):
    """Another pipeline fills a gap of the height; its innovations are not the profile's."""
    from floatref.engine.plugins import Plugins

    asked = []

    def answer(self, drop_out: DropOut):
        asked.append(drop_out.process(PIPELINE).provenance)
        return

    monkeypatch.setattr(Plugins, "fall_back", answer)
    height = 0.3 + 0.005 * np.cos(np.arange(4000) * 0.007)
    height[1500:2600] = np.nan
    result = run(steady(height=height), PIPELINE, diagnostics=True)
    assert "innovations" in result.profile.provenance
    assert asked
    assert "innovations" not in asked[0]
