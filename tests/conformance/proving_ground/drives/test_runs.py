import numpy as np
import pytest

from floatref.errors import InputError
from floatref_conformance.proving_ground.drives.drive import Motion
from floatref_conformance.proving_ground.drives.runs import RUNS, run_drive
from floatref_reference.chapter_5.section_5_6 import V_ON

STEP_S = 2.5e-4
G = 9.80665
STOPS = [name for name, run in RUNS.items() if run.kind == "stop"]
BRAKES = [name for name, run in RUNS.items() if run.kind in ("braking", "near-stop")]


def sampled(name: str) -> tuple[np.ndarray, Motion]:
    times = np.arange(0.0, run_drive(name).duration_s, STEP_S)
    return times, run_drive(name).motion(times)


def published(name: str) -> tuple[float, float, float]:
    run = RUNS[name]
    assert run.mean_deceleration_g is not None
    assert run.event_location_m is not None
    return run.mean_deceleration_g, run.event_location_m, run.dwell_s or 0.0


def test_there_are_17_runs_and_the_reference_as_tables_5_1_and_5_2_print_them() -> None:
    kinds = [run.kind for run in RUNS.values()]
    assert [kinds.count(k) for k in ("stop", "near-stop", "braking", "constant")] == [7, 1, 7, 3]
    assert published("sg_10.7s_0.20g") == (0.2, 216.5, 10.7)
    assert published("sg_2.1s_0.33g") == (0.329, 216.6, 2.1)
    assert published("brk_49-34_0.84g") == (0.842, 197.6, 0.0)
    assert published("ns_72-11_0.20g") == (0.196, 215.1, 2.19)


@pytest.mark.parametrize("name", STOPS)
def test_a_stop_has_its_published_place_dwell_and_mean(name: str) -> None:
    mean_g, place_m, dwell_s = published(name)
    times, motion = sampled(name)
    standing = np.flatnonzero(motion.speed == 0.0)
    assert motion.distance[standing[0]] == pytest.approx(100.0 + place_m, abs=0.01)
    assert np.ptp(times[standing]) == pytest.approx(dwell_s, abs=0.001)
    slowing = slice(standing[0], 0, -1)
    passed = np.interp([0.5 / 3.6, 70.5 / 3.6], motion.speed[slowing], times[slowing])
    mean = 70.0 / 3.6 / (passed[0] - passed[1])
    assert mean / G == pytest.approx(mean_g, rel=0.01)
    assert motion.speed[0] == pytest.approx(72 / 3.6)
    assert motion.speed[-1] == pytest.approx(58 / 3.6)


@pytest.mark.parametrize("name", BRAKES)
def test_a_brake_has_its_published_release_speeds_and_mean(name: str) -> None:
    mean_g, place_m, _ = published(name)
    times, motion = sampled(name)
    release = int(np.searchsorted(motion.distance, 100.0 + place_m))
    applied = int(np.flatnonzero(motion.acceleration < 0)[0])
    assert abs(motion.acceleration[release - 4]) > 0.8 * mean_g * G
    assert abs(motion.acceleration[release + 4]) < 0.05 * G
    lost = motion.speed[applied - 1] - motion.speed[release]
    assert lost / (times[release] - times[applied]) / G == pytest.approx(mean_g, rel=0.01)
    assert motion.speed[0] * 3.6 == pytest.approx(RUNS[name].initial_speed_kmh)
    assert motion.speed[release] * 3.6 == pytest.approx(RUNS[name].event_speed_kmh, abs=0.02)
    assert motion.speed[-1] * 3.6 == pytest.approx(RUNS[name].final_speed_kmh)


def test_the_braking_run_of_figure_5_2_brakes_over_its_published_stretch() -> None:
    times, motion = sampled("brk_49-23_0.18g_b")
    braking = np.flatnonzero(motion.acceleration < 0)
    stretch = motion.distance[braking[[0, -1]]] - 100.0
    np.testing.assert_allclose(stretch, [176.4, 218.6], atol=1.0)
    assert np.ptp(times[braking]) == pytest.approx(4.2, abs=0.1)


def test_the_near_stop_coasts_over_its_published_stretch() -> None:
    times, motion = sampled("ns_72-11_0.20g")
    release = int(np.searchsorted(motion.distance, 315.1))
    coasting = release + np.flatnonzero(motion.acceleration[release:] < 0)
    np.testing.assert_allclose(motion.distance[coasting[[0, -1]]], [315.1, 320.9], atol=0.05)
    assert np.ptp(times[coasting]) == pytest.approx(2.19, abs=0.001)


@pytest.mark.slow
def test_constant_runs_keep_their_speed() -> None:
    slow, fast = (sampled(name)[1].speed for name in ("const_16", "ref_72"))
    assert np.ptp(slow) == np.ptp(fast) == 0.0
    assert fast[0] * 3.6 == pytest.approx(72.0, rel=0.01)
    # Print calls it 16 km/h, but local suppression, which begins below 10 mph (16.09 km/h), was not
    # activated (5.6): it is what rounds to 16 and lies above, not 16 within 1 %.
    assert V_ON < slow[0] < 16.5 / 3.6
    creep = sampled("const_5")[1].speed * 3.6
    assert creep.min() == pytest.approx(4.0)
    assert creep.max() == pytest.approx(5.0)
    assert creep.mean() == pytest.approx(4.5, abs=0.05)


@pytest.mark.parametrize("name", RUNS)
def test_every_run_goes_on_beyond_the_scored_section(name: str) -> None:
    assert run_drive(name).length_m >= 100.0 + 280.9 + 110.0


def test_an_unknown_run_is_named() -> None:
    with pytest.raises(InputError, match="run sg_99: unknown; choose from sg_1"):
        run_drive("sg_99")
