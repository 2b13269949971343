"""Chapter 4, Experimental Measurements.

- `section_4_4_clocks`: internal clocks reconciled with the common clock by a common pulse.
- `section_4_5_lateral`: agreement and repeatability against lateral tracking.
"""
