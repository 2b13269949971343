"""Signatures of both tools hold for one content and one signer, here and without floatref."""

import shutil
import subprocess

import pytest

from floatref.errors import InputError
from floatref_conformance.submission import signatures
from floatref_conformance.submission.checksums import SUMS, list_sums
from floatref_conformance.submission.findings import CaughtBy, Verification
from floatref_conformance.submission.signatures import MINISIGN, SSH, check_signature, sign

WHO = "lab@example.org"

pytestmark = pytest.mark.posix


def make_ssh(folder, name):
    """Return a new secret key of ssh and the file of allowed signers with its public one."""
    key, signers = folder / name, folder / f"{name}.signers"
    words = ("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-C", "", "-f", str(key))
    subprocess.run(words, check=True)
    signers.write_text(f"{WHO} {key.with_suffix('.pub').read_text()}")
    return key, signers


def make_minisign(folder, name):
    """Return a new secret key of minisign without a password, and its public one."""
    key, public = folder / name, folder / f"{name}.pub"
    words = ("minisign", "-G", "-W", "-s", str(key), "-p", str(public))
    subprocess.run(words, check=True, capture_output=True, stdin=subprocess.DEVNULL)
    return key, public


TOOLS = {"ssh-keygen": (make_ssh, SSH), "minisign": (make_minisign, MINISIGN)}


@pytest.fixture(params=TOOLS)
def keys(request, tmp_path):
    """Return a function that makes a pair of keys of one tool, where it is installed."""
    if shutil.which(request.param) is None:
        pytest.skip(f"{request.param} is not installed")
    return lambda name="key": TOOLS[request.param][0](tmp_path, name)


def checked(members, signers=None):
    found = Verification()
    check_signature(members, signers, found)
    return found


def signed(content, key):
    members = {"a": content}
    members[SUMS] = list_sums(members)
    name, signature = sign(members[SUMS], key)
    return {**members, name: signature}


def test_a_signature_holds_for_its_signer_and_content_alone(keys):
    key, signers = keys()
    _, others = keys("other")
    members = signed(b"one", key)
    found = checked(members, signers)
    assert found.findings == []
    assert found.signature.startswith("signed")
    for wrong, by in ((members, others), ({**members, SUMS: b"x"}, signers)):
        found = checked(wrong, by)
        assert [f.caught_by for f in found.findings] == [CaughtBy.SIGNATURE]


def test_the_same_content_has_the_same_signature(keys):
    key, _ = keys()
    assert signed(b"one", key) == signed(b"one", key) != signed(b"two", key)


def test_without_signers_it_is_not_claimed_who_signed(keys):
    key, _ = keys()
    found = checked(signed(b"one", key))
    assert found.findings == []
    assert any("--signers" in line for line in found.not_repeated)


def test_a_damaged_signature_of_ssh_is_found_without_signers(tmp_path):
    members = signed(b"one", make_ssh(tmp_path, "key")[0])
    found = checked({**members, SUMS: members[SUMS] + b"\n"})
    assert [f.caught_by for f in found.findings] == [CaughtBy.SIGNATURE]


def test_two_signatures_are_one_too_many(tmp_path):
    members = signed(b"one", make_ssh(tmp_path, "key")[0])
    assert checked({**members, MINISIGN: b""}).findings


def test_the_tool_itself_confirms_it(tmp_path):
    key, signers = make_ssh(tmp_path, "key")
    members = signed(b"one", key)
    for name, content in members.items():
        (tmp_path / name).write_bytes(content)
    words = ("ssh-keygen", "-Y", "verify", "-f", str(signers), "-I", WHO)
    words += ("-n", signatures.NAMESPACE, "-s", str(tmp_path / SSH))
    subprocess.run(words, input=members[SUMS], check=True, capture_output=True)
    subprocess.run(("sha256sum", "-c", SUMS), cwd=tmp_path, check=True, capture_output=True)


@pytest.mark.parametrize("content", ["", "not a key", "untrusted comment: x\nnot a key\n"])
def test_what_is_no_key_is_refused_in_a_line(tmp_path, content):
    path = tmp_path / "key"
    path.write_text(content)
    path.chmod(0o600)
    with pytest.raises(InputError, match="sign"):
        sign(b"", path)


def test_a_missing_tool_is_named(tmp_path, monkeypatch):
    members = signed(b"one", make_ssh(tmp_path, "key")[0])
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="ssh-keygen: not installed"):
        sign(b"", tmp_path / "key")
    with pytest.raises(InputError, match="ssh-keygen: not installed"):
        checked(members, tmp_path / "key.signers")
    found = checked(members)
    assert found.findings == []
    assert found.signature == "signed, but not checked: ssh-keygen is not installed"
