"""One HTML file: the arrays of a page one by one, as they are made, and then what shows them.

Nothing of the page is in memory as a whole. The browser decodes an array when it draws it.
"""

import json
from base64 import b64encode
from collections.abc import Mapping
from html import escape
from importlib.resources import files
from typing import Any, TextIO

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from floatref.files.document import plain

STYLES = ("uplot/uPlot.min.css", "view.css")
LICENCE = "uplot/LICENSE.txt"
SCRIPTS = (
    "uplot/uPlot.iife.min.js",
    "arrays.js",
    "axis.js",
    "columns.js",
    "panel.js",
    "map.js",
    "table.js",
    "controls.js",
    "start.js",
)
"""The scripts of a page, in the order in which they need each other."""
SINGLE, DOUBLE, BYTE = "<f4", "<f8", "u1"
"""Formats of the numbers in an array, little-endian."""
LARGEST_SINGLE = float(np.finfo(SINGLE).max)
PIECE = 3 << 18
"""Bytes that become text at a time; a multiple of 3, so that the texts join."""


class PageWriter:
    """Writes a page to a text stream: `open`, then arrays by `add`, then `close`."""

    def __init__(self, stream: TextIO) -> None:
        """Write to ``stream``."""
        self._stream = stream
        self._arrays: list[str] = []

    def open(self, title: str) -> None:
        """Write the head and the styles of a page with this ``title``."""
        head = _resource("head.html").replace("LICENCE", _resource(LICENCE))
        head = head.replace("STYLES", "\n".join(map(_resource, STYLES)))
        self._stream.write(head.replace("TITLE", escape(title)))

    def add(self, values: ArrayLike, form: DTypeLike = SINGLE) -> int:
        """Write ``values`` as numbers of this ``form``, and return the number of the array.

        Those of a damaged file that are beyond the form become its largest.
        """
        if form == SINGLE:
            values = np.clip(values, -LARGEST_SINGLE, LARGEST_SINGLE)
        raw = np.ascontiguousarray(values, form).tobytes()
        name = np.dtype(form).str.lstrip("<|")
        self._stream.write(f'<script type="text/plain" id="array-{len(self._arrays)}">')
        for first in range(0, len(raw), PIECE):
            self._stream.write(b64encode(raw[first : first + PIECE]).decode("ascii"))
        self._stream.write("</script>\n")
        self._arrays.append(name)
        return len(self._arrays) - 1

    def close(self, document: Mapping[str, Any]) -> None:
        """Write ``document``, which refers to the arrays by number, and the scripts."""
        whole = plain({**document, "arrays": self._arrays}, "page")
        # A name from a file may hold the end of a script.
        text = json.dumps(whole, allow_nan=False).replace("<", "\\u003c")
        self._stream.write(f'<script type="application/json" id="document">{text}</script>\n')
        for name in SCRIPTS:
            self._stream.write(f"<script>\n{_resource(name)}\n</script>\n")
        self._stream.write("</body>\n</html>\n")


def _resource(name: str) -> str:
    """Return the text of a file of the page."""
    return files("floatref.viewer").joinpath("page", *name.split("/")).read_text(encoding="utf-8")
