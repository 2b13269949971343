r"""Texts in the cells of CSV files that we write, which a spreadsheet must not take for formulas.

A program that opens a CSV file calculates a cell that begins with =, +, - or @, so that the name of
a file could call another program. As the guides on CSV injection say, an apostrophe goes before
such a text. Control characters, which a terminal obeys, are written as \x and two hexadecimal
digits. `read_cell` gives the text back. Columns of numbers are not concerned.
"""

import re

FORMULA = re.compile(r"\s*[=+\-@＝＋－＠']")  # Spreadsheets of East Asia take these.
"""What a formula begins with; the apostrophe, so that it is not taken for ours."""
NUMBER = re.compile(r"[+-]?[0-9]+([.,][0-9]+)?([eE][+-]?[0-9]+)?")
"""A text that is a number is harmless, and remains one."""
UNSAFE = re.compile(r"[\x00-\x1f\x7f-\x9f]|\\(?=x)")
"""Control characters, and the backslash of what reads like the escape of one."""
ESCAPE = re.compile(r"\\x([0189][0-9a-f]|5c|7f)")
"""How `UNSAFE` is written; other texts that look so are not ours."""


def write_cell(text: str) -> str:
    """Return ``text`` as a CSV file of ours has it."""
    safe = UNSAFE.sub(lambda found: f"\\x{ord(found[0]):02x}", text)
    return f"'{safe}" if FORMULA.match(text) and not NUMBER.fullmatch(text) else safe


def read_cell(cell: str) -> str:
    """Return the text of ``cell``, which `write_cell` has written, or another program."""
    text = ESCAPE.sub(lambda found: chr(int(found[1], 16)), cell)
    return text[1:] if text.startswith("'") and FORMULA.match(text[1:]) else text
