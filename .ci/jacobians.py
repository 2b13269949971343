"""Derive the Jacobians of the Kalman filter from its model, and write their page.

    python .ci/jacobians.py [--check]

The model is typed from (6.47), (6.48) and the equations that they name; sympy differentiates it.
`tests/sdk/estimators/kalman/test_jacobians.py` holds the compiled filter to the result.
"""

import argparse
import sys
from pathlib import Path

import sympy as sp

PAGE = Path(__file__).parents[1] / "docs" / "jacobians.md"

STATE = r, v, theta, phi, delta_a, delta_1, delta_2, kappa, drift, offset = sp.symbols(
    r"r v \theta \phi \delta_a \delta_1 \delta_2 \kappa d o", real=True
)
INPUT = u_ax, u_ay, u_az, u_1, u_2, u_3 = sp.symbols("u_{ax} u_{ay} u_{az} u_1 u_2 u_3", real=True)
NOISE = e_a, e_1, e_2, e_3, e_a1, e_11, e_21 = sp.symbols(
    "e_a e_1 e_2 e_3 e'_a e'_1 e'_2", real=True
)
ARM = l_x, l_y, l_z = sp.symbols("l_x l_y l_z", real=True)
dt, g, level = sp.symbols(r"\Delta{t} g u_0", real=True)
STEP, GRAVITY, LEVEL = dt, g, level


def process() -> sp.Matrix:
    """Return f of (6.47), with the states beyond chapter 6: the lean adds to a_zp of (6.37)."""
    omega_1, omega_2, omega_3 = u_1 + delta_1 + e_1, u_2 + delta_2 + e_2, u_3 + e_3
    a = -sp.sin(theta) * u_ax + sp.cos(theta) * (sp.sin(phi) * u_ay + sp.cos(phi) * u_az)
    a += delta_a + e_a - g + kappa * (u_ax - level)
    theta_dot = sp.cos(phi) * omega_2 - sp.sin(phi) * omega_3
    phi_dot = omega_1 + sp.tan(theta) * (sp.sin(phi) * omega_2 + sp.cos(phi) * omega_3)
    motion = [r + v * dt + a * dt**2 / 2, v + a * dt, theta + theta_dot * dt, phi + phi_dot * dt]
    return sp.Matrix([*motion, delta_a + e_a1, delta_1 + e_11, delta_2 + e_21, *STATE[7:]])


def measurement() -> sp.Matrix:
    """Return h of (6.48): the antenna at the lever arm, with the drift of its height."""
    omega = sp.Matrix([u_1 + delta_1, u_2 + delta_2, u_3])
    # The third row of the rotation (2.18) from the body to the level frame.
    down = sp.Matrix([[-sp.sin(theta), sp.cos(theta) * sp.sin(phi), sp.cos(theta) * sp.cos(phi)]])
    arm = sp.Matrix(ARM)
    rise, climb = (down * arm)[0], (down * omega.cross(arm))[0]
    roll = sp.asin(sp.cos(theta) * sp.sin(phi))
    return sp.Matrix([r + rise + drift, v + climb, theta, roll])


def jacobians() -> dict[str, sp.Matrix]:
    """Return A (C.3), W (C.6) and H (C.8), without noise."""
    quiet = dict.fromkeys(NOISE, 0)
    f, h = process(), measurement()
    found = {"A": f.jacobian(STATE), "W": f.jacobian(NOISE), "H": h.jacobian(STATE)}
    return {name: matrix.subs(quiet) for name, matrix in found.items()}


def page() -> str:
    """Return the page: the model, and every element that is neither 0 nor 1."""
    parts = [HEAD.format(f=_equations("f", process().subs(dict.fromkeys(NOISE, 0))), h=_h())]
    for name, matrix in jacobians().items():
        parts.append(f"## {TITLES[name]} {{ #matrix-{name.lower()} }}\n\n{_elements(name, matrix)}")
    return "\n".join(parts)


def _h() -> str:
    return _equations("h", measurement())


def _equations(name: str, rows: sp.Matrix) -> str:
    lines = (f"$$ {name}_{{{k}}} = {_latex(row)} $$" for k, row in enumerate(rows, start=1))
    return "\n\n".join(lines)


def _elements(name: str, matrix: sp.Matrix) -> str:
    found, ones = [], []
    for i in range(matrix.rows):
        for j in range(matrix.cols):
            element = sp.factor_terms(sp.trigsimp(matrix[i, j]))
            place = f"{name}_{{{i + 1},{j + 1}}}"
            if element == 1:
                ones.append(place)
            elif element != 0:
                found.append(f"$$ {place} = {_latex(element)} $$\n")
    return "\n".join(found) + f"\nThese are 1: ${', '.join(ones)}$. All others are 0.\n"


def _latex(expression: sp.Expr) -> str:
    return str(sp.latex(expression, fold_func_brackets=True))


TITLES = {
    "A": "A: process by state, (C.3)",
    "W": "W: process by noise, (C.6)",
    "H": "H: readings by state, (C.8)",
}
HEAD = r"""# The Jacobians of the Kalman filter

The extended Kalman filter of [the Kalman smoother](kalman-smoother.md) linearizes its model at
every sample. This page has the model and its derivatives. sympy derived all of them:
`python .ci/jacobians.py` writes this page, and `tests/sdk/estimators/kalman/test_jacobians.py`
compares the compiled filter, `floatref.estimators.kalman.forward`, with the same derivatives at
drawn states. Numbers such as (6.47) are those of Karamihas (2021).

States, in this order: height $r$, vertical velocity $v$, pitch $\theta$, roll $\phi$, the biases
$\delta_a$, $\delta_1$, $\delta_2$ of acceleration, roll rate and pitch rate, (C.2). Three states
are beyond the dissertation: the lean $\kappa$ of the accelerometer's axis forward, the drift $d$
of the GNSS height, and the offset $o$ of the height at a stop. Inputs are the specific force
$u_{{ax}}$, $u_{{ay}}$, $u_{{az}}$ and the rates $u_1$, $u_2$, $u_3$ of roll, pitch and yaw. $u_0$
is the longitudinal specific force from which the lean counts, and $l_x$, $l_y$, $l_z$ is the lever
arm of the antenna. Noise has the order $e_a$, $e_1$, $e_2$, $e_3$, $e'_a$, $e'_1$, $e'_2$ of (C.5).

## Process model, (6.47) {{ #process-model }}

Without noise:

{f}

## Readings, (6.48) {{ #measurement-model }}

Height and vertical velocity of the antenna, pitch inclination and roll inclination:

{h}
"""


def main() -> int:
    """Write the page, or say that it is another one."""
    parser = argparse.ArgumentParser(description="Write the page of the Jacobians.")
    parser.add_argument("--check", action="store_true")
    text = page()
    if not parser.parse_args().check:
        PAGE.write_text(text, encoding="utf-8")
        return 0
    if PAGE.read_text(encoding="utf-8") == text:
        return 0
    sys.stdout.write("docs/jacobians.md is out of date; run python .ci/jacobians.py\n")
    return 1


if __name__ == "__main__":
    sys.exit(main())
