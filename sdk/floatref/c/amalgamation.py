"""The C library as one source and one header, for projects that take files.

``python -m floatref.c.amalgamation FOLDER`` writes ``floatref.c`` and ``floatref.h`` into FOLDER.
"""

import re
import sys
from pathlib import Path

ABOUT = """/* SPDX-License-Identifier: Apache-2.0
 *
 * libfloatref, all sources in one file.
 */
"""
INCLUDE = re.compile(r'^#include ([<"])([^">]+)[">]\n', re.M)


def amalgamate(sources: Path) -> str:
    """Return all of ``src/*.c`` of the folder ``sources`` as one file that includes `floatref.h`.

    Each internal header stands once, before its first use; the headers of the standard library
    stand at the top.
    """
    standard: set[str] = set()
    seen = {"floatref.h"}
    parts = [
        _flatten(source, sources / "src", standard, seen)
        for source in sorted((sources / "src").glob("*.c"))
    ]
    heads = "".join(f"#include <{name}>\n" for name in sorted(standard))
    return f'{ABOUT}{heads}\n#include "floatref.h"\n\n' + "\n".join(parts)


def _flatten(file: Path, folder: Path, standard: set[str], seen: set[str]) -> str:
    """Return the text of ``file`` with the headers that are not yet ``seen`` in their place."""

    def included(match: re.Match[str]) -> str:
        kind, name = match.groups()
        if kind == "<":
            standard.add(name)
            return ""
        if name in seen:
            return ""
        seen.add(name)
        return _flatten(folder / name, folder, standard, seen)

    return INCLUDE.sub(included, file.read_text(encoding="utf-8"))


def main(arguments: list[str]) -> int:
    """Write both files into the folder that is named; return the exit code."""
    if len(arguments) != 1:
        print("usage: python -m floatref.c.amalgamation FOLDER", file=sys.stderr)
        return 2
    sources, folder = Path(__file__).parent, Path(arguments[0])
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "floatref.c").write_text(amalgamate(sources), encoding="utf-8")
        header = (sources / "floatref.h").read_text(encoding="utf-8")
        (folder / "floatref.h").write_text(header, encoding="utf-8")
    except OSError as error:
        print(f"{error.filename}: {error.strerror}; choose another folder", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
