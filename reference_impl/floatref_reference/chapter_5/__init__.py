"""Chapter 5, Error Suppression Algorithms: the profile pipelines of both architectures.

- `section_5_2`: the runs of Tables 5.1 and 5.2.
- `section_5_3`: basic temporal algorithm, and the procedures every algorithm shares.
- `section_5_4`: temporal mean removal.
- `section_5_5`: temporal high-pass filtering before integration.
- `section_5_6`: speed of travel and local suppression (5.1, 5.2).
- `section_5_7`: adaptive high-pass filtering, backward pass in time or in distance (5.3).
- `section_5_8`: basic spatial algorithm (5.4 to 5.6).
- `section_5_9`: spatial high-pass filtering before integration.
- `section_5_10`: timer distortion and height-sensor reflection (5.7 to 5.9).
"""
