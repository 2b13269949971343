"""Making a table: which passes are driven, what of them is averaged, and who is at fault."""

from itertools import product

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.files import write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.devices import builtin
from floatref_conformance.errors import SuiteError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import road_of
from floatref_conformance.table import TableSettings, make_table
from floatref_conformance.table.making import _drive, _references
from floatref_conformance.table.passes import (
    FITTED,
    SLIP_PERCENT_PER_G,
    Driven,
    Processing,
    draw_road,
    pass_scenario,
)
from floatref_conformance.table.published import published_figures
from floatref_conformance.table.table_settings import offered_pipelines

BRAKES = ("brk_72-29_0.39g", "brk_49-34_0.84g")
PIPELINES = ("temporal-basic", "spatial-basic")


@pytest.fixture(scope="module")
def watched():
    """A table of two runs and two pipelines, and the passes as they were announced."""
    seen = []
    settings = TableSettings(seed=3, roads=1, seeds=2, runs=BRAKES, pipelines=PIPELINES)
    return make_table(settings, seen.append), seen


@pytest.mark.slow
def test_every_pass_is_announced_and_every_wheel_path_counts(watched):
    table, seen = watched
    assert seen == [
        f"road 1, noise {noise}: {run}" for noise in (1, 2) for run in ("ref_72", *BRAKES)
    ]
    assert len(seen) == table.settings.passes
    assert [(c.pipeline, c.run) for c in table.cells] == list(product(PIPELINES, BRAKES))
    for cell in table.cells:
        assert len(set(cell.passes)) == 2 * 2
        mean = np.mean([s.peak_m_per_km for s in cell.passes])
        assert cell.mean.peak_m_per_km == pytest.approx(mean)


@pytest.mark.slow
def test_a_narrower_table_holds_the_same_figures(watched):
    table, _ = watched
    narrow = TableSettings(seed=3, roads=1, seeds=1, runs=BRAKES[1:], pipelines=PIPELINES[1:])
    (cell,) = make_table(narrow).cells
    assert cell.passes == table.cell(PIPELINES[1], BRAKES[1]).passes[:2]
    other = TableSettings(seed=4, roads=1, seeds=1, runs=BRAKES[1:], pipelines=PIPELINES[1:])
    assert not set(make_table(other).cells[0].passes) & set(cell.passes)


@pytest.mark.slow
def test_the_reference_pass_is_on_the_same_road_with_other_errors(watched):
    table, _ = watched
    for cell in table.cells:
        for scores in cell.passes:
            assert 0.3 < scores.cross_correlation < 1.0
            assert scores.peak_m_per_km > 1.0
    with pytest.raises(InputError, match="pipeline spatial-basic, run const_5: not in this table"):
        table.cell("spatial-basic", "const_5")


def test_no_two_passes_share_their_errors_nor_two_roads_their_shape():
    places = list(product(range(3), range(3)))
    made = [
        pass_scenario(run, 0, place, "minivan", frozenset())
        for run in ("ref_72", *BRAKES)
        for place in places
    ]
    assert len({s.seed for s in made}) == len(made)
    assert all((s.vehicle, s.imu, s.gnss) == ("minivan", False, False) for s in made)
    assert pass_scenario("ref_72", 0, (1, 2), "minivan", frozenset()) in made
    first, again, second = (draw_road(0, n).elevation["left"] for n in (0, 0, 1))
    assert np.array_equal(first, again)
    assert not np.allclose(first, second)


@pytest.mark.cites("5.2", "6.5")
def test_only_pipelines_of_chapter_6_read_an_encoder_that_does_not_slip(monkeypatch):
    driven = []

    def note(processing, scenario, name, road):
        driven.append((scenario.slip_percent_per_g, tuple(processing._devices)))

    monkeypatch.setattr(Processing, "drive", note)
    settings = TableSettings(runs=BRAKES[:1])
    list(_drive(settings, None, (0, 0), BRAKES[0], settings.pipelines))
    chapters = {name: figures.chapter for (name, _), figures in published_figures().items()}
    optical = [name for name in settings.pipelines if chapters.get(name) == 6]
    wheel = [name for name in settings.pipelines if name not in optical]
    assert len(optical) == 5
    assert driven == [(SLIP_PERCENT_PER_G, tuple(wheel)), (0.0, tuple(optical))]
    assert {pipeline for pipeline, _ in FITTED} <= set(wheel)


