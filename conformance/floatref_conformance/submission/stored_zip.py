"""The archive of a submission: a zip whose bytes follow from its content, and that is safe to read.

Members are stored as they are, so that no small file becomes a large one, and no version of a
compressor changes a byte. They have one date, one mode, and lie one behind the other in the order
of their names; an archive that is different in any of this is refused before a member is read.
"""

import re
import stat
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from io import BufferedReader
from pathlib import Path
from zipfile import ZIP_STORED, BadZipFile, ZipFile, ZipInfo

from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref.files.sources import open_bytes

MOST_MEMBERS = 4096
MOST_BYTES = 1 << 30
NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9._-]{0,99}(/[A-Za-z0-9_][A-Za-z0-9._-]{0,99}){0,4}")
LONGEST_NAME = 504
DATE = (1980, 1, 1, 0, 0, 0)
MODE = stat.S_IFREG | 0o644
UNIX = 3
LOCAL, CENTRAL, END = 30, 46, 22
"""Bytes of the headers of a member, before it and in the directory, and of the archive's end."""
END_MARK, LONGEST_END = b"PK\5\6", END + (1 << 16)
"""How the end begins, and its bytes with the longest comment, where it is looked for."""
ENCRYPTED = 1
ADVICE = "ask for the archive again"


def write_archive(members: Mapping[str, bytes], path: Path, overwrite: bool = False) -> None:
    """Write ``members`` as the archive ``path``: the same content gives the same bytes.

    Raises InputError if ``path`` exists and ``overwrite`` is false, or cannot be written, and for
    more than `read_archive` would accept.
    """
    if len(members) > MOST_MEMBERS or sum(map(len, members.values())) > MOST_BYTES:
        raise InputError(f"{path}: the submission is too large; submit fewer checks at a time")
    with replace_file(path, overwrite) as beside, ZipFile(beside, "x", ZIP_STORED) as archive:
        for name in sorted(members):
            archive.writestr(_describe(name), members[name])


def read_archive(path: Path) -> dict[str, bytes]:
    """Return the members of the archive ``path`` by name.

    Raises InputError, naming the member, for anything that `write_archive` does not write: a path
    that leads out, a link, a folder, two members of one name, a compressed or encrypted one, other
    dates or modes, bytes between members, and for an archive that is cut or damaged.
    """
    with open_bytes(path) as stream:
        try:
            _check_ends(path, stream)
            with ZipFile(stream) as archive:
                members = archive.infolist()
                _check(path, members, _size(stream))
                return {member.filename: archive.read(member) for member in members}
        except (BadZipFile, EOFError, OSError, ValueError, NotImplementedError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{path}: not a whole archive ({error}); {ADVICE}") from error


def _describe(name: str) -> ZipInfo:
    member = ZipInfo(name, DATE)
    member.create_system, member.external_attr = UNIX, MODE << 16
    return member


def _size(stream: BufferedReader) -> int:
    return stream.seek(0, 2)


def _check_ends(path: Path, stream: BufferedReader) -> None:
    """Raise InputError for more bytes than an archive has, before any of it is in memory."""
    size = _size(stream)
    heads = MOST_MEMBERS * (LOCAL + CENTRAL + 2 * LONGEST_NAME)
    if size > MOST_BYTES + heads:
        raise InputError(f"{path}: larger than {MOST_BYTES >> 20} MiB; {ADVICE}")
    stream.seek(max(size - LONGEST_END, 0))
    rest = stream.read()
    place = rest.rfind(END_MARK)
    directory = int.from_bytes(rest[place + 12 : place + 16], "little") if place >= 0 else 0
    if directory > heads:
        raise InputError(f"{path}: its directory has {directory} bytes; {ADVICE}")


def _check(path: Path, members: Sequence[ZipInfo], size: int) -> None:
    if len(members) > MOST_MEMBERS:
        raise InputError(f"{path}: {len(members)} members, {MOST_MEMBERS} are allowed; {ADVICE}")
    for member in members:
        for fault in _faults(member):
            raise InputError(f"{path}: {member.orig_filename}: {fault}; {ADVICE}")
    times = Counter(member.filename.casefold() for member in members)
    for name, count in times.items():
        if count > 1:
            raise InputError(f"{path}: {name}: {count} members of that name; {ADVICE}")
    _check_places(path, members, size)


def _faults(member: ZipInfo) -> Iterator[str]:
    """Yield what is wrong with ``member``, the worst first."""
    kind = stat.S_IFMT(member.external_attr >> 16)
    if kind == stat.S_IFLNK:
        yield "is a link"
    # `is_dir` of zipfile takes the last letter of the name, and there may be none.
    if member.filename.endswith("/") or kind == stat.S_IFDIR:
        yield "is a folder"
    if member.orig_filename != member.filename or not NAME.fullmatch(member.filename):
        yield "is a path that may lead out of the archive"
    if member.flag_bits & ENCRYPTED:
        yield "is encrypted"
    if member.compress_type != ZIP_STORED or member.file_size != member.compress_size:
        yield "is compressed, and could be of any size when it is read"
    if member.external_attr != MODE << 16 or member.create_system != UNIX:
        yield "has another mode than `conformance submit` gives"
    if member.date_time != DATE or member.extra or member.comment or member.flag_bits:
        yield "has a date, or more, that `conformance submit` does not write"


def _check_places(path: Path, members: Sequence[ZipInfo], size: int) -> None:
    """Raise InputError unless the members, sorted, and their directory fill the archive."""
    place = 0
    for member in members:
        if member.header_offset != place:
            raise InputError(f"{path}: {member.filename}: other bytes lie before it; {ADVICE}")
        place += LOCAL + len(member.filename) + member.file_size
    place += END + sum(CENTRAL + len(member.filename) for member in members)
    names = [member.filename for member in members]
    if place != size or names != sorted(names):
        raise InputError(f"{path}: {size} bytes, its members make {place}; {ADVICE}")
