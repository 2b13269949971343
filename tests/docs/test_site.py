"""The site: no page is hidden, titles open their pages, and pages need no network.

All laws hold for the pages without their API, which are built in seconds, and for the whole site.
"""

import hashlib
import os
import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

import pytest
import yaml

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
CONFIG = ROOT / ".mkdocs.yml"
VENDORED = sorted(DOCS.glob("assets/*/SOURCE.md"))
PAGES = sorted(page for page in DOCS.rglob("*.md") if page not in VENDORED)
TABS = ["Start", "Firmware", "Agency", "Algorithms", "Spec"]


class Loader(yaml.SafeLoader):
    """YAML as MkDocs writes it."""


class Element(NamedTuple):
    """A start tag, and all text up to the end of its element."""

    tag: str
    attributes: dict[str, str]
    text: list[str]

    def has(self, name: str) -> bool:
        """Return whether ``name`` is one of the element's classes."""
        return name in self.attributes.get("class", "").split()


class Page(HTMLParser):
    """The elements of a page in their order, each with its text."""

    EMPTY = frozenset(("area", "br", "hr", "img", "input", "link", "meta", "source", "wbr"))

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[Element] = []
        self._open: list[Element] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the element, and open it if it can have text."""
        self.elements.append(Element(tag, {name: value or "" for name, value in attrs}, []))
        if tag not in self.EMPTY:
            self._open.append(self.elements[-1])

    def handle_endtag(self, tag: str) -> None:
        """Close the element, and those within that have no end."""
        if any(element.tag == tag for element in self._open):
            while self._open.pop().tag != tag:
                pass

    def handle_data(self, data: str) -> None:
        """Note the text for every element around it."""
        for element in self._open:
            element.text.append(data)

    def inside(self, name: str) -> list[Element]:
        return [element for element in self.elements if element.has(name)]


def leaves(nav: list[object]) -> Iterator[tuple[str, str]]:
    """Yield title and file of every entry of the menu ``nav``; the title may be empty."""
    for entry in nav:
        if isinstance(entry, str):
            yield "", entry
        elif isinstance(entry, dict):
            for title, inner in entry.items():
                yield from leaves(inner) if isinstance(inner, list) else [(title, inner)]


def menu() -> list[dict[str, list[object]]]:
    text = CONFIG.read_text(encoding="utf-8")
    nav: list[dict[str, list[object]]] = yaml.load(text[text.index("\nnav:") :], Loader)["nav"]
    return nav


def heading(source: str) -> str:
    """Return the first heading of a page of ``docs``."""
    found = re.search(r"^# (.+)$", (DOCS / source).read_text(encoding="utf-8"), re.M)
    assert found, source
    return found[1].replace("`", "")


def built(source: str) -> str:
    """Return the page of the site that ``source`` becomes."""
    return re.sub(r"README$", "index", source.removesuffix(".md")) + ".html"


def text_of(element: Element) -> str:
    """Return the text of ``element`` in one line, without the sign of a permanent link."""
    return " ".join("".join(element.text).split()).removesuffix("¶").strip()


def prose(source: Path) -> str:
    """Return the text of a page without code and without the targets of links."""
    text = source.read_text(encoding="utf-8")
    text = re.sub(r"^( *)```.*?^\1```$", "", text, flags=re.M | re.S)
    text = re.sub(r"`[^`]+`", "", text)
    return re.sub(r"\]\([^)]*\)|\]\[[^\]]*\]|^:::.*$(\n    .*$)*", "", text, flags=re.M)


def equations(source: Path) -> list[str]:
    """Return the equations of a page in TeX."""
    return re.findall(r"\$\$.+?\$\$|\$[^$\n]+\$", prose(source), re.S)


def parsed(site: Path, source: str) -> Page:
    return Page((site / built(source)).read_text(encoding="utf-8"))


def test_every_page_is_in_the_menu_once_under_a_tab() -> None:
    nav = menu()
    assert [title for tab in nav for title in tab] == TABS
    files = [file for _, file in leaves(list(nav))]
    assert sorted(files) == [page.relative_to(DOCS).as_posix() for page in PAGES]


@pytest.mark.slow
@pytest.mark.parametrize("start", ["index.md", "decisions/0004-gaps.md"])
def test_every_title_of_the_menu_opens_the_page_of_its_own_file(site: Path, start: str) -> None:
    (side,) = [e for e in parsed(site, start).inside("md-nav--primary") if e.tag == "nav"]
    links = [e for e in parsed(site, start).inside("md-nav__link") if e.tag == "a"]
    opened = {}
    for link in links:
        target = unquote(urlsplit(link.attributes["href"]).path)
        if target and not link.attributes["href"].startswith("#"):
            where = os.path.normpath((site / built(start)).parent / target)
            opened[Path(where).relative_to(site).as_posix()] = text_of(link)
    assert side
    for title, file in leaves(list(menu())):
        assert opened.pop(built(file)) == (title or heading(file)), file
        (first,) = [e for e in parsed(site, file).elements if e.tag == "h1"][:1]
        assert text_of(first) == heading(file), file
    assert opened == {}


@pytest.mark.slow
def test_a_tab_opens_the_first_page_of_its_own(site: Path) -> None:
    tabs = [e for e in parsed(site, "index.md").inside("md-tabs__link") if e.tag == "a"]
    first = {title: built(next(leaves(inner))[1]) for tab in menu() for title, inner in tab.items()}
    assert {text_of(tab): tab.attributes["href"] for tab in tabs} == first


@pytest.mark.slow
def test_every_equation_is_typeset(site: Path) -> None:
    seen = 0
    for source in PAGES:
        page = parsed(site, source.relative_to(DOCS).as_posix())
        found = page.inside("katex")
        assert len(found) == len(equations(source)) == len(page.inside("arithmatex")), source
        assert not page.inside("katex-error"), source
        (content,) = [e for e in page.elements if e.tag == "article"]
        code = "".join("".join(e.text) for e in page.elements if e.tag == "code")
        for mark in (r"\(", r"\[", "$$"):
            assert "".join(content.text).count(mark) == code.count(mark), (source, mark)
        seen += len(found)
    assert seen > 300


def test_no_equation_is_left_as_plain_text() -> None:
    for source in PAGES:
        rest = re.sub(r"\$\$.+?\$\$|\$[^$\n]+\$", "", prose(source), flags=re.S)
        found = re.findall(r"[\u0300-\u036f₀-₉ₐ-ₜᵀ∫∬∑Σ′″].*|\b[a-zA-Zα-ω]_[a-zα-ω0-9{].*", rest)
        assert not found, source


@pytest.mark.parametrize("tex", [r"\frac{a", r"\unknown", "a_b_c"])
def test_an_equation_that_cannot_be_read_stops_the_build(
    monkeypatch: pytest.MonkeyPatch, tex: str
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    from typeset import typeset

    assert "katex" in typeset(r'<span class="arithmatex">\(a_b\)</span>')
    with pytest.raises(ValueError, match="KaTeX parse error"):
        typeset(rf'<span class="arithmatex">\({tex}\)</span>')


def loaded(page: Page) -> Iterator[str]:
    """Yield what a browser loads with ``page``: scripts, styles, pictures."""
    for element in page.elements:
        if element.tag == "link" and element.attributes["rel"] in ("canonical", "next", "prev"):
            continue
        for name in ("src", "href") if element.tag != "a" else ():
            if name in element.attributes:
                yield element.attributes[name]


@pytest.mark.slow
def test_what_a_page_loads_is_in_the_site(site: Path) -> None:
    for path in site.rglob("*.html"):
        if path.name != "404.html":
            for target in loaded(Page(path.read_text(encoding="utf-8"))):
                parts = urlsplit(target)
                assert (parts.scheme, parts.netloc) == ("", ""), (path, target)
                assert (path.parent / unquote(parts.path)).exists(), (path, target)


@pytest.mark.slow
def test_what_a_style_loads_is_in_the_site(site: Path) -> None:
    for path in site.rglob("*.css"):
        for rule in re.findall(r"@font-face\{.*?\}|url\([^)]*\)", path.read_text(encoding="utf-8")):
            # Of the forms of a font a browser takes the first that it knows.
            target = re.findall(r"url\([\"']?(.*?)[\"']?\)", rule)[0]
            if not target.startswith(("data:", "#")) and not target.endswith((".woff", ".ttf")):
                assert (path.parent / target).is_file(), (path, target)


@pytest.mark.parametrize("source", VENDORED, ids=lambda source: source.parent.name)
def test_files_of_others_are_those_of_their_source_and_carry_its_licence(source: Path) -> None:
    rows = re.findall(r"^\| (\S+) \| (\d+) \| (\w{64}) \|$", source.read_text("utf-8"), re.M)
    folder = source.parent
    files = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
    assert files == {name for name, _, _ in rows} | {"SOURCE.md", "LICENSE.txt"}
    for name, size, digest in rows:
        data = (folder / name).read_bytes()
        assert (len(data), hashlib.sha256(data).hexdigest()) == (int(size), digest), name
