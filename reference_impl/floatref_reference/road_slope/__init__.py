"""The slope under the wheels: the pitch of the body through a stop, from the measured road.

- `constants`: noise, and what is known of a vehicle before the readings.
- `symbols`: what the sensors recorded, and where they are.
- `unknowns`: the unknown vector by names, where it starts, and the ranges of some of it.
- `wheels`: the road's points, what a node passes over, and the slope of the line through both
  axles.
- `middles`: second differences, means and rates at nodes with both neighbours.
- `along`: acceleration as sharp as the encoder allows, and jolts.
- `springs`: the body as a half car.
- `priors`: what drifts from node to node, and what is known of constants.
- `rows`: all misfits over their 1-σ.
- `bends`: the intensity of the slope, one value for each 10 m.
- `held`: what is held while the unknowns of a pass are found.
- `gauss_newton`: least squares by dense matrices, and its covariance.
- `levelled`: what a level accelerometer would read.
- `doubt`: how sure the elevation is.

It is not in the dissertation; docs/road-prior-slope.md has the equations. Every misfit is a plain
sum over nodes or points, and its derivatives are by the complex step, so that no row is written
twice.
"""
