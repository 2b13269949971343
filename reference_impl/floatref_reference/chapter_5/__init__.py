"""Chapter 5, Error Suppression Algorithms: the baselines of both architectures.

- `section_5_3`: basic temporal algorithm, and the procedures every algorithm shares.
- `section_5_4`: temporal mean removal.
- `section_5_8`: basic spatial algorithm.
"""
