"""MkDocs hook: equations in TeX, between dollars, are typeset while the site is built.

The pages then need neither a script nor the network to show them, and an equation that KaTeX cannot
read stops the build. Equations are replaced last of all, so that the index of the search has their
TeX.
"""

import html
import re
from functools import cache
from pathlib import Path

import dukpy
from mkdocs.exceptions import PluginError
from mkdocs.structure.pages import Page

KATEX = Path(__file__).parents[1] / "docs" / "assets" / "katex" / "katex.min.js"
MARKED = re.compile(
    r'<(?P<tag>span|div) class="arithmatex">\\[(\[](?P<tex>.*?)\\[)\]]</(?P=tag)>', re.DOTALL
)
"""What pymdownx.arithmatex leaves of an equation: a span in a line, a div on its own."""
CALL = "katex.renderToString(dukpy.tex, {displayMode: dukpy.display, strict: 'error'})"


def on_post_page(output: str, page: Page, **_: object) -> str:
    """Return the page ``output`` with its equations typeset."""
    try:
        return typeset(output)
    except ValueError as error:
        raise PluginError(f"{page.file.src_uri}: {error}") from error


def typeset(text: str) -> str:
    """Return the HTML ``text`` with its equations typeset; ValueError at a wrong one."""
    return MARKED.sub(_typeset_one, text)


def _typeset_one(found: re.Match[str]) -> str:
    tag, tex = found["tag"], html.unescape(found["tex"]).strip()
    return f'<{tag} class="arithmatex">{render(tex, tag == "div")}</{tag}>'


@cache
def render(tex: str, display: bool) -> str:
    """Return the equation ``tex`` as HTML and MathML; raise ValueError if KaTeX cannot read it."""
    try:
        return str(_katex().evaljs(CALL, tex=tex, display=display))
    except dukpy.JSRuntimeError as error:
        reason = str(error).partition("\n")[0]
        raise ValueError(f"equation {tex!r}: {reason}") from error


@cache
def _katex() -> dukpy.JSInterpreter:
    interpreter = dukpy.JSInterpreter()
    interpreter.evaljs(KATEX.read_text(encoding="utf-8"))
    return interpreter
