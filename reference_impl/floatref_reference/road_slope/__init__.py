"""The slope under the wheels: the pitch of the body through a stop, from the measured road.

- `symbols`: what the sensors recorded, where they are, and the constants.
- `unknowns`: the unknown vector by names, where it starts, and the ranges that it is kept in.
- `wheels`: the road's points, and slope and height of the line through both axles.
- `swing`: the body as an oscillator, exactly over three nodes.
- `rows`: all misfits over their 1-σ.
- `bends`: the intensity of the slope, one value for each 10 m.
- `gauss_newton`: least squares by dense matrices, and its covariance.
- `levelled`: what a level accelerometer would read.

It is not in the dissertation; docs/road-prior-slope.md has the equations. Every misfit is a plain
sum over nodes or points, and its derivatives are by the complex step, so that no row is written
twice.
"""
