"""What goes beyond the dissertation, in its symbols and on its equations.

- `iri_interval`: how far an IRI may be off, from the 1-sigma of the elevation.
- `iri_of_valid`: the IRI of the valid points of a profile, by segment.
- `innovations`: whether those of a Kalman filter are as large as it expects.
- `matched_high_pass`: the adaptive high-pass filter of section 5.7 as an observer.
- `quarter_car_response`: a quarter car with masses, for the estimators of the road from response.
- `reflection_beside_gps`: at a stop the height alone comes from the height sensor.
- `state_variable`: its backward stages over distance, with the cut-off inside the integrals.
"""
