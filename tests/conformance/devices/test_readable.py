"""What a device says is shown in one short line."""

from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.devices.process import readable


@settings(deadline=None, max_examples=100)
@given(st.one_of(st.text(max_size=300), st.binary(max_size=300)), st.integers(1, 50))
def test_what_is_shown_is_one_short_line_that_prints(text, longest):
    shown = readable(text, longest)
    assert shown.isprintable()
    assert len(shown) <= longest
    assert shown == shown.strip()


@given(st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=50))
def test_a_plain_word_is_shown_as_it_is(word):
    assert readable(word) == readable(word.encode()) == word
