"""What comes from a device can be shown anywhere: it stays text, whatever is in it."""

from xml.etree import ElementTree

from hypothesis import given
from hypothesis import strategies as st

from floatref_conformance.render.text import printable

ANY = st.text(alphabet=st.characters(exclude_categories=()))


@given(ANY)
def test_what_is_shown_can_be_encoded_and_stand_in_xml(text):
    shown = printable(text)
    element = ElementTree.Element("text")
    element.text = shown
    assert ElementTree.fromstring(ElementTree.tostring(element, encoding="utf-8")).text == (
        shown or None
    )


@given(ANY)
def test_showing_a_text_twice_changes_nothing(text):
    assert printable(printable(text)) == printable(text)


def test_plain_text_letters_of_all_kinds_and_emoji_stay():
    for text in ("IRI 1.2 m/km, −3 dB", "Prüfgerät 測定\n\tµ", "\U0001f468\u200d\U0001f469"):
        assert printable(text) == text


def test_controls_surrogates_and_turned_text_become_escapes():
    assert printable("\x1b[31m\x00\r") == "\\x1b[31m\\x00\\x0d"
    assert printable("\ud800\ufffe\u202e") == "\\ud800\\ufffe\\u202e"
    assert printable("\U0010ffff") == "\\U0010ffff"
