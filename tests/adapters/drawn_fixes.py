"""Fixes of a receiver, drawn."""

from hypothesis import strategies as st

from floatref_adapters.testing.fixes import Fixes


def draw_fixes(draw: st.DrawFn, start_ms: int, steps_ms: list[int], decimals: int) -> Fixes:
    """Draw fixes anywhere on earth, the geoid's separation rounded to ``decimals``."""
    rows = draw(st.integers(1, 12))
    step = draw(st.sampled_from(steps_ms))

    def column(low: float, high: float) -> list[float]:
        return draw(st.lists(st.floats(low, high), min_size=rows, max_size=rows))

    return Fixes(
        [start_ms + step * k for k in range(rows)],
        column(-90, 90),
        column(-180, 180),
        column(-400, 9000),
        [round(x, decimals) for x in column(-107, 86)],
        draw(st.lists(st.sampled_from([0, 1, 2, 4, 5]), min_size=rows, max_size=rows)),
        column(0, 90),
        column(0, 359.9),
        column(-5, 5),
    )
