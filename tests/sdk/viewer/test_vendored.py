"""The library in a page is the one that its source names, byte by byte, with its licence."""

import re
from hashlib import sha256
from pathlib import Path

import floatref

UPLOT = Path(floatref.__file__).parent / "viewer" / "page" / "uplot"


def test_bytes_are_those_of_the_version_that_is_named() -> None:
    text = (UPLOT / "SOURCE.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\S+) \| (\d+) \| ([0-9a-f]{64}) \|$", text, re.M)
    assert {name for name, _, _ in rows} == {"uPlot.iife.min.js", "uPlot.min.css"}
    for name, size, digest in rows:
        content = (UPLOT / name).read_bytes()
        assert (len(content), sha256(content).hexdigest()) == (int(size), digest)
    (version,) = re.findall(r"version (\S+)$", text, re.M)
    assert f"(v{version})" in (UPLOT / "uPlot.iife.min.js").read_text(encoding="utf-8")[:200]
    assert "Permission is hereby granted" in (UPLOT / "LICENSE.txt").read_text(encoding="utf-8")
