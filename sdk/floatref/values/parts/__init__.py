"""Parts of values, and what pictures need of long ones: extremes, and units."""
