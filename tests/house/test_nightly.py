"""The nightly part: what it leaves out of CI is slow, too, and what it runs is there."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_ci_leaves_out_what_is_nightly_and_nightly_runs_all_slow_tests():
    run = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    nightly = (ROOT / ".ci" / "nightly").read_text(encoding="utf-8")
    assert '-m "slow and not nightly"' in run
    assert '"$bin/pytest" -m slow' in nightly


def test_every_script_of_the_nightly_part_exists():
    nightly = (ROOT / ".ci" / "nightly").read_text(encoding="utf-8")
    named = re.findall(r"tests/\S+\.py", nightly)
    assert named
    for name in named:
        assert list(ROOT.glob(name)), name


def test_what_is_nightly_is_slow_in_its_module():
    """Else pytest alone would run it."""
    modules = [p for p in (ROOT / "tests").rglob("test_*.py") if p != Path(__file__)]
    texts = {path: path.read_text(encoding="utf-8") for path in modules}
    nightly = {path: text for path, text in texts.items() if "mark.nightly" in text}
    assert nightly
    for path, text in nightly.items():
        assert "mark.slow" in text, path
