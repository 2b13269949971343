"""Sends a table of samples to `floatref live`, and prints the final points as they come.

    python client.py PORT TABLE.csv RATE_HZ

A row of the table is: specific force in m/s², height in m, distance in m. The run goes on where the
command has it, so the same call completes a run that was killed.
"""

import json
import socket
import sys
import threading

CHANNELS = {"left.vertical_specific_force": "m/s²", "left.height": "m", "distance": "m"}
AT_ONCE = 100
"""Samples of each channel in a message."""


def describe(name, unit, rate_hz):
    """Return the entry of a channel in the hello."""
    track, _, channel = name.rpartition(".")
    return {"name": channel, "track": track or None, "unit": unit, "rate_hz": rate_hz}


def send(stream, message):
    """Send one message at once."""
    stream.write(json.dumps(message).encode() + b"\n")
    stream.flush()


def send_samples(stream, rows, number):
    """Send the rows from ``number`` on; a logger would send each piece when it is measured."""
    for first in range(number, len(rows), AT_ONCE):
        columns = zip(*rows[first : first + AT_ONCE], strict=True)
        pieces = {
            name: {"first": first, "values": list(values)}
            for name, values in zip(CHANNELS, columns, strict=True)
        }
        send(stream, {"kind": "samples", "channels": pieces})
    send(stream, {"kind": "finish"})


def main(port, table, rate_hz):
    """Send the table; return 0, or the line why the command has refused it."""
    with open(table, encoding="utf-8") as lines:
        rows = [[float(cell) for cell in line.split(",")] for line in lines]
    with socket.create_connection(("127.0.0.1", int(port))) as connection:
        stream = connection.makefile("rwb")
        channels = [describe(name, unit, float(rate_hz)) for name, unit in CHANNELS.items()]
        hello = {"kind": "hello", "format": "floatref-live/1", "channels": channels}
        setup = {"profile_interval_m": 0.1}
        send(stream, {**hello, "setup": setup, "pipeline": "temporal-matched-hpf"})
        started = json.loads(stream.readline())
        if started["kind"] == "refused":
            return started["text"]
        number = min(started.get("next", {"": len(rows)}).values())
        sender = threading.Thread(
            target=send_samples, args=(connection.makefile("wb"), rows, number)
        )
        sender.start()
        for line in stream:
            answer = json.loads(line)
            if answer["kind"] == "refused":
                return answer["text"]
            if answer["kind"] == "points" and answer["state"] == "final":
                print(line.decode(), end="", flush=True)
        sender.join()
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
