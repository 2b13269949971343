"""What somebody may change in an archive before renewing its checksums, and what then shows it.

``alone`` is a part of what repetition without the device finds, ``with_device`` with it; empty
where it finds nothing: only a signature protects that. `docs/submit.md` lists the same.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from floatref_conformance.resemblance.comparing import LEAST
from floatref_conformance.resemblance.naming import INTERRUPTED, PROBES

SUBMISSION, REPORT, RESULTS = "submission.json", "report.json", "results/toy.json"


@dataclass(frozen=True)
class Tampering:
    """One change of an archive; a forged one has a report that follows from its results."""

    name: str
    change: Any
    alone: str
    with_device: str = ""
    forged: bool = False

    def apply(self, archive):
        self.change(archive)
        if self.forged:
            archive.forge()


def report(change):
    return lambda archive: archive.edit(REPORT, change)


def resembling(note):
    """State that no flaw was found, without features, for the reason ``note``."""
    stated = {"found_by": PROBES, "flaws": [], "least": LEAST, "features": {}, "note": note}
    return report(lambda found: found.update(resemblance=stated))


def toy(found):
    """Return the result of the toy check in a report."""
    return next(check for check in found["checks"] if check["id"] == "toy")


def check(**keys):
    return report(lambda found: toy(found).update(keys))


def both(**keys):
    """Change the same keys in the submission and in the report."""

    def change(archive):
        for name in (SUBMISSION, REPORT):
            archive.edit(name, lambda found: found.update(keys))

    return change


def submission(**keys):
    return lambda archive: archive.edit(SUBMISSION, lambda found: found.update(keys))


def device(**keys):
    return lambda archive: archive.edit(SUBMISSION, lambda found: found["device"].update(keys))


def results(change):
    return lambda archive: archive.edit(RESULTS, change)


def scale_figures(factor, limits=1.0):
    """Multiply all figures and limits of all results; what failed has to fail still."""

    def change(found):
        for measured in (m for result in found for m in result["measurements"]):
            measured["value"] *= factor
            measured["limits"] = {c: limits * x for c, x in measured["limits"].items()}

    return results(change)


def pass_all(archive):
    """Make a PASS of a FAIL: figures, cases and report fit together, the profiles do not."""
    scale_figures(0.01)(archive)
    archive.edit(RESULTS, lambda found: found.__delitem__(slice(5, None)))
    stored = [archive.read(n)["name"] for n in archive.members if n.endswith("/case.json")]
    for name, folder in zip(stored, archive.folders("answers"), strict=True):
        if "simplified" in name:
            remove(f"{folder}/")(archive)
    remove("cases/")(archive)


def passed(found):
    toy(found).update(outcome="pass", reason="", counterexample=None)
    found["verdict"] = "PASS"


def swap(found):
    found[0], found[1] = found[1], found[0]


def scale(ending, factor):
    def change(archive):
        name = archive.find(ending)
        values = np.frombuffer(archive.members[name], "<f8") * factor
        archive.members[name] = values.tobytes()

    return change


def copy(source, target):
    def change(archive):
        archive.members[archive.find(target)] = archive.members[archive.find(source)]

    return change


def remove(start):
    def change(archive):
        for name in [name for name in archive.members if name.startswith(start)]:
            del archive.members[name]

    return change


def other_inputs(archive):
    def change(found):
        found["inputs"][0]["distance.f64"] = "0" * 64

    archive.edit(archive.find("/case.json"), change)


def beside_profiles(archive):
    folder = archive.find("/case.json").removesuffix("case.json")
    archive.members[f"{folder}answer-1/readme.html"] = b"x"


def other_folder(archive):
    folder = archive.find("/case.json").removesuffix("/case.json")
    for name in [n for n in archive.members if n.startswith(f"{folder}/")]:
        archive.members[name.replace(folder, f"{folder}0")] = archive.members.pop(name)


def other_case(archive):
    name = next(name for name in archive.members if name.startswith("cases/"))
    archive.edit(name, lambda found: found["scenario"].update(seed=7))


def cut(archive):
    archive.members[RESULTS] = archive.members[RESULTS][:-100]


def state_nees(found):
    for result in found:
        result["nees"] = [["left", 1.0, 100]]


WAIVED = [{"check": "toy", "reason": "a new laser in March"}]
BARE = [{"check": "toy", "reason": " "}]
TAMPERINGS = (
    Tampering(
        "a figure of the report",
        report(lambda found: toy(found)["worst"].update(value=0.05)),
        "checks[toy].worst.value",
    ),
    Tampering("the verdict", report(lambda found: found.update(verdict="PASS")), "verdict"),
    Tampering("outcome and verdict", report(passed), "checks[toy].outcome"),
    Tampering("the class reached", check(class_reached="reference"), "class_reached"),
    Tampering("the number of cases", check(cases=9), "checks[toy].cases"),
    Tampering("the seed", both(seed=1), "edition and seed draw"),
    Tampering("the edition", both(edition="2026.1"), "edition and seed draw"),
    Tampering("the effort", both(effort="certification"), "edition and seed draw"),
    Tampering("the class", both(**{"class": "reference"}), "report.json"),
    Tampering("a result removed", results(lambda found: found.pop(0)), "edition and seed draw"),
    Tampering("two results exchanged", results(swap), "edition and seed draw"),
    Tampering("a result added", results(lambda found: found.append(found[0])), "not drawn"),
    Tampering("figures and report", scale_figures(0.95), "here it is", forged=True),
    Tampering("a PASS of a FAIL", pass_all, "here it is", forged=True),
    Tampering("limits and report", scale_figures(1.0, 1.05), "limits", forged=True),
    Tampering("the NEES", results(state_nees), "NEES of 100 points", forged=True),
    Tampering("a delivered profile", scale("answer-1/left.f64", 1.001), "here it is"),
    Tampering(
        "the truth in place of a profile",
        copy("truth-1/left.f64", "answer-1/left.f64"),
        "here it is",
    ),
    Tampering("the truth", scale("truth-1/left.f64", 1.001), "truth 1 is"),
    Tampering("profiles removed", remove("answers/"), "its profiles are missing"),
    Tampering("the hash of an input", other_inputs, "other bits"),
    Tampering("a case file", other_case, "not the simplest case"),
    Tampering("a case file removed", remove("cases/"), "not the simplest case"),
    Tampering("a member added", lambda a: a.members.update({"x.txt": b"x"}), "is no part"),
    Tampering("a file among the profiles", beside_profiles, "is no part"),
    Tampering("the search left out", submission(searching=False), "that a search draws"),
    Tampering("a case in another folder", other_folder, "is another case"),
    Tampering("a member removed", remove("report.json"), "report.json: missing"),
    Tampering("a member cut short", cut, "results/toy.json: not JSON"),
    Tampering("a waiver without reason", submission(waivers=BARE), "without a reason", forged=True),
    Tampering("a waiver added", submission(waivers=WAIVED), "", forged=True),
    Tampering("the hash of the device", device(files={"floatref": "0" * 64}), "", "device.files"),
    Tampering("the device's version", device(version="2"), "", "describes itself", forged=True),
    Tampering("the flaws that it resembles", resembling("no time"), "resemblance"),
    Tampering("these left out as if interrupted", resembling(INTERRUPTED), ""),
    Tampering("the statement", submission(statement="Passed."), ""),
    Tampering("the hash of the suite", submission(suite={"version": "1", "sha256": "0" * 64}), ""),
    Tampering("the environment", submission(environment={}), ""),
)
