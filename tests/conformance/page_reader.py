"""Reads a page that was written: its elements, its words, and whether it closes as it opens."""

from html.parser import HTMLParser

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
