"""Chapter 6, Sensor Augmentation: the multi-rate extended Kalman filter and its smoother.

- `section_6_1_1_linear`: linear Kalman filter (6.5, 6.7).
- `section_6_1_2_extended`: extended Kalman filter (6.9 to 6.15).
- `section_6_1_3_multi_rate`: steps without an observation (6.16).
- `section_6_1_4_smoother`: the smoother of Rauch, Tung and Striebel (6.17 to 6.22).
- `section_6_2_frames`: direction cosines and the rates of the Euler angles (6.23 to 6.28).
- `section_6_3_2_inertial_sensors`: what gyroscopes and accelerometers read (6.29 to 6.37).
- `section_6_3_4_gps_height`: what GPS reads as height and velocity (6.39 to 6.42).
- `section_6_3_5_gps_attitude`: what it reads as pitch and roll (6.43 to 6.46).
- `section_6_3_6_system`: process model and measurement model (6.38, 6.47, 6.48).
- `section_6_4_1_allan`: Allan variance (6.49 to 6.53).
- `section_6_4_2_gyroscopes`: the noise of a rate gyroscope (6.54 to 6.56).
- `section_6_4_2_distribution`: autocorrelation (figure 6.5) and tests for normality.
- `section_6_4_3_gps`: the standard deviations that a receiver reports.
- `section_6_4_4_tuning`: Table 6.1, per time step and as densities.
- `section_6_5_implementation`: filter, smoother and profile (6.57).
- `section_6_6_2_gps`: observed by GPS.
- `section_6_6_3_reflection`: with height-sensor reflection at stops (6.58 to 6.61).
- `section_6_6_4_constant_attitude`: without GPS attitude (6.62 to 6.64).
- `section_6_6_5_constant_height`: without GPS (6.65, 6.66).

States and covariances are float64, which `numpy.linalg` needs. The state is that of (C.2), the
matrices are those of appendix C; GPS means any satellite navigation, as in the text.
"""
