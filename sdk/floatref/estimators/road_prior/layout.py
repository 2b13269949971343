"""How the road-prior kernels lay out states, nodes and updates in plain arrays.

See `floatref.estimators.kalman.layout` on caches of compiled kernels.
"""

STATES = 7
"""Height, velocity, bias of the acceleration, elevation of the road under the laser and slope of
its long waves, and what longitudinal acceleration, and that times the pitch response, add to the
acceleration."""
BIAS, ROAD, SLOPE, LEAN, TILT = 2, 3, 4, 5, 6
ONCE, TWICE, STAYS, CLIMBS, JUMP, RENEWED, SPREAD = 0, 2, 4, 5, 6, 8, 9
"""Of a node: single and double integrals of both inputs since the node before (2 each), share of
the road that stays, what the slope adds to it in m, jump of height and velocity behind it, whether
lean and tilt begin anew, and the upper half of P."""
NODE = SPREAD + STATES * (STATES + 1) // 2
INNOVATION = STATES
UPDATE = INNOVATION + 2
"""Of an update: gain, innovation over S, 1/S; the row of H is the same for all."""
LEANING, TILTING, ALONG, TRAVEL, SEEN, ANEW, MISSING = 0, 1, 2, 3, 4, 5, 6
ENDS = MISSING + 1
"""Of what is known at a node: both inputs in m/s² and (m/s²)², longitudinal acceleration in m/s²,
travel since the node before in m, the height sensor's reading in m (NaN: none), whether lean and
tilt begin anew, and the share of samples missing since the node before."""
RUNNING, LATEST, STEPS, BEFORE = 0, 2, 3, 4
STILL = BEFORE + 3
MEMORY = STILL + 1
"""Of the memory: height and velocity since the node, latest acceleration, steps since the node,
inputs and longitudinal acceleration there, and for how many seconds the vehicle has not moved."""
STEP, WHITE, WALK, WALK_ALONG, READING, ROAD_STEP, ROAD_REACH = range(7)
LEAN_PRIOR, TILT_PRIOR, GAP, SLOPE_STEP, EDGE = range(ROAD_REACH + 1, ROAD_REACH + 6)
LEAN_EXPECTED, TILT_EXPECTED = EDGE + 1, EDGE + 2
MODEL = TILT_EXPECTED + 1
"""Of the model: step in s; squares of the densities of acceleration, of its bias' walk, and of what
longitudinal acceleration adds to it; variance of a reading; q in m; distance in m after which the
road is forgotten; variances of lean and tilt begun anew; square of the acceleration's density
where samples are missing; g in 1/m; square of how many deviations off a reading at a
standstill tells of an edge; lean and tilt where they begin anew."""