def test_each_pipeline_gets_the_channels_that_it_declares(monkeypatch, fake_device):
    devices = {"plain": fake_device(), "rich": fake_device(capabilities=("imu",))}
    monkeypatch.setattr(builtin, "make", devices.__getitem__)
    processing = Processing(tuple(devices))
    assert processing.capabilities == {"imu"}
    scenario = Scenario(length_m=20.0, rate_hz=1000.0, profile_interval_m=0.05)
    profiles = processing.profiles(scenario, road_of(scenario, 20.0))
    assert set(profiles) == set(devices)
    for name, more in (("plain", set()), ("rich", {"pitch_rate"})):
        ((recording, _, _, _),) = devices[name].seen
        assert name not in str(recording)
        given = {c.id.name for c in devices[name].seen[0][3].channels}
        assert {"vertical_specific_force", "height", "distance"} <= given
        assert given & {"pitch_rate", "gnss_height"} == more


def test_a_slip_moves_the_reference_along_the_encoder_and_leaves_it_along_the_true_distance():
    """Both encoders and the road in closed form: what counts is the road's place by each."""
    x = 0.05 * np.arange(8001)
    truth = Profile(0.05, (ProfileTrack.of("left", np.zeros(x.size)),))

    def road(true_m):
        return 0.01 * np.sin(true_m / 3.0)

    slow, lost = 1.001, 0.5 * np.clip((x - 150.0) / 40.0, 0.0, 1.0)
    by_reference = Profile(0.05, (ProfileTrack.of("left", road(x / slow)),))
    reference = Driven(truth, slow * x, {"temporal-basic": by_reference})
    plain, beside = _references(reference, Driven(truth, x - lost, {}))
    assert plain is by_reference
    found = beside.track("left").elevation[2000:7000]
    expected = road(np.interp(x[2000:7000], x - lost, x))
    assert found == pytest.approx(expected, abs=1e-5)


def run_of(profile):
    return lambda _device, _recording, target: write_profile(profile, target)


def spoilt(name):
    z = np.where(np.arange(10000) == 6000, np.nan, 0.01 * np.sin(np.arange(10000.0)))
    return Profile(0.05, tuple(ProfileTrack.of(n, z) for n in name))


def test_a_pipeline_that_fails_is_named_with_its_run(monkeypatch, small):
    def broken(_device, _recording, _target):
        raise ZeroDivisionError("out\nof luck")

    monkeypatch.setattr(builtin.BuiltinDevice, "run", broken)
    with pytest.raises(SuiteError, match=r"^pipeline temporal-basic, run ref_72: out of luck$"):
        make_table(small)


@pytest.mark.slow
def test_a_profile_with_a_hole_is_no_score(monkeypatch, small):
    monkeypatch.setattr(builtin.BuiltinDevice, "run", run_of(spoilt(("left", "right"))))
    with pytest.raises(SuiteError, match=r"^pipeline temporal-basic, run sg_5.*: track left: 1 of"):
        make_table(small)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"runs": ("brk_72-29",)}, "run brk_72-29: unknown; did you mean brk_72-29_0.39g?"),
        ({"runs": ("ref_72",)}, "run ref_72: unknown"),
        ({"pipelines": ("spatial-basics",)}, "did you mean spatial-basic?"),
        ({"vehicle": "tank"}, "vehicle tank: unknown"),
        ({"roads": 0}, "roads is 0; give 1 or more"),
        ({"seeds": -1}, "seeds is -1; give 1 or more"),
        ({"seed": -1}, "seed is -1; give 0 or more"),
    ],
)
def test_settings_that_make_no_table_are_refused(wrong, said):
    with pytest.raises(InputError) as refused:
        TableSettings(**wrong)
    assert said in str(refused.value)


def test_all_is_the_default_in_the_order_of_print():
    settings = TableSettings()
    assert settings == TableSettings(runs=(), pipelines=())
    assert settings.runs[0] == "sg_1.1s_0.17g"
    assert len(settings.runs) == 17
    assert set(settings.pipelines) == {entry.name for entry in builtin.entries()}
    assert settings.pipelines == offered_pipelines()
    assert settings.pipelines[:2] == ("temporal-basic", "temporal-mean-removal")
    assert TableSettings(pipelines=PIPELINES[::-1]).pipelines == PIPELINES
    assert settings.vehicle == Scenario().vehicle
