"""Is a recording what it says? Units, signs, axes, clocks and places of its sensors."""
