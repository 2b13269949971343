"""Every tampering is named: by the checksums, by the signature, and by what is repeated."""

import subprocess
from functools import cache

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.conformance.submission.tamperings import TAMPERINGS

from floatref_conformance.submission.checksums import SUMS, compare_sums
from floatref_conformance.submission.findings import CaughtBy, Verification
from floatref_conformance.submission.signatures import SIGNATURES, check_signature, sign

every = pytest.mark.parametrize("tampering", TAMPERINGS, ids=lambda t: t.name)


@pytest.fixture(scope="module")
def key(tmp_path_factory):
    """A secret key of ssh, with the file of allowed signers beside it."""
    path = tmp_path_factory.mktemp("keys") / "key"
    words = ("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-C", "", "-f", str(path))
    subprocess.run(words, check=True)
    public = path.with_suffix(".pub").read_text()
    path.with_suffix(".signers").write_text(f"lab@example.org {public}")
    return path


@cache
def signed_once(key, sums):
    return sign(sums, key)


def lines(found):
    return [f"{f.where}: {f.what}" for f in found.findings]


def test_there_are_twenty_kinds_at_least():
    assert len({t.name for t in TAMPERINGS}) == len(TAMPERINGS) >= 20


@pytest.mark.slow
@every
def test_checksums_show_it_until_they_are_renewed(archive, tampering):
    changed = archive("clipping")
    tampering.apply(changed)
    found = list(compare_sums(changed.members, SIGNATURES))
    assert found
    assert {f.caught_by for f in found} == {CaughtBy.CHECKSUMS}
    changed.renew_sums()
    assert not list(compare_sums(changed.members, SIGNATURES))


@pytest.mark.slow
@every
def test_the_signature_shows_it_after_that(archive, tampering, key):
    changed = archive("clipping")
    name, signature = signed_once(key, changed.members[SUMS])
    tampering.apply(changed)
    changed.renew_sums()
    changed.members[name] = signature
    found = Verification()
    check_signature(changed.members, key.with_suffix(".signers"), found)
    assert [f.caught_by for f in found.findings] == [CaughtBy.SIGNATURE]


@pytest.mark.slow
@every
def test_repetition_shows_what_it_can(archive, devices, tampering):
    changed = archive("clipping")
    tampering.apply(changed)
    changed.renew_sums()
    named(changed.verify(), tampering.alone)
    if tampering.with_device:
        named(changed.verify(devices["clipping"]()), tampering.with_device)


def named(found, expected):
    """Assert that what was found has a line with ``expected``; nothing is found without it."""
    assert {f.caught_by for f in found.findings} <= {CaughtBy.REPETITION}
    assert bool(lines(found)) == bool(expected)
    assert not expected or any(expected in line for line in lines(found)), lines(found)


def test_a_signature_that_is_taken_away_is_missed(archive, key):
    found = archive("clipping").verify(signers=key.with_suffix(".signers"))
    assert [f.caught_by for f in found.findings] == [CaughtBy.SIGNATURE]
    assert "not signed" in found.findings[0].what


JSON = st.none() | st.booleans() | st.integers(-9, 9) | st.floats(0.0, 9.0) | st.text(max_size=3)
JSON |= st.lists(JSON, max_size=2) | st.dictionaries(st.text(max_size=3), JSON, max_size=2)


def leaves(document, path=()):
    """Yield the path of everything in a document, itself left out."""
    pairs = document.items() if isinstance(document, dict) else enumerate(document)
    for key, value in pairs:
        yield (*path, key)
        if isinstance(value, dict | list):
            yield from leaves(value, (*path, key))


def replace_at(document, path, value):
    for key in path[:-1]:
        document = document[key]
    before, document[path[-1]] = document[path[-1]], value
    return before != value or isinstance(before, bool) != isinstance(value, bool)


@pytest.mark.slow
@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_whatever_stands_in_a_document_is_read_and_in_a_report_named(archive, data):
    changed = archive("clipping")
    names = sorted(name for name in changed.members if name.endswith(".json"))
    name = data.draw(st.sampled_from([*names, "report.json", "submission.json"]))
    path = data.draw(st.sampled_from(list(leaves(changed.read(name)))))
    value, differs = data.draw(JSON), []
    changed.edit(name, lambda found: differs.append(replace_at(found, path, value)))
    changed.renew_sums()
    found = changed.verify()
    assert found.findings or name != "report.json" or differs == [False]
