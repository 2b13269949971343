"""The equations of three papers, one by one, for checking everything else against.

Source: S. M. Karamihas, "Improvement of Inertial Profiler Measurements of Urban and
Low-Speed Roadways", PhD dissertation, University of Michigan, 2021; and two papers on the road from
the response of a vehicle. The tree is their tables of contents:

- `appendix_a`: the digital filters (A.1 to A.22).
- `appendix_c`: the Jacobians of the Kalman filter (C.1 to C.10).
- `chapter_2`: the measures, the kinematics and the inverted pendulum (2.1 to 2.26).
- `chapter_3`: how runs and their results are described (3.1 to 3.4), filters of other profilers.
- `chapter_5`: the profile pipelines that use no inertial platform (5.1 to 5.9).
- `chapter_6`: the extended Kalman filter and its smoother (6.1 to 6.66).
- `zhu_2021`: joint input-state estimation on a half car, Zhu et al. (2021), (1) to (16).
- `imine`: the observer with unknown inputs on a trailer, Imine et al., (1) to (20).
- `beyond`: what the dissertation does not have, built from its equations.
- `road_prior`: nor this, a smoother that knows the road as a process in distance.
- `ride_measures`: measures that contracts pay by, from standards and public reports.

Correct and readable come before fast. Loops are plain, symbols carry the names of the paper,
filters and sums run in `numpy.longdouble`, the matrices of chapter 6, of the road prior and of the
two papers in float64, and numpy is the only import. Where the print holds a slip, the docstring
says what is printed and what is computed.

Units are SI. In chapters 2 and 5 and in the road prior the accelerometer has 1 g removed, so it
reads 0 at rest and level; in chapter 6 it reads +g. Indices start at 0 in the code and at 1 in the
paper. Pitch is positive nose down, roll positive left side up, but in the two papers their signs.
"""
