"""Imine et al.: the road from a trailer's response, by an observer with unknown inputs.

Source: H. Imine, N. K. M'Sirdi, L. Laval, Y. Delanne, "Observers with Unknown Inputs for
Estimation of the Road Profile".

- `section_2_trailer`: the equations of motion (1) to (7).
- `section_4_state_form`: state (8) and input-dependent part (9).
- `section_4_a_observer`: observer (10) and estimator (11).
- `section_4_b_convergence`: the composite error matrix (12) to (15), and (19), (20).
- `section_5_simulation`: the integration of order 4, and the chirp.

Heights are positive upward, roll θ right side up and pitch φ positive where the end with the axle
falls, both against the rest of the reference. Matrices are float64.
"""
