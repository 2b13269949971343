"""Chapter 4, Experimental Measurements.

- `section_4_4_clocks`: internal clocks reconciled with the common clock by a common pulse.
"""
