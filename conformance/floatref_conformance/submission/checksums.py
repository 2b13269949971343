"""`SHA256SUMS`, as `sha256sum -c` reads it: a line for every other member of the archive."""

import re
from collections.abc import Iterator, Mapping
from hashlib import sha256

from floatref.errors import InputError
from floatref_conformance.submission.findings import CaughtBy, Finding

SUMS = "SHA256SUMS"
LINE = re.compile(r"([0-9a-f]{64})  (\S+)")


def list_sums(members: Mapping[str, bytes]) -> bytes:
    """Return the content of `SUMS` for ``members``."""
    lines = (f"{sha256(members[name]).hexdigest()}  {name}\n" for name in sorted(members))
    return "".join(lines).encode()


def compare_sums(members: Mapping[str, bytes], left_out: frozenset[str]) -> Iterator[Finding]:
    """Yield what differs between ``members`` and their `SUMS`; those ``left_out`` have no line.

    Raises InputError if there is no `SUMS`, or if it cannot be read.
    """
    listed = _parse(members)
    for name in sorted(members.keys() - left_out - {SUMS}):
        if name not in listed:
            yield Finding(CaughtBy.CHECKSUMS, name, f"is an extra member, not in {SUMS}")
        elif listed[name] != sha256(members[name]).hexdigest():
            yield Finding(CaughtBy.CHECKSUMS, name, f"is not the one in {SUMS}")
    for name in sorted(listed.keys() - members.keys()):
        yield Finding(CaughtBy.CHECKSUMS, name, "has been removed")


def _parse(members: Mapping[str, bytes]) -> dict[str, str]:
    if SUMS not in members:
        raise InputError(f"no {SUMS}; give an archive of `conformance submit`")
    listed: dict[str, str] = {}
    for number, line in enumerate(members[SUMS].decode("utf-8", "replace").splitlines(), 1):
        found = LINE.fullmatch(line)
        if found is None or found[2] in listed:
            raise InputError(f"{SUMS}, line {number}: not a checksum and a name; ask for it again")
        listed[found[2]] = found[1]
    return listed
