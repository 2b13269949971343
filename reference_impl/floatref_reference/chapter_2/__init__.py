"""Chapter 2, Technical Background.

- `section_2_1_1_golden_car`, `section_2_1_1_iri`: the International Roughness Index.
- `section_2_1_2_iri_scale`: segments, units and ratings of the IRI.
- `section_2_1_3_roughness_profiles`: short-interval roughness profile.
- `section_2_1_4_1_spectral_models`: road spectra (2.1 to 2.6).
- `section_2_1_4_waveband`: frequency response and wavelength thresholds (2.7 to 2.11).
- `section_2_1_5_comparison`: cross correlation of profiles (2.12 to 2.16).
- `section_2_2_signal_flow`: floating reference height in the distance domain.
- `section_2_3_1_kinematics`: accelerations in body and wander axes (2.17 to 2.20).
- `section_2_3_2_pendulum`: the inverted pendulum (2.21 to 2.26).
"""
