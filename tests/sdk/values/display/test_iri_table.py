"""The IRI of a profile as text: a mean never stands without the share that it is over."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.display.iri_table import ProfileIri, TrackIri

IRIS = st.one_of(st.just(math.nan), st.floats(0.0, 100.0))


@given(IRIS, st.floats(0.0, 1.0), IRIS)
def test_every_figure_is_with_its_share(valid: float, share: float, every: float) -> None:
    found = ProfileIri((TrackIri("left", valid, share, every),))
    shown = "–" if math.isnan(valid) else f"{valid:.3f}"
    for text in (repr(found), found._repr_html_()):
        assert shown in text
        assert f"{found['left'].cells[2]}" in text
        assert ("–" if math.isnan(every) else f"{every:.3f}") in text
    assert f"{shown} m/km over " in repr(found)
    assert "\n" not in repr(found)


def test_an_unknown_wheel_path_is_named_with_the_nearest() -> None:
    found = ProfileIri((TrackIri("left", 1.0, 1.0, 1.0), TrackIri("right", 2.0, 1.0, 2.0)))
    assert found["right"].valid_m_per_km == 2.0
    assert [each.track for each in found] == ["left", "right"]
    with pytest.raises(
        InputError, match=r"track rihgt: missing; .* left, right; did you mean right"
    ):
        found["rihgt"]
