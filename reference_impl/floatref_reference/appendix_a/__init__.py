"""Appendix A, Digital Filtering Technical Notes.

- `designations`: A.1, the analog transfer functions (A.1 to A.5).
- `digitization`: A.2, bilinear transform and the difference equations (A.6 to A.11).
- `table_a_1`: A.2, the coefficients of the four stages.
- `initialization`: A.3, the first samples (A.12 to A.19).
- `cut_off`: A.4 and A.5, cut-off conversions (A.20 to A.22).
- `filters`: the designated stages and filter sets, ready to apply to a signal.
- `varying`: the high-pass stages with a cut-off of its own at each sample, as section 5.7 needs.
"""
