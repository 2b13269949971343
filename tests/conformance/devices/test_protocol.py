"""The protocol: whatever a program does at start, run or stop is one line that names the step."""

import json
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.devices.protocol import Session, parse_line
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped

pytestmark = pytest.mark.posix

LONG_S = 600.0
SHORT_S = 0.3

ANSWERS = {
    "print('ready', flush=True)": "not JSON: ready",
    "print('', flush=True)": "not JSON: an empty line",
    "print('[1, 2]', flush=True)": r"not a JSON object: \[1, 2\]",
    "print('1', flush=True)": "not a JSON object: 1",
    "print('{\"seq\": NaN}', flush=True)": "not JSON",
    "print('[' * 100_000, flush=True)": "not JSON",
    "print('{\"seq\": ' + '9' * 5000 + '}', flush=True)": "not JSON",
    "print('{\"seq\": ' + '9' * 50 + '}', flush=True)": "answered seq 9{39}…, expected [12]",
    "os.write(1, b'{\"seq\": \\xff}\\n')": "not UTF-8",
    "print(json.dumps({'ok': True}), flush=True)": "without a seq, expected [12]",
    "tell({'seq': 7}, ok=True)": "answered seq 7, expected [12]",
    "tell({'seq': '1'}, ok=True)": "answered seq '1', expected [12]",
    "tell({'seq': True}, ok=True)": "answered seq True, expected [12]",
    "tell({'seq': 1.0}, ok=True)": r"answered seq 1\.0, expected [12]",
    "print('y' * (1 << 20 | 1), flush=True)": "line longer than 1 MiB",
    "print('y' * (1 << 24), end='', flush=True)": "line longer than 1 MiB",
    "sys.exit(9)": "exited with status 9 before it answered ; stderr: bye",
    "os.kill(os.getpid(), 9)": "was killed by SIGKILL before it answered ; stderr: bye",
    "os.write(1, b'{\"seq\": 1'); sys.exit(0)": 'status 0 .*in the middle of a line: {"seq": 1',
}


def session(argv, **settings):
    return Session(argv, "/", **settings)


@pytest.fixture
def opened(written):
    """Return a function that starts a program whose `start` is sound; all are ended."""
    made = []

    def make(body):
        made.append(session(written(f"start()\n{body}")))
        return made[-1]

    yield make
    for one in made:
        one._child.kill()


def refused(question, *words):
    """Return the DeviceError of ``question``, which is one line in which ``words`` are found."""
    with pytest.raises(DeviceError) as caught:
        question()
    line = str(caught.value)
    assert line.isprintable()
    assert len(line) < 2000
    for word in words:
        assert re.search(word, line)
    return caught.value


@pytest.mark.slow
@pytest.mark.parametrize("answer", ANSWERS)
def test_a_wrong_answer_to_start_is_a_fault_of_start(written, answer):
    argv = written(f"ask()\nprint('bye', file=sys.stderr)\n{answer}")
    fault = refused(lambda: session(argv), "^start: ", ANSWERS[answer])
    assert not isinstance(fault, DeviceHung)


@pytest.mark.slow
@pytest.mark.parametrize("answer", ANSWERS)
def test_a_wrong_answer_to_run_is_a_fault_of_run(opened, answer):
    device = opened(f"ask()\nprint('bye', file=sys.stderr)\n{answer}\nhang()")
    fault = refused(lambda: device.run("/r", "/p", LONG_S), "^run: ", ANSWERS[answer])
    assert not isinstance(fault, DeviceHung)
    assert device.is_over


@pytest.mark.slow
@pytest.mark.parametrize("answer", [a for a in ANSWERS if "exit(0)" not in a])
def test_a_wrong_end_is_a_fault_of_stop(opened, answer):
    device = opened(f"ask()\nprint('bye', file=sys.stderr)\n{answer}")
    expected = ANSWERS[answer].replace(" before it answered", "")
    refused(lambda: device.stop(LONG_S), "^stop: ", expected)
    assert device.is_over


@pytest.mark.slow
def test_silence_is_a_hang_of_its_step(written, opened):
    argv = written("ask()\nhang()")
    hung = refused(lambda: session(argv, limit_s=SHORT_S), r"^start: no answer within 0\.3 s$")
    assert isinstance(hung, DeviceHung)
    hung = refused(lambda: opened("hang()").run("/r", "/p", SHORT_S), r"^run: no answer within 0")
    assert isinstance(hung, DeviceHung)
    hung = refused(lambda: opened("hang()").stop(SHORT_S), r"^stop: still running after 0\.3 s")
    assert isinstance(hung, DeviceHung)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({}, "answered version None, expected 1"),
        ({"version": 2}, "answered version 2, expected 1"),
        ({"version": True}, "answered version True, expected 1"),
        ({"version": 1}, "without a device"),
        ({"version": 1, "device": "ours"}, "without a device"),
        ({"version": 1, "device": {"name": "a\nb"}}, "name is too long or cannot be printed"),
        ({"version": 1, "device": {"version": "\ud800"}}, "version is too long or cannot"),
        ({"version": 1, "device": {"name": 999 * "y"}}, "name is too long"),
        ({"error": "no\nlicence"}, "answered an error: no licence"),
        ({"error": 5}, "error without a reason"),
    ],
)
def test_a_start_that_says_nothing_usable_is_refused(written, said, words):
    refused(lambda: session(written(f"tell(ask(), **{said!r})\nhang()")), "^start: ", words)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({}, "neither ok, nor skipped, nor error"),
        ({"ok": 1}, "neither ok, nor skipped, nor error"),
        ({"ok": False}, "neither ok, nor skipped, nor error"),
        ({"error": ""}, "error without a reason"),
        ({"skipped": None}, "skipped without a reason"),
    ],
)
def test_a_run_without_a_usable_outcome_ends_the_device(opened, said, words):
    device = opened(f"tell(ask(), **{said!r})\nhang()")
    refused(lambda: device.run("/r", "/p", LONG_S), "^run: ", words)
    assert device.is_over


