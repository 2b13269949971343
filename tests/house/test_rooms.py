"""The rooms: small enough to overlook, each idea in one of them, and tests that mirror them."""

from collections import Counter, defaultdict
from pathlib import Path
from statistics import median

ROOT = Path(__file__).parents[2]
PACKAGES = {
    "sdk": "floatref",
    "adapters": "floatref_adapters",
    "conformance": "floatref_conformance",
    "reference_impl": "floatref_reference",
}
LONGEST = 260
LONG = {"sdk/floatref/estimators/kalman/forward.py": 555}
"""Compiled loops that call each other share a file, or their caches go stale."""
FULL = 16
SAME_ROLE = {
    "__main__": "what `python -m` runs",
    "adapter": "the class by which a format is read",
    "command": "the sub-command of a folder of `cli`",
    "forward": "the forward pass of a filter",
}
"""Names of modules that may stand in three rooms or more: each has the same role in all."""

ROOMS_OF_TESTS = {
    "sdk/estimators/kalman/plain": "a second filter, written plainly, with fixtures of its own",
    "sdk/c/kalman": "the Kalman objects of the C library, which is one package in Python",
    "sdk/c/kalman/sdk": "the same held to the SDK, with fixtures of their own",
    "sdk/c/road_prior": "the road prior of the C library, which is one package in Python",
}
"""Folders of tests that mirror no room."""


def modules(room: str) -> list[Path]:
    """Return the modules of ``room``, packages left out."""
    return [p for p in (ROOT / room / PACKAGES[room]).rglob("*.py") if p.name != "__init__.py"]


def length(path: Path) -> int:
    """Return the number of lines in ``path``."""
    return len(path.read_text(encoding="utf-8").splitlines())


def test_modules_stay_short() -> None:
    ours = [p for room in (*PACKAGES, "tests", "docs", ".ci") for p in (ROOT / room).rglob("*.py")]
    names = {p.relative_to(ROOT).as_posix(): p for p in ours}
    too_long = {n: length(p) for n, p in names.items() if length(p) > LONG.get(n, LONGEST)}
    assert not too_long
    assert set(LONG) <= set(names)


def test_modules_are_ideas_and_not_shreds() -> None:
    # The reference follows the chapters of the papers, however short these are.
    lengths = [length(p) for room in PACKAGES for p in modules(room) if room != "reference_impl"]
    assert median(lengths) >= 110


def test_no_folder_is_crowded() -> None:
    # The reference follows the chapters of the papers, however long these are.
    rooms = [room for room in PACKAGES if room != "reference_impl"]
    crowd = Counter(p.parent.relative_to(ROOT).as_posix() for r in rooms for p in modules(r))
    assert not {folder: n for folder, n in crowd.items() if n > FULL}


def test_the_name_of_a_module_says_more_than_its_folder() -> None:
    assert not [p for room in PACKAGES for p in modules(room) if p.stem == p.parent.name]


def test_a_name_stands_in_three_rooms_for_the_same_role_only() -> None:
    rooms: dict[str, list[str]] = defaultdict(list)
    for path in (p for room in PACKAGES if room != "reference_impl" for p in modules(room)):
        rooms[path.stem].append(path.parent.relative_to(ROOT).as_posix())
    crowded = {stem: where for stem, where in rooms.items() if len(where) > 2}
    assert set(crowded) <= set(SAME_ROLE), crowded


def test_tests_mirror_the_rooms() -> None:
    for room, package in PACKAGES.items():
        code = ROOT / room / package
        for path in (ROOT / "tests" / room).rglob("test_*.py"):
            folder = path.parent.relative_to(ROOT / "tests" / room)
            listed = f"{room}/{folder.as_posix()}" in ROOMS_OF_TESTS
            assert listed or (code / folder).is_dir(), f"{path.relative_to(ROOT)} tests no room"
