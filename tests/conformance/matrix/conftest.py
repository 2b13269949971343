"""Reports as files, of devices with given shares of their limits."""

import json

import pytest

OUTCOMES = {True: "pass", False: "fail"}


def make_check(id_, share=None, **changes):
    """Return a check of a report; one without a share was not run."""
    worst = share is not None and {
        "value": 0.5 * share,
        "limit": 0.5,
        "unit": "m/km",
        "quantity": "IRI error",
        "track": "left",
        "case": f"{id_}-3",
        "margin": 1.0 - share,
    }
    return {
        "id": id_,
        "outcome": OUTCOMES[share <= 1] if worst else "skip",
        "reason": "" if worst else "not selected",
        "class_reached": None,
        "cases": 3 if worst else 0,
        "worst": worst or None,
        "shown": worst or None,
        "clause": "R 56-14, 6",
        "flagged_m": 0.0,
        "counterexample": None,
        **changes,
    }


def make_document(shares, **changes):
    """Return the document of a report with ``shares`` by check id."""
    about = {"spec": "exec:./firmware", "name": "firmware", "version": "2"}
    failed = any(share is not None and share > 1 for share in shares.values())
    return {
        "format": "conformance-report/1",
        "edition": "2026.2",
        "device": {**about, "architecture": "temporal", "capabilities": []},
        "class": "nominal",
        "class_reached": None,
        "seed": 0,
        "effort": "quick",
        "verdict": "FAIL" if failed else "INCOMPLETE",
        "checks": [make_check(id_, share) for id_, share in shares.items()],
        "replayed": [],
        **changes,
    }


@pytest.fixture
def stored(tmp_path):
    """Return a function that writes a report of the shares given, in a folder of its own."""

    def write(name, shares, **changes):
        folder = tmp_path / name
        folder.mkdir(parents=True)
        text = json.dumps(make_document(shares, **changes))
        (folder / "report.json").write_text(text, encoding="utf-8")
        return folder

    return write
