"""Zhu et al. (2021): the road from a half car's response, by joint input-state estimation.

Source: J. Zhu, X. Chang, X. Zhang, Y. Su, X. Long, "A Novel Method for the Reconstruction of Road
Profiles from Measured Vehicle Responses Based on the Kalman Filter Method", 2021.

- `symbols`: the types of section 2 and section 3.
- `section_2_vehicle`: Table 1, the equations of motion (2) to (7), the delay between axles (8).
- `section_3_state_space`: state and measurements (9) to (11).
- `section_3_discretization`: (12), by precise integration and by two holds of the force.
- `section_3_joint_estimation`: steps (a) to (c).
- `section_4_1_random_road`: the road (14), (15), and the covariances of the print.
- `section_4_2_uneven_road`: the rectangular obstacle (16).
- `section_4_3_speed`: calculation rate, and the error as a percentage.
- `section_5_singular_spectrum`: the filter of noisy test data.

Heights are positive upward and pitch θ nose up, against the rest of the reference. Matrices are
float64.
"""
