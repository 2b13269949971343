"""Every tampering is named: by the checksums, by the signature, and by what is repeated."""

import subprocess

import pytest
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


def lines(found):
    return [f"{f.where}: {f.what}" for f in found.findings]


def test_there_are_twenty_kinds_at_least():
    assert len({t.name for t in TAMPERINGS}) == len(TAMPERINGS) >= 20


@every
def test_checksums_show_it_until_they_are_renewed(archive, tampering):
    changed = archive("clipping")
    tampering.apply(changed)
    found = list(compare_sums(changed.members, SIGNATURES))
    assert found
    assert {f.caught_by for f in found} == {CaughtBy.CHECKSUMS}
    changed.renew_sums()
    assert not list(compare_sums(changed.members, SIGNATURES))


@every
def test_the_signature_shows_it_after_that(archive, tampering, key):
    changed = archive("clipping")
    name, signature = sign(changed.members[SUMS], key)
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
