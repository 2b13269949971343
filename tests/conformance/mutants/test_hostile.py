"""Programs wrong on purpose: each is found out, in one line, and leaves nothing behind."""

import pytest

from floatref.errors import InputError
from floatref_conformance.errors import DeviceError, DeviceHung
from floatref_conformance.judge.exercise import close, describe, exercise
from floatref_conformance.mutants.hostile import HOSTILE, hostile_device

FOUND = {
    "exit-at-start": "start: exited with status 3 before it answered",
    "hang": "run: no answer within 1 s",
    "crash": "run: was killed by SIGTERM before it answered ; stderr: out of luck",
    "flood": "run: wrote a line longer than 1 MiB",
    "garbage": "run: the answer is not JSON: Processing finished, 0 errors",
    "out-of-order": "run: answered seq 1, expected 2",
    "nan-answer": "run: the answer is not JSON",
    "nothing-delivered": "delivered no profile directory",
    "delivered-elsewhere": "delivered a symbolic link in place of a profile directory",
}

SHORT = {"crash", "exit-at-start", "flood"}


def test_every_hostile_program_is_named_once_and_says_what_is_wrong():
    assert [hostile.name for hostile in HOSTILE] == list(FOUND)
    assert all(hostile.wrong for hostile in HOSTILE)


@pytest.mark.slow
@pytest.mark.parametrize(
    "hostile",
    [pytest.param(h, marks=() if h.name in SHORT else pytest.mark.slow) for h in HOSTILE],
    ids=lambda hostile: hostile.name,
)
def test_each_is_found_out(hostile, recording):
    device = hostile_device(hostile.name)
    try:
        with pytest.raises(DeviceError) as caught:
            exercise(device, describe(device), recording)
    finally:
        assert close(device) == ""
    assert str(caught.value).startswith(FOUND[hostile.name])
    assert isinstance(caught.value, DeviceHung) == (hostile.name == "hang")
    assert device.argv == hostile.argv


def test_each_time_it_is_another_device():
    assert hostile_device("crash") is not hostile_device("crash")


def test_a_name_that_is_not_there_is_refused_with_those_that_are():
    with pytest.raises(InputError, match="nobody: unknown; known: exit-at-start, hang, crash"):
        hostile_device("nobody")
