"""Signatures of `SHA256SUMS` by tools that the user has: `ssh-keygen -Y`, and minisign.

All other members are in `SHA256SUMS`, so that one signature covers the archive. Whoever has no
floatref checks it with the tool itself.
"""

import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from floatref.errors import InputError
from floatref.files import read_bytes
from floatref.files.scratch import scratch_folder
from floatref.files.sources import check_file, read_start
from floatref_conformance.submission.checksums import SUMS
from floatref_conformance.submission.findings import CaughtBy, Finding, Verification

SSH, MINISIGN = f"{SUMS}.sig", f"{SUMS}.minisig"
SIGNATURES = frozenset({SSH, MINISIGN})
NAMESPACE = "floatref-submission"
"""What an SSH signature is for: one that was made for something else does not count."""
MOST_BYTES = 1 << 20
TIME_S = 600.0
"""For a tool that asks for a password."""
UNSIGNED = "unsigned: nobody answers for this archive"
BARE_KEY = re.compile(rb"[A-Za-z0-9+/]{56}\s*")
"""The content of a public key of minisign without its comment."""


def sign(sums: bytes, key: Path) -> tuple[str, bytes]:
    """Return name and content of the signature of ``sums`` by the secret ``key``.

    A key of minisign begins with its comment, any other is one for `ssh-keygen`. Raises InputError
    if the tool is missing or refuses.
    """
    check_file(key)
    if _is_minisign(key):
        return MINISIGN, _sign_minisign(sums, key)
    words = ("ssh-keygen", "-Y", "sign", "-q", "-f", str(key), "-n", NAMESPACE)
    done = _run(words, sums)
    if done.returncode != 0 or not done.stdout:
        raise InputError(f"{key}: ssh-keygen cannot sign with it ({_reason(done)}); give a key")
    return SSH, done.stdout


def check_signature(
    members: Mapping[str, bytes], signers: Path | None, verification: Verification
) -> None:
    """Put into ``verification`` who signed ``members``.

    ``signers`` is a file of allowed signers, as `ssh-keygen` has them, or a public key of minisign;
    an archive that nobody of them signed is then a finding. Raises InputError if the tool for them
    is missing.
    """
    here = sorted(SIGNATURES & members.keys())
    if len(here) > 1:
        _find(verification, here[1], "is a second signature")
    if not here:
        verification.signature = UNSIGNED
        if signers is not None:
            _find(verification, SUMS, f"is not signed, and {signers} was to have signed it")
        return
    check = _check_minisign if here[0] == MINISIGN else _check_ssh
    with scratch_folder("signature") as folder:
        (folder / here[0]).write_bytes(members[here[0]])
        (folder / SUMS).write_bytes(members.get(SUMS, b""))
        verification.signature = check(folder, signers, verification)


def _sign_minisign(sums: bytes, key: Path) -> bytes:
    with scratch_folder("signature") as folder:
        (folder / SUMS).write_bytes(sums)
        # The usual trusted comment has the time, and the same content gives the same bytes.
        words = ("minisign", "-S", "-s", str(key), "-m", str(folder / SUMS), "-t", NAMESPACE)
        done = _run(words, asks=True)
        if done.returncode != 0:
            raise InputError(f"{key}: minisign cannot sign with it ({_reason(done)}); give a key")
        return read_bytes(folder / MINISIGN, MOST_BYTES, "signature")


def _check_ssh(folder: Path, signers: Path | None, verification: Verification) -> str:
    signature, sums = str(folder / SSH), read_bytes(folder / SUMS, MOST_BYTES, SUMS)
    more = ("-s", signature)
    if signers is None:
        done = _try(("ssh-keygen", "-Y", "check-novalidate", "-n", NAMESPACE, *more), sums)
        if done is None:
            return _unchecked(verification, "ssh-keygen is not installed")
        if done.returncode != 0:
            return _find(verification, SSH, f"is not a signature of {SUMS}")
        verification.not_repeated.append("whose key signed: give --signers FILE to find out")
        return f"signed by {_key(done.stdout)}; whose key that is, --signers tells"
    check_file(signers)
    found = _run(("ssh-keygen", "-Y", "find-principals", "-f", str(signers), *more))
    who = found.stdout.decode("utf-8", "replace").strip().partition("\n")[0]
    words = ("ssh-keygen", "-Y", "verify", "-f", str(signers), "-I", who, "-n", NAMESPACE, *more)
    if found.returncode != 0 or not who or _run(words, sums).returncode != 0:
        return _find(verification, SSH, f"is not a signature of {SUMS} by a signer in {signers}")
    return f"signed by {who}"


def _check_minisign(folder: Path, signers: Path | None, verification: Verification) -> str:
    if signers is None:
        return _unchecked(verification, "minisign needs the public key: give --signers KEY.pub")
    check_file(signers)
    sums, signature = str(folder / SUMS), str(folder / MINISIGN)
    done = _run(("minisign", "-V", "-q", "-p", str(signers), "-m", sums, "-x", signature))
    if done.returncode != 0:
        return _find(verification, MINISIGN, f"is not a signature of {SUMS} by {signers}")
    return f"signed with {signers}"


def _find(verification: Verification, where: str, what: str) -> str:
    verification.findings.append(Finding(CaughtBy.SIGNATURE, where, what))
    return f"the signature does not hold: {where} {what}"


def _unchecked(verification: Verification, why: str) -> str:
    verification.not_repeated.append(f"the signature: {why}")
    return f"signed, but not checked: {why}"


def _key(output: bytes) -> str:
    """Return type and fingerprint of the key in what `ssh-keygen` prints."""
    return output.decode("utf-8", "replace").strip().rpartition(" with ")[2] or "a key"


def _is_minisign(key: Path) -> bool:
    start = read_start(key, 64)
    return start.startswith(b"untrusted comment:") or bool(BARE_KEY.fullmatch(start))


def _run(
    words: Sequence[str], content: bytes = b"", asks: bool = False
) -> subprocess.CompletedProcess[bytes]:
    done = _try(words, content, asks)
    if done is None:
        raise InputError(f"{words[0]}: not installed; install it, or leave signatures out")
    return done


def _try(
    words: Sequence[str], content: bytes = b"", asks: bool = False
) -> subprocess.CompletedProcess[bytes] | None:
    """Return what came of ``words``; None if there is no such program.

    One that ``asks`` for a password on standard input gets the user's.
    """
    try:
        if asks:
            return subprocess.run(words, stdout=subprocess.PIPE, timeout=TIME_S, check=False)
        return subprocess.run(
            words, input=content, capture_output=True, timeout=TIME_S, check=False
        )
    except FileNotFoundError:
        return None
    except subprocess.TimeoutExpired as error:
        raise InputError(f"{words[0]}: no answer in {TIME_S:.0f} s; try it by hand") from error


def _reason(done: subprocess.CompletedProcess[bytes]) -> str:
    # The first lines may be a frame of signs; what a tool has shown itself is not captured.
    lines = (done.stderr or b"").decode("utf-8", "replace").split("\n")
    said = [line.strip() for line in lines if line.strip()]
    return said[-1] if said else f"exit code {done.returncode}"
