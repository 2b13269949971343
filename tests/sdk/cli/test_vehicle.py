"""`floatref vehicle`: the estimates of a vehicle from its runs go to the next one."""

import json
from collections.abc import Callable
from dataclasses import replace
from math import sqrt
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.cli.vehicle import combine_estimates
from floatref.files import read_profile, write_profile, write_recording
from floatref_conformance.proving_ground import Scenario, simulate

STOP: dict[str, Any] = {
    "rate_hz": 1000.0,
    "length_m": 160.0,
    "profile_interval_m": 0.05,
    "tracks": ["left"],
    "manoeuvre": "stop",
    "speed_kmh": 50.0,
    "deceleration_g": 0.3,
    "dwell_s": 1.2,
    "event_at_m": 90.0,
    "final_speed_kmh": 25.0,
    "vehicle": "soft-van",
    "iri_m_per_km": 1.0,
    "laser_ahead_m": 0.0,
}
OURS = ("--pipeline", "road-prior-smoother")


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory, ran) -> Path:
    """Return a folder of two runs of one vehicle, and their profiles `first` and `second`."""
    folder = tmp_path_factory.mktemp("vehicle")
    (folder / "runs").mkdir()
    for seed, name in enumerate(("first", "second")):
        scenario = Scenario.from_dict({**STOP, "seed": seed, "road_seed": seed})
        write_recording(simulate(scenario).recording, folder / "runs" / name)
        ran("process", folder / "runs" / name, "--out", folder / name, *OURS)
    return folder


@pytest.mark.slow
def test_runs_of_one_vehicle_tell_the_same_tilt(runs: Path) -> None:
    learned = [read_profile(runs / name).provenance["learned"] for name in ("first", "second")]
    apart = abs(learned[0]["tilt_expected"] - learned[1]["tilt_expected"])
    assert apart < 3.0 * (learned[0]["tilt_sigma"] + learned[1]["tilt_sigma"])
    # The soft van pitches by some 5 degrees at 1 g, nose down in a brake.
    assert all(-0.013 < one["tilt_expected"] < -0.006 for one in learned)


@pytest.mark.slow
def test_what_is_kept_goes_into_the_next_run(runs: Path, tmp_path: Path, ran) -> None:
    out = tmp_path / "van.json"
    result = ran("vehicle", runs / "first", runs / "second", "--out", out, "--json")
    report, written = json.loads(result.stdout), json.loads(out.read_text(encoding="utf-8"))
    assert report["settings"] == written
    assert (report["pipeline"], report["runs"]) == (OURS[1], 2)
    ran("process", runs / "runs" / "first", "--out", tmp_path / "p", *OURS, "--settings", out)
    profile = read_profile(tmp_path / "p")
    assert {name: profile.settings[name] for name in written} == written


@pytest.mark.slow
def test_the_table_has_a_line_for_every_run(runs: Path, tmp_path: Path, invoke) -> None:
    result = invoke("vehicle", runs / "first", runs / "second", "--out", tmp_path / "v.json")
    lines = [line for line in result.stdout.splitlines() if line]
    assert [line.split()[0] for line in lines[2:]] == [
        str(runs / "first"),
        str(runs / "second"),
        "kept",
    ]


@settings(max_examples=50)
@given(
    means=st.lists(st.floats(-0.02, 0.02), min_size=1, max_size=6),
    sigma=st.floats(1e-4, 0.01),
)
def test_as_sure_runs_are_averaged_and_the_sigma_is_that_of_one_more(
    means: list[float], sigma: float
) -> None:
    one = {"tilt_expected": 0.0, "tilt_sigma": 1.0}
    learned = [{**one, "lean_expected_rad": mean, "lean_sigma_rad": sigma} for mean in means]
    found, count = combine_estimates(learned), len(means)
    average = sum(means) / count
    assert found["lean_expected_rad"] == pytest.approx(average, abs=1e-12)
    variance = sum((mean - average) ** 2 for mean in means) / count
    assert found["lean_sigma_rad"] == pytest.approx(sqrt(sigma**2 / count + variance))
    assert found["tilt_sigma"] == pytest.approx(1.0 / sqrt(count))


