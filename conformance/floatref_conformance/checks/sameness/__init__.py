"""The checks of what has to stay the same: two passes agree, other settings change nothing."""
