"""The road-prior smoother: a profile through a stop from nominal sensors.

- `symbols`: what the sensors recorded, and the constants of the model.
- `pitch`: the body's pitch response to longitudinal acceleration, and the tilt error (1.5).
- `model`: the linear state-space model and its discretization.
- `smoother`: Kalman filter forward, smoother of Rauch, Tung and Striebel backward.
- `least_squares`: the same posterior from one least-squares problem, with matrices of its own.

It is not in the dissertation. A high-pass filter in time goes on forgetting the road while the
vehicle stands on it; here the road z under the laser is a process in distance, which stands still
when the vehicle does. With r, v, b the height of the reference point, its velocity and the slow
bias of the accelerometer, κ_j unknown constants and u_j known signals, for each track

    r' = v,  v' = a_m - b - Σ κ_j u_j + w_a,  b' = w_b,  κ_j' = 0,
    dz = -(V/λ_p) z dt + √(q V) dW,  and at every laser sample h = r - z + n.

At V = 0 the state z freezes, and the height sensor observes r, v and b by a fixed mark; at speed z
is free and the accelerometer decides. The profile is r - h, as in (6.57).
"""
