"""Write docs/flaws.md and docs/data/flaws.json, the catalogue of flaws, from the mutants.

python .ci/flaws_page.py

The pictures are drawn by `.ci/flaw_pictures.py`, the figures of the first section measured by
`.ci/resemblance_measure.py`.
"""

import json
from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.mutants.flaws import Flaw, list_flaws

DOCS = Path(__file__).parents[1] / "docs"
PAGE, DATA = DOCS / "flaws.md", DOCS / "data" / "flaws.json"
MEASURED = DOCS / "data" / "resemblance.json"
PICTURES = "images/flaws"
HEAD = """# A catalogue of flaws

What can be wrong with a profiler's software, how it looks in a profile, how it comes about, and
which check of [the judge](conformance.md) finds it. Each flaw is that of a mutant, a device that is
wrong on purpose: `conformance run --device mutant:NAME` shows it at work. The checks named here
have to fail it, which `conformance selftest` tries; others may fail it too. How it looks follows
from what the mutant does. How it comes about is what we expect of real devices, and is not
measured.

A picture has the mutant's profile, red, over the true one, wide and grey, which is without waves
beyond 91 m, where it shows most on one of [the probes](conformance.md#resemblance). What it flags
invalid is the orange bar below. Where a part of the run is shown, the profile is moved to the mean
of the truth. Flaws of the protocol and of streams have no picture: their profiles are sound, or
there is no profile. At stops and gaps the error of the sound pipeline is in the picture, too.

This page and [the same as JSON](data/flaws.json) are written by `.ci/flaws_page.py`, pictures by
`.ci/flaw_pictures.py`.
"""
RECOGNIZED = """## How well a flaw is recognized { #resemblance }

The report of a device that fails names [the flaw that it resembles](conformance.md#resemblance).
Each flaw is in the catalogue once, in one pipeline and one size. So we put it into another
pipeline, a spatial one in place of a temporal one and another Kalman smoother, and gave it half and
twice its size, where it has one (`.ci/resemblance_measure.py`; [all
results](data/resemblance.json)):

| the same flaw | cases | named first | among the first three | another flaw first | no flaw named |
|---|---|---|---|---|---|
"""
CONFUSED = """
These were taken for one another:

| the flaw | what was named first |
|---|---|
"""
WHY = """
Some flaws have the same errors on the probes, and cannot be distinguished by them: `vouches-never`,
`middle-flagged` and `coasting-flagged` flag most of a short run (0.94 to 0.99 in common);
`reverse-pass-missing`, `cotangent` and `third-order` are filters that run forward only (0.97 to
0.98); `pitch-sign`, `rates-swapped` and `gravity-left-out` are a wrong attitude under braking (0.95
to 0.99). `throttle-flagged`, `offset-ignored` and `slip-believed` stay within the range of good
devices on these probes, and are never named. Mutants that are a whole pipeline, or have an engine
of their own, were not put into another one. The spatial pipeline is one of the good devices whose
range is taken off, the other Kalman smoother is not. Three firmwares in C with a flaw of their own
(the accelerometer's sign, a laser that is 2 ms late, heights in feet) are named right, too.

A fault of the protocol, such as a crash or no answer in time, is named by the report and not by
probes, as 100 % alike. One such fault in one case outranks all else: where 14 other checks fail by
their figures, what is named is the fault still, and mending it shows what the figures resemble.
"""
FORMAT = "conformance-flaws/1"


def page() -> str:
    """Return the page: how well flaws are recognized, and a section for each."""
    rows = json.loads(MEASURED.read_text(encoding="utf-8"))["rows"]
    return "\n".join([HEAD, recognition(rows), *(section(flaw) for flaw in list_flaws())])


def recognition(rows: Iterable[dict[str, Any]]) -> str:
    """Return the section about what was measured."""
    known = list(rows)
    kinds = list(dict.fromkeys(row["variant"] for row in known))
    lines = [
        _share(
            f"in {kind}" if "pipe" in kind else f"of {kind}",
            [row for row in known if row["variant"] == kind],
        )
        for kind in kinds
    ]
    table = "\n".join([*lines, _share("**all**", known)])
    return f"{RECOGNIZED}{table}\n{CONFUSED}{_confusions(known)}\n{WHY}"


def _share(name: str, rows: list[dict[str, Any]]) -> str:
    first = sum(row["place"] == 1 for row in rows)
    among = sum(row["place"] > 0 for row in rows)
    silent = sum(not row["named"] for row in rows)
    shares = [
        f"{100 * n / len(rows):.0f} %" for n in (first, among, len(rows) - first - silent, silent)
    ]
    return f"| {name} | {len(rows)} | {' | '.join(shares)} |"


def _confusions(rows: list[dict[str, Any]]) -> str:
    wrong: dict[str, Counter[str]] = {}
    for row in rows:
        if row["place"] != 1:
            named = f"`{row['named'][0][0]}`" if row["named"] else "no flaw"
            wrong.setdefault(row["flaw"], Counter())[f"{named} ({row['variant']})"] += 1
    return "\n".join(f"| `{flaw}` | {', '.join(wrong[flaw])} |" for flaw in wrong)


def document() -> str:
    """Return the catalogue as JSON."""
    flaws = [{**asdict(flaw), "found_by": list(flaw.found_by)} for flaw in list_flaws()]
    return json.dumps({"format": FORMAT, "flaws": flaws}, indent=1, ensure_ascii=False) + "\n"


def section(flaw: Flaw) -> str:
    """Return the section of ``flaw``, with its picture if it has one."""
    title = flaw.name[0].upper() + flaw.name[1:]
    return (
        f"## {title} {{ #{flaw.mutant} }}\n\n"
        f"`mutant:{flaw.mutant}` {flaw.wrong}.\n\n"
        f"{picture(flaw)}"
        f"- On the road: {flaw.road}\n"
        f"- How it comes about: {flaw.origin}\n"
        f"- Found by: {describe_checks(flaw.found_by)}.\n"
    )


def picture(flaw: Flaw) -> str:
    """Return the line that shows the picture of ``flaw``; empty without one."""
    path = f"{PICTURES}/{flaw.mutant}.svg"
    if not (DOCS / path).exists():
        return ""
    return f"![The profile of {flaw.mutant} over the true one]({path})\n\n"


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
