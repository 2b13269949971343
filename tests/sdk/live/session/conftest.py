"""Runs as messages, and peers that send them without another process."""

import io
import json
from io import BufferedReader, BytesIO
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from floatref.live.points import LivePoints, State, join_points
from floatref.live.session.live_run import LiveRun
from floatref.live.session.serving import Peer, Serving
from floatref.values.clock import StampedClock
from floatref.values.profile import ProfileTrack

LEGS = [(20.0, 100.0), (0.0, 8.0), (20.0, 60.0), (1.0, 10.0), (25.0, 60.0)]
"""Speeds in m/s and times in s: a stop, and creeping."""
NEVER_S = 3600.0
"""No test lasts as long: it saves with final points and at the end alone."""
PIPELINE = "temporal-basic"


def as_list(values):
    return [None if np.isnan(v) else v for v in values.tolist()]


def hello_of(recording, pipeline=PIPELINE, **more):
    channels = []
    for c in recording.channels:
        entry = {"name": c.id.name, "unit": c.unit}
        if c.id.track is not None:
            entry["track"] = c.id.track
        if not isinstance(c.clock, StampedClock):
            entry |= {"rate_hz": float(c.clock.rate), "start_s": c.clock.start_s}
        channels.append(entry)
    setup = {"profile_interval_m": recording.setup.profile_interval_m}
    return {
        "kind": "hello",
        "format": "floatref-live/1",
        "pipeline": pipeline,
        "setup": setup,
        "channels": channels,
        "provisional": False,
        **more,
    }


def samples_of(recording, begin_s, end_s, numbered=True):
    """Return the message of the samples from ``begin_s`` to before ``end_s``."""
    found = {}
    for c in recording.channels:
        low, high = np.searchsorted(c.times_s, [begin_s, end_s])
        piece = {"first": int(low)} if numbered else {}
        piece["values"] = as_list(c.values[low:high])
        if isinstance(c.clock, StampedClock):
            piece["times_s"] = c.times_s[low:high].tolist()
        found[str(c.id)] = piece
    return {"kind": "samples", "channels": found}


def messages_of(recording, step_s=2.0, numbered=True, **more):
    """Return hello, samples in pieces of ``step_s``, and finish."""
    begin_s = min(c.span_s[0] for c in recording.channels)
    end_s = max(c.span_s[1] for c in recording.channels) + step_s
    cuts = np.arange(begin_s, end_s + step_s, step_s)
    pieces = [samples_of(recording, a, b, numbered) for a, b in pairwise(cuts)]
    return [hello_of(recording, **more), *pieces, {"kind": "finish"}]


def as_lines(messages):
    return b"".join(json.dumps(each).encode() + b"\n" for each in messages)


def profile_of(answers):
    """Return the profile of the final points in ``answers``."""
    return join_points(live_points(a) for a in answers if a["kind"] == "points")


def live_points(answer):
    tracks = tuple(
        ProfileTrack.of(
            name,
            numbers(t["elevation"]),
            t["valid"],
            numbers(t["sigma"]) if "sigma" in t else None,
        )
        for name, t in answer["tracks"].items()
    )
    at = answer["first"], answer["interval_m"]
    return LivePoints(*at, tracks, State(answer["state"]), answer["pipeline"])


def numbers(values):
    return np.array(values, dtype=float)


def serve_bytes(path, data, resume=False, save_s=NEVER_S, **more):
    """Serve a run to a peer that sends ``data``; return its answers and the error that ended it."""
    out, error = BytesIO(), None
    run = LiveRun(Path(path), resume, save_s, more.pop("watch", None))
    try:
        Serving(run, Peer(BufferedReader(io.BytesIO(data)), out.write, "peer", **more)).serve()
    except Exception as raised:
        error = raised
    finally:
        run.close()
    return out.getvalue(), error


def serve_messages(path, messages, **more):
    """Return the answers to ``messages``, and the error that ended the run."""
    data, error = serve_bytes(path, as_lines(messages), **more)
    return [json.loads(line) for line in data.splitlines()], error


@pytest.fixture(scope="session")
def live():
    """Return what the tests of the session share, by name."""
    return SimpleNamespace(
        LEGS=LEGS,
        PIPELINE=PIPELINE,
        hello_of=hello_of,
        samples_of=samples_of,
        messages_of=messages_of,
        as_lines=as_lines,
        profile_of=profile_of,
        serve_bytes=serve_bytes,
        serve=serve_messages,
    )


@pytest.fixture(scope="session")
def page():
    """Return the page that documents the messages."""
    path = Path(__file__).parents[4] / "docs" / "live-messages.md"
    return path.read_text(encoding="utf-8")
