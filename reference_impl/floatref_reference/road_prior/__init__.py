"""The road-prior smoother: a profile through a stop from nominal sensors.

- `symbols`: what the sensors recorded, and the constants of the model.
- `pitch`: the body's pitch response to longitudinal acceleration, and the tilt error (1.5).
- `road`: the road in distance, its elevation and the slope of its long waves.
- `model`: the linear state-space model and its discretization.
- `smoother`: Kalman filter forward, smoother of Rauch, Tung and Striebel backward.
- `least_squares`: the same posterior from one least-squares problem, with matrices of its own.
- `encoder`: longitudinal acceleration from the encoder.
- `fixed_lag`, `lag_sections`: the same smoother part by part, in bounded memory.
- `levelling`, `lines`: the vertical acceleration by the attitude that an inertial unit measures.

It is not in the dissertation. A high-pass filter in time forgets the road while the vehicle
is stationary; here the road under the laser, its elevation z and the slope s of its long waves, is
a process in distance, which is constant when the vehicle is stationary. With r, v, b the height of
the reference point, its velocity and the slow bias of the accelerometer, κ_j unknown constants and
u_j known signals, for each track

    r' = v,  v' = a_m - b - Σ κ_j u_j + w_a,  b' = w_b,  κ_j' = 0,
    dz = (s - z/λ_p) V dt + √(q V) dW_q,  ds = -(s/λ_p) V dt + √(g V) dW_g,

and at every laser sample h = r - z + n. Well above 1/λ_p the spectrum of z is that of (2.4) with
G_s = 2q and G_a = 2g, but for the white noise G_e, which is a part of n.

At V = 0 both z and s freeze, and the height sensor observes r, v and b by a fixed mark; at speed z
is free and the accelerometer decides. The profile is r - h, as in (6.57).
"""
