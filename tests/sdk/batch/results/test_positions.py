"""Places on a drawn road, where the truth is known."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.batch.results.positions import is_located, places
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

EARTH_M = 6_371_000.0


@dataclass(frozen=True)
class Drive:
    """A road of one curvature, driven at speeds that change, with a stop."""

    latitude: float = 0.9
    longitude: float = 0.1
    heading: float = 0.7
    per_m: float = 0.0
    speed: float = 20.0
    stop_s: float = 0.0

    def distance(self, times: FloatArray) -> FloatArray:
        """How far it is at ``times``: half a minute, a stop, and half a minute again."""
        moving = np.where(times < 30.0, times, np.maximum(30.0, times - self.stop_s))
        # Slower and faster by half, at 0.25 rad/s; it stands for the time of the stop.
        wave = np.sin(0.25 * moving) / 0.25
        return np.asarray(self.speed * (moving + 0.5 * wave))

    def place(self, distance: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Latitude and longitude in rad, this one from -pi up to pi."""
        turn = self.heading + 0.5 * self.per_m * distance
        chord = distance * np.sinc(0.5 * self.per_m * distance / np.pi)
        north, east = chord * np.cos(turn), chord * np.sin(turn)
        longitude = self.longitude + east / EARTH_M / np.cos(self.latitude)
        turned = np.mod(longitude + np.pi, 2 * np.pi) - np.pi
        return self.latitude + north / EARTH_M, turned

    def recording(
        self, rate_hz: float, start_s: float = 0.0, spoilt: slice = slice(0)
    ) -> Recording:
        """The encoder at 200 Hz, and fixes at ``rate_hz`` from ``start_s`` on."""
        end_s = 60.0 + self.stop_s
        times = np.arange(round(200 * end_s)) / 200.0
        clock = UniformClock.of(rate_hz, start_s)
        fixes = clock.times(int((times[-1] - start_s) * rate_hz))
        latitude, longitude = self.place(self.distance(fixes))
        latitude[spoilt] = longitude[spoilt] = np.nan
        return Recording(
            (
                Channel.of("distance", self.distance(times), UniformClock.of(200.0)),
                Channel.of("gnss_latitude", latitude, clock),
                Channel.of("gnss_longitude", longitude, clock),
            )
        )

    def error_m(self, recording: Recording, wanted: FloatArray) -> FloatArray:
        """How far from the truth the places of ``wanted`` are, in m."""
        latitude, longitude = places(recording, "main", wanted)
        true_latitude, true_longitude = self.place(wanted)
        east = np.radians(longitude) - true_longitude
        assert np.all((np.abs(longitude) <= 180.0) | np.isnan(longitude))
        east = (np.mod(east + np.pi, 2 * np.pi) - np.pi) * np.cos(self.latitude)
        return np.asarray(EARTH_M * np.hypot(np.radians(latitude) - true_latitude, east))


drives = st.builds(
    Drive,
    latitude=st.floats(-1.2, 1.2),
    longitude=st.floats(-np.pi, np.pi),
    heading=st.floats(0.0, 2 * np.pi),
    per_m=st.floats(-1e-3, 1e-3),
    speed=st.floats(1.0, 18.0),
    stop_s=st.sampled_from([0.0, 3.0, 90.0]),
)


@settings(max_examples=60, deadline=None)
@given(drives, st.floats(1.0, 50.0), st.floats(0.0, 0.9))
def test_places_are_within_a_metre_of_the_truth(drive: Drive, rate_hz: float, late: float) -> None:
    recording = drive.recording(rate_hz, start_s=late / rate_hz)
    end = drive.distance(np.array([60.0 + drive.stop_s - 1.2]))[0]
    inside = np.linspace(drive.distance(np.array([late / rate_hz]))[0], end, 200)
    assert np.all(drive.error_m(recording, inside) < 1.0)


@given(st.sampled_from([-1.0, 1.0]), st.floats(-300.0, 300.0))
@settings(max_examples=30, deadline=None)
def test_the_meridian_of_the_date_is_no_border(east: float, before_m: float) -> None:
    heading, at = np.pi / 2 * east, np.pi - east * before_m / EARTH_M / np.cos(0.9)
    drive = Drive(longitude=at, heading=heading)
    assert np.all(drive.error_m(drive.recording(1.0), np.linspace(0.0, 1000.0, 77)) < 1.0)


