"""Report on a mapped recording: the values of each channel, and what is implausible."""

from math import isfinite, nan
from typing import Any

from floatref.errors import InputError
from floatref.mapping.reading import Reading
from floatref.screening.plausibility import examine
from floatref.values.recording import Channel


def inspect_reading(reading: Reading) -> dict[str, Any]:
    """Return what `floatref channels --map --json` prints: channels, clocks and warnings.

    A reason why the recording cannot be processed is a warning here.
    """
    channels = reading.recording.channels
    warnings = list(reading.warnings)
    try:
        warnings += map(reading.name_natively, examine(reading.recording))
    except InputError as error:
        warnings.append(f"cannot be processed yet: {reading.name_natively(str(error))}")
    return {
        "channels": [_look(c, o) for c, o in zip(channels, reading.origins, strict=True)],
        "clocks": [dict(clock) for clock in reading.clocks],
        "skews": [dict(skew) for skew in reading.skews],
        "warnings": warnings,
    }


def _look(channel: Channel, native: str) -> dict[str, Any]:
    summary = channel.scan.summary
    begin, end = channel.span_s
    return {
        "channel": str(channel.id),
        "native": native,
        "unit": channel.unit,
        "count": summary.count,
        "missing": summary.missing,
        "rate_hz": rate if isfinite(rate := channel.mean_rate_hz) else nan,
        "begin_s": begin,
        "end_s": end,
        "least": summary.least,
        "mean": summary.mean,
        "greatest": summary.greatest,
    }
