"""Write docs/flaws.md and docs/data/flaws.json, the catalogue of flaws, from the mutants.

python .ci/flaws_page.py
"""

import json
from dataclasses import asdict
from pathlib import Path

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.mutants.flaws import Flaw, list_flaws

DOCS = Path(__file__).parents[1] / "docs"
PAGE, DATA = DOCS / "flaws.md", DOCS / "data" / "flaws.json"
HEAD = """# A catalogue of flaws

What can be wrong with a profiler's software, how it looks in a profile, how it comes about, and
which check of [the judge](conformance.md) finds it. Each flaw is that of a mutant, a device that is
wrong on purpose: `conformance run --device mutant:NAME` shows it at work. The checks named here
have to fail it, which `conformance selftest` tries; others may fail it too. How it looks follows
from what the mutant does. How it comes about is what we expect of real devices, and is not
measured.

This page and [the same as JSON](data/flaws.json) are written by `.ci/flaws_page.py`.
"""
FORMAT = "conformance-flaws/1"


def page() -> str:
    """Return the page: a section for each flaw."""
    return "\n".join([HEAD, *(section(flaw) for flaw in list_flaws())])


def document() -> str:
    """Return the catalogue as JSON."""
    flaws = [{**asdict(flaw), "found_by": list(flaw.found_by)} for flaw in list_flaws()]
    return json.dumps({"format": FORMAT, "flaws": flaws}, indent=1, ensure_ascii=False) + "\n"


def section(flaw: Flaw) -> str:
    """Return the section of ``flaw``."""
    title = flaw.name[0].upper() + flaw.name[1:]
    return (
        f"## {title} {{ #{flaw.mutant} }}\n\n"
        f"`mutant:{flaw.mutant}` {flaw.wrong}.\n\n"
        f"- On the road: {flaw.road}\n"
        f"- How it comes about: {flaw.origin}\n"
        f"- Found by: {describe_checks(flaw.found_by)}.\n"
    )


def describe_checks(ids: tuple[str, ...]) -> str:
    """Return the checks in words; those that do not find it where these are fewer."""
    others = [id_ for id_ in IDS if id_ not in ids]
    if set(ids) <= set(STREAM_CHECKS) or len(others) > len(ids):
        return ", ".join(f"`{id_}`" for id_ in ids)
    if not others:
        return "every check of recordings"
    return f"every check of recordings but {', '.join(f'`{id_}`' for id_ in others)}"


def main() -> None:
    """Write both files."""
    DATA.parent.mkdir(exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
    DATA.write_text(document(), encoding="utf-8")


if __name__ == "__main__":
    main()