def test_an_error_fails_the_run_and_a_skip_says_why_and_the_device_goes_on(opened):
    device = opened(
        "tell(ask(), error='no\\nspeed')\ntell(ask(), skipped='too short')\n"
        "tell(ask(), error='both', skipped='x', ok=True)\ntell(ask(), ok=True)\nask()"
    )
    refused(lambda: device.run("/r", "/p", LONG_S), "^run: answered an error: no speed$")
    with pytest.raises(DeviceSkipped, match=r"^too short$"):
        device.run("/r", "/p", LONG_S)
    refused(lambda: device.run("/r", "/p", LONG_S), "answered an error: both")
    device.run("/r", "/p", LONG_S)
    device.stop(LONG_S)


@pytest.mark.slow
@pytest.mark.parametrize(
    "answer",
    [
        "tell(c, error=900 * 'no ' + c['profile'])",
        "tell(c, error=c['profile'] + 900 * ' no')",
        "tell(c, skipped=4 * c['recording'] + 900 * ' no')",
        "print(4 * c['profile'] + 900 * ' no', flush=True)",
        "print(4 * c['profile'] + 900 * 'no', file=sys.stderr, flush=True); sys.exit(3)",
    ],
)
def test_a_text_with_a_folder_of_another_name_is_cut_alike(opened, answer):
    texts = set()
    for folder in ("/tmp/tmpab", "/tmp/tmp_8x_longer_name/below"):
        device = opened(f"c = ask()\n{answer}\nhang()")
        with pytest.raises((DeviceError, DeviceSkipped)) as caught:
            device.run(f"{folder}/recording/recording.json", f"{folder}/profile", LONG_S)
        texts.add(str(caught.value))
    (text,) = texts
    assert "tmp" not in text


def test_a_second_answer_to_one_command_is_no_answer_to_the_next(opened):
    device = opened("c = ask()\ntell(c, ok=True)\ntell(c, ok=True)\nhang()")
    device.run("/r", "/p", LONG_S)
    refused(lambda: device.run("/r", "/p", LONG_S), "answered seq 2, expected 3")


def test_an_answer_before_it_is_asked_is_no_answer_to_the_next(written):
    body = "tell({'seq': 1}, version=1, device=SAID)\ntell({'seq': 5}, ok=True)\nhang()"
    device = session(written(body))
    refused(lambda: device.run("/r", "/p", LONG_S), "answered seq 5, expected 2")


def test_the_commands_are_those_of_version_1(written, tmp_path):
    body = "log = open('log', 'w')\nfor line in sys.stdin:\n    print(line, file=log, flush=True)\n"
    body += "    c = json.loads(line)\n    if c['cmd'] == 'stop': break\n"
    body += "    tell(c, ok=True, version=1, device=SAID)"
    device = Session(written(body), tmp_path)
    assert device.device["name"] == "written"
    device.run("/a/rec ö/recording.json", "/a/profile", LONG_S)
    device.stop(LONG_S)
    device.stop(LONG_S)
    assert [json.loads(line) for line in (tmp_path / "log").read_text().split("\n") if line] == [
        {"seq": 1, "cmd": "start", "version": 1},
        {"seq": 2, "cmd": "run", "recording": "/a/rec ö/recording.json", "profile": "/a/profile"},
        {"seq": 3, "cmd": "stop"},
    ]


def test_a_device_may_answer_to_stop(opened):
    opened("tell(ask(), ok=True)").stop(LONG_S)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**60), 2**60) | st.text(max_size=9),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=9,
)


@pytest.mark.slow
@settings(deadline=None, max_examples=50)
@given(st.dictionaries(st.text(max_size=5), JSON, max_size=5))
def test_every_json_object_is_read_as_it_is(said):
    assert parse_line(json.dumps(said, ensure_ascii=False).encode("utf-8", "replace")) is not None
    assert parse_line(json.dumps(said).encode()) == said


@pytest.mark.slow
@settings(deadline=None, max_examples=100)
@given(st.one_of(st.binary(max_size=100), JSON.map(lambda value: json.dumps(value).encode())))
def test_whatever_else_is_read_is_a_fault_on_one_line(line):
    try:
        is_object = isinstance(json.loads(line.decode()), dict)
    except ValueError:
        is_object = False
    if is_object:
        assert parse_line(line) == json.loads(line)
    else:
        refused(lambda: parse_line(line), "^the answer is not ")
