"""When a vehicle passed a place, and when its point is due, by the encoder of a recording."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording
from floatref_conformance.devices.streams.answers import Latency

STEP_S = 0.05
"""Distance in s between the moments at which the encoder is looked at."""
MOVES_M = 0.1
"""Travel in m that is no standstill."""


@dataclass(frozen=True, eq=False)
class Passing:
    """Distance in m of a drive at moments in s, never decreasing; shape (N,) each."""

    times_s: FloatArray
    distance_m: FloatArray

    @classmethod
    def of(cls, recording: Recording) -> "Passing":
        """Return the passing by the encoder of ``recording``."""
        encoder = recording.channel("distance")
        begin_s, end_s = encoder.span_s
        times_s = np.arange(begin_s, end_s + STEP_S, STEP_S)
        known = np.isfinite(encoder.values)
        distance_m = np.interp(times_s, encoder.times_s[known], encoder.values[known])
        return cls(times_s, np.maximum.accumulate(distance_m))

    @property
    def end_s(self) -> float:
        """The last moment in s."""
        return float(self.times_s[-1])

    @property
    def marks_m(self) -> FloatArray:
        """Places in m at which points are asked for: every metre, but not both ends."""
        return np.arange(np.ceil(self.distance_m[0]) + 1.0, self.distance_m[-1] - 1.0)

    def reach(self, places_m: FloatArray) -> FloatArray:
        """Return the time in s at which each place was reached; infinite for one that was not."""
        index = np.searchsorted(self.distance_m, places_m)
        inside = np.minimum(index, self.times_s.size - 1)
        return np.where(index < self.times_s.size, self.times_s[inside], np.inf)

    def due_final(self, places_m: FloatArray, latency: Latency) -> FloatArray:
        """Return the time in s at which the point of each place is final by ``latency``."""
        passed_s = self.reach(places_m)
        gone_s = self.reach(places_m + latency.travelled_m) + latency.then_s
        due_s = np.minimum(gone_s, passed_s + latency.longest_s)
        if latency.standing_s is None:
            return due_s
        return np.minimum(due_s, self._stood(passed_s, latency.standing_s))

    def due_provisional(self, places_m: FloatArray, latency: Latency) -> FloatArray:
        """Return the time in s at which each place has a provisional point; infinite without."""
        if latency.provisional_s is None:
            return np.full(places_m.shape, np.inf)
        return self.reach(places_m) + latency.provisional_s

    def _stood(self, passed_s: FloatArray, standing_s: float) -> FloatArray:
        """Return when the vehicle has first stood for ``standing_s`` behind each moment."""
        before = self.times_s - standing_s
        gone = self.distance_m - np.interp(before, self.times_s, self.distance_m)
        stood_s = self.times_s[(before >= self.times_s[0]) & (gone < MOVES_M)]
        index = np.searchsorted(stood_s, passed_s)
        inside = np.minimum(index, max(stood_s.size - 1, 0))
        return (
            np.where(index < stood_s.size, stood_s[inside], np.inf)
            if stood_s.size
            else (np.full(passed_s.shape, np.inf))
        )
