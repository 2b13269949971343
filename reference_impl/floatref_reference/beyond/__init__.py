"""What goes beyond the dissertation, in its symbols and on its equations.

- `matched_high_pass`: the adaptive high-pass filter of section 5.7 as an observer.
- `state_variable`: its backward stages over distance, with the cut-off inside the integrals.
"""
