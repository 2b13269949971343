"""Appendix C, Linearized System Equations.

- `symbols`: the abbreviations and the state vector (C.1, C.2).
- `process_model`: the Jacobians of the process model and its noise (C.3 to C.6).
- `measurement_model`: those of the measurement model (C.7 to C.10).

Every matrix is as printed; central differences of (6.47) and (6.48) confirm all of their
elements. The lever arm may also have a part forward, which the print leaves out.
"""
