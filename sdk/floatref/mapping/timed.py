"""A channel that clocks are aligned by: pulses, or readings of GNSS time."""

from dataclasses import dataclass

import numpy as np

from floatref.mapping.aligned import Aligned
from floatref.measures.pulses import pulse_times_at_rate, pulse_times_by
from floatref.values.arrays import FloatArray
from floatref.values.scanning import chunks


@dataclass(frozen=True, eq=False)
class Timed:
    """Samples ``values``, shape (N,), of a stream whose own clock is known; looked at in pieces."""

    values: FloatArray
    stream: Aligned

    @property
    def step_s(self) -> float:
        """Mean time between two samples in s."""
        last = self.values.size - 1
        begin, end = (float(self.stream.own_times(at, 1)[0]) for at in (0, last))
        return (end - begin) / max(last, 1)

    def pulses(self) -> FloatArray:
        """Return the times of the pulses in s on the own clock; InputError if there are none."""
        rate, start = self.stream.rate, self.stream.start_s
        if rate is not None:
            return pulse_times_at_rate(self.values, float(rate), start)
        return pulse_times_by(self.values, self.stream.own_times)

    def readings(self) -> tuple[FloatArray, FloatArray]:
        """Return where readings of GNSS time change: own times in s, and what is read there."""
        times, readings = [], []
        before = np.nan
        for first, part in chunks(self.values):
            new = np.flatnonzero((np.diff(part, prepend=before) != 0) & ~np.isnan(part))
            if part.size and new.size:
                times.append(self.stream.own_times(first, part.size)[new])
                readings.append(part[new])
            before = part[-1]
        if not times:
            return np.empty(0), np.empty(0)
        return np.concatenate(times), np.concatenate(readings)
