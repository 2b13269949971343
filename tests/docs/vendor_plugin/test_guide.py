"""The guide prints what it shows, and shows the example as it is.

After a change that moves it: `pip install ./docs/examples/vendor_plugin`, then
`python .ci/consoles.py --write docs/your-format.md`, and look at the difference.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "your-format.md"


@pytest.mark.slow
def test_every_command_of_the_guide_prints_what_the_page_shows(installed):
    installed.run("python", ROOT / ".ci" / "consoles.py", PAGE)


def test_the_code_of_the_guide_is_that_of_the_example(plugin):
    sources = [path.read_text() for path in plugin.rglob("*.py")]
    sources.append((plugin / "pyproject.toml").read_text())
    shown = re.findall(r"^```(?:python|toml)\n(.*?)^```$", PAGE.read_text(), re.M | re.S)
    assert len(shown) == 5
    for code in shown:
        assert any(code in source for source in sources), code


def test_the_table_of_the_plug_in_names_every_file(plugin):
    listed = re.findall(r"^\| `(\S+\.py)`", (plugin / "README.md").read_text(), re.M)
    files = {p.relative_to(plugin).as_posix() for p in plugin.rglob("*.py")}
    assert set(listed) == {name for name in files if not name.endswith("__init__.py")}
