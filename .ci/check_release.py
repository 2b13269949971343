"""Check an installation away from the repository, and the list of its parts.

python .ci/check_release.py installed IRI.json ROOT   # run by the installed Python
python .ci/check_release.py parts FROM.json TO.json   # keep a CycloneDX list, without local paths
"""

import importlib.metadata
import json
import sys
from pathlib import Path
from typing import Any

from packaging.utils import canonicalize_name


def check_installed(report: Path, root: Path) -> None:
    """Refuse packages that are imported from ``root``, and a profile without an IRI."""
    import floatref
    import floatref_adapters
    import floatref_conformance
    import floatref_reference

    for package in (floatref, floatref_adapters, floatref_conformance, floatref_reference):
        if root in Path(str(package.__file__)).parents:
            raise SystemExit(f"{package.__name__} is imported from the repository")
    tracks = json.loads(report.read_text(encoding="utf-8"))["tracks"]
    print(f"floatref {floatref.__version__} installed:", *(track["name"] for track in tracks))


def keep_parts(source: Path, target: Path) -> None:
    """Write the list without places on this machine; refuse one that lacks an installed package."""
    document = json.loads(source.read_text(encoding="utf-8"))
    for part in document["components"]:
        part.pop("externalReferences", None)
        part.pop("evidence", None)
    ours = next(part for part in document["components"] if part["name"] == "floatref")
    ours["licenses"] = [{"license": {"id": "Apache-2.0"}}]
    document["metadata"]["component"] = _main_component(document, ours)
    missing = _installed() - {canonicalize_name(part["name"]) for part in document["components"]}
    if missing - {"floatref"}:
        raise SystemExit(f"not in the list of parts: {', '.join(sorted(missing))}")
    text = json.dumps(document, indent=2) + "\n"
    if "file://" in text:
        raise SystemExit("the list of parts names a place on this machine")
    target.write_text(text, encoding="utf-8")
    print(f"{target.name}: {len(document['components'])} parts of floatref {ours['version']}")


def _main_component(document: dict[str, Any], ours: dict[str, Any]) -> dict[str, Any]:
    """Return floatref as what the list is about, and take it out of the list."""
    document["components"].remove(ours)
    return {**document["metadata"].get("component", {}), **ours, "type": "library"}


def _installed() -> set[str]:
    """Return the names of all packages of this Python."""
    return {canonicalize_name(each.name) for each in importlib.metadata.distributions()}


if __name__ == "__main__":
    what, first, second = sys.argv[1:]
    (check_installed if what == "installed" else keep_parts)(Path(first), Path(second))
