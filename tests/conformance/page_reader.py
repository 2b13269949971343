"""Reads a page that was written: its elements, its words, and whether it closes as it opens."""

import re
from html.parser import HTMLParser
from itertools import pairwise

VOID = {"meta", "link", "br", "hr", "img", "input"}
LEADING = {"src", "href", "action", "data", "poster", "srcset", "formaction", "xlink:href"}
HEADINGS = ("h1", "h2", "h3", "h4")


class Page(HTMLParser):
    """Collects the elements of a page, and what does not close as it opened."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.crossed, self.words = [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.crossed.append(tag)

    def handle_data(self, data):
        if not self.open or self.open[-1] != "style":
            self.words.append(data)

    def all(self, *tags):
        return [attributes for tag, attributes in self.elements if tag in tags]

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


def assert_sound(text):
    """Assert that a page closes as it opens and leads nowhere else; return what was read."""
    found = Page(text)
    assert found.crossed == found.open == []
    leading = [v for _, a in found.elements for name, v in a.items() if name in LEADING]
    assert leading
    assert all(value.startswith("#") or value == "data:," for value in leading)
    assert not re.search(r"https?://|@import|url\(", text)
    assert found.all("script", "iframe", "object", "embed", "base", "form") == []
    return found


def assert_accessible(found):
    """Assert that a page reads the same aloud as on the screen."""
    assert found.all("html") == [{"lang": "en"}]
    assert all(a.get("scope") in ("col", "row") for a in found.all("th"))
    assert all(a.get("role") == "img" for a in found.all("svg"))
    assert len(found.all("svg")) == len(found.all("desc"))
    levels = [HEADINGS.index(tag) for tag, _ in found.elements if tag in HEADINGS]
    assert levels[0] == 0
    assert all(after <= before + 1 for before, after in pairwise(levels))
