"""How many rows an adapter delivers together."""

MOST_ROWS = 1 << 16
MOST_SAMPLES = 1 << 22
"""Of all columns together: 32 MiB."""
FEWEST_ROWS = 1 << 10


def rows_for(columns: int) -> int:
    """Return how many rows of so many columns are a piece; all of it is in memory at once."""
    return min(max(MOST_SAMPLES // max(columns, 1), FEWEST_ROWS), MOST_ROWS)


__all__ = ["MOST_ROWS", "rows_for"]