@settings(max_examples=50)
@given(
    means=st.tuples(st.floats(-0.02, 0.02), st.floats(-0.02, 0.02)),
    sigmas=st.tuples(st.floats(1e-4, 0.01), st.floats(1e-4, 0.01)),
)
def test_the_surer_run_counts_for_more(
    means: tuple[float, float], sigmas: tuple[float, float]
) -> None:
    """Of two Gaussians the mean is as far from each as its variance is large."""
    one = {"lean_expected_rad": 0.0, "lean_sigma_rad": 1.0}
    learned = [
        {**one, "tilt_expected": mean, "tilt_sigma": sigma}
        for mean, sigma in zip(means, sigmas, strict=True)
    ]
    found, (a, b) = combine_estimates(learned), (sigma**2 for sigma in sigmas)
    expected = (b * means[0] + a * means[1]) / (a + b)
    assert found["tilt_expected"] == pytest.approx(expected, abs=1e-12)
    apart = a * b * (means[0] - means[1]) ** 2 / (a + b) ** 2
    assert found["tilt_sigma"] == pytest.approx(sqrt(a * b / (a + b) + apart))


def bare(profile: Path, at: Path) -> Path:
    """Write ``profile`` without what it has learned."""
    whole = read_profile(profile)
    write_profile(replace(whole, provenance={}), at)
    return at


def of_another_pipeline(profile: Path, at: Path) -> Path:
    write_profile(replace(read_profile(profile), pipeline="road-prior-smoother-imu"), at)
    return at


def spoilt(profile: Path, at: Path) -> Path:
    whole = read_profile(profile)
    learned = {**whole.provenance["learned"], "tilt_sigma": 0.0}
    write_profile(replace(whole, provenance={"learned": learned}), at)
    return at


def short(profile: Path, at: Path) -> Path:
    write_profile(replace(read_profile(profile), provenance={"learned": {"tilt": 1}}), at)
    return at


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (bare, "holds no estimate of a vehicle"),
        (of_another_pipeline, "pipeline is road-prior-smoother-imu"),
        (spoilt, "learned tilt_sigma is 0.0"),
        (short, "has to hold"),
    ],
)
def test_a_profile_that_cannot_be_taken_is_refused_in_a_line(
    runs: Path, tmp_path: Path, make: Callable[[Path, Path], Path], message: str, refused
) -> None:
    other, out = make(runs / "second", tmp_path / "other"), tmp_path / "v.json"
    line = refused("vehicle", runs / "first", other, "--out", out)
    assert message in line
    assert str(other) in line
    assert not out.exists()


def test_a_run_counts_once(runs: Path, tmp_path: Path, refused) -> None:
    assert "twice" in refused("vehicle", *[runs / "first"] * 2, "--out", tmp_path / "v.json")


@pytest.mark.slow
def test_two_passes_tell_the_slip_that_the_next_run_takes_off(tmp_path: Path, ran) -> None:
    """A brake and a pass at speed over one road, 6 % per g; the next run's axis is the road's."""
    passes = {"brake": ("braking", 1), "pass": ("constant", 2)}
    drive = {"rate_hz": 1000.0, "length_m": 420.0, "profile_interval_m": 0.05, "tracks": ["left"],
             "slip_percent_per_g": 6.0, "road_seed": 3, "speed_kmh": 72.0, "laser_ahead_m": 0.0,
             "event_at_m": 200.0, "deceleration_g": 0.3}  # fmt: skip
    for name, (manoeuvre, seed) in passes.items():
        made = simulate(Scenario.from_dict({**drive, "manoeuvre": manoeuvre, "seed": seed}))
        write_recording(made.recording, tmp_path / f"{name}.run")
        ran("process", tmp_path / f"{name}.run", "--out", tmp_path / name)
    out = tmp_path / "van.json"
    both = ("--slip", tmp_path / "brake", tmp_path / "pass")
    report = json.loads(ran("vehicle", *both, "--out", out, "--json").stdout)
    assert report["settings"]["slip_per_g"] == pytest.approx(0.06, abs=0.005)
    assert report["slip"]["stretches"] > 10
    assert "stretches" in ran("vehicle", *both, "--out", out, "--overwrite").stdout
    given = ("--settings", out, "--out", tmp_path / "again")
    ran("process", tmp_path / "brake.run", *given)
    before, after = (read_profile(tmp_path / n).length_m for n in ("brake", "again"))
    assert after - before == pytest.approx(0.06 * (20.0**2 - (11 / 3.6) ** 2) / 19.6, abs=0.15)
    record = read_profile(tmp_path / "again").provenance["distance"]
    assert record["source"] == "setting"


def test_neither_profiles_nor_passes_is_refused(tmp_path: Path, invoke) -> None:
    result = invoke("vehicle", "--out", tmp_path / "van.json")
    assert result.exit_code == 2
    assert "give PROFILEs, or --slip BRAKE PASS" in result.stderr
