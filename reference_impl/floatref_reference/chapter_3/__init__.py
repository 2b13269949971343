"""Chapter 3, Evaluation of Existing Inertial Profilers: how its runs and results are described.

- `section_3_1_2_filters`: the filters of other profilers (Table 3.2).
- `section_3_2_2_coordinates`: local coordinates from GPS (3.1 to 3.4).
- `section_3_2_3_speed`: forward and leftward speed, acceleration over one second.
- `section_3_3_5_1_characterization`: average and peak deceleration, place and duration of a stop.
- `section_3_3_5_3_braking`: altered and increased roughness after a brake (Tables 3.7 to 3.9).
- `section_3_3_7_2_stops`: the contaminated length around a stop (Table 3.10).
"""