def test_the_first_segment_has_a_place_although_the_first_fix_comes_late() -> None:
    drive = Drive()
    assert drive.error_m(drive.recording(1.0, start_s=0.9), np.array([0.0]))[0] < 1.0
    assert np.isnan(drive.error_m(drive.recording(10.0, start_s=0.9), np.array([0.0]))[0])


def test_where_it_stands_it_stays() -> None:
    drive = Drive(stop_s=120.0)
    stood = drive.distance(np.array([40.0]))
    assert drive.error_m(drive.recording(10.0), stood)[0] < 0.2


def test_a_gap_of_seconds_is_not_bridged_and_a_short_one_is() -> None:
    drive = Drive()
    short, long = (drive.recording(1.0, spoilt=slice(20, end)) for end in (24, 26))
    middle, after = (drive.distance(np.array([at])) for at in (22.0, 26.5))
    assert drive.error_m(short, middle)[0] < 1.0
    assert np.isnan(drive.error_m(long, middle)[0])
    assert drive.error_m(long, after)[0] < 1.0
    beside = drive.distance(np.array([19.0])) + 0.3
    assert drive.error_m(long, beside)[0] < 1.0


def test_beyond_the_fixes_nothing_is_known() -> None:
    drive = Drive()
    error = drive.error_m(drive.recording(10.0), np.array([-50.0, 1e5]))
    assert np.isnan(error).all()


def test_fixes_that_the_receiver_calls_none_do_not_count() -> None:
    drive = Drive()
    recording = drive.recording(10.0)
    latitude, longitude = (recording.channel(f"gnss_{name}") for name in ("latitude", "longitude"))
    wrong, quality = latitude.values.copy(), np.full(latitude.values.size, 4.0)
    wrong[100:120], quality[100:120] = 0.0, 0.0
    channels = (
        recording.channel("distance"),
        Channel.of("gnss_latitude", wrong, latitude.clock),
        longitude,
        Channel.of("gnss_quality", quality, latitude.clock),
    )
    wanted = drive.distance(np.linspace(5.0, 15.0, 60))
    assert np.all(drive.error_m(Recording(channels), wanted) < 1.0)


def test_a_spike_of_the_encoder_moves_no_place() -> None:
    drive = Drive()
    recording = drive.recording(10.0)
    spoilt = recording.channel("distance").values.copy()
    spoilt[2000] += 5000.0
    spoilt[3000:3010] = np.nan
    channels = (Channel.of("distance", spoilt, UniformClock.of(200.0)), *recording.channels[1:])
    assert np.all(drive.error_m(Recording(channels), np.linspace(0.0, 1000.0, 50)) < 1.0)


def test_fixes_on_a_clock_each_and_with_stamps() -> None:
    drive = Drive()
    recording = drive.recording(5.0)
    stamps = np.cumsum(np.random.default_rng(1).uniform(0.05, 0.5, 200))
    longitude = drive.place(drive.distance(stamps))[1]
    other = Channel.of("gnss_longitude", longitude, StampedClock.of(stamps))
    wanted = drive.distance(np.linspace(1.0, 40.0, 50))
    mixed = Recording((*recording.channels[:2], other))
    assert np.all(drive.error_m(mixed, wanted) < 1.0)


@pytest.mark.parametrize("missing", ["distance", "gnss_latitude", "gnss_longitude"])
def test_without_a_channel_there_is_no_place(missing: str) -> None:
    drive = Drive()
    kept = tuple(c for c in drive.recording(5.0).channels if c.id.name != missing)
    assert is_located(Recording(kept)) == (missing == "distance")
    for angle in places(Recording(kept), "main", np.array([1.0, 2.0])):
        assert np.isnan(angle).all()


@pytest.mark.parametrize("known", [0, 1])
def test_one_fix_is_no_way(known: int) -> None:
    drive = Drive()
    recording = drive.recording(5.0, spoilt=slice(known, None))
    assert np.isnan(drive.error_m(recording, np.array([100.0]))[0])
