"""What a value shows of itself: one line, a small table, and views made by rooms above."""
