"""Computes the reference table of a case in 80-bit arithmetic and compares or writes it.

python reference.py C            # largest difference from the table in data/published
python reference.py C --write    # writes the table
"""

import argparse

import heyoka as hy
import numpy as np
from numpy.typing import NDArray

from peers.heyoka_ import constants, cross, equations
from problem import ANCHOR, CASES, HUB_INERTIA, REDUCED_MASS, REFERENCES, START_SPIN

ROWS = 100
HEADER = "t,w1,w2,w3,Q0,Q1,Q2,Q3,q1,q2,q3,v1,v2,v3,E,Hnorm"

Extended = NDArray[np.longdouble]


def attitude() -> list[tuple[hy.expression, hy.expression]]:
    """Rates of the quaternion from body to inertial axes, scalar part first."""
    w = hy.make_vars("w1", "w2", "w3")
    scalar, *vector = hy.make_vars("Q0", "Q1", "Q2", "Q3")
    turned = cross(vector, w)
    scalar_rate = -0.5 * hy.sum([vector[i] * w[i] for i in range(3)])
    vector_rate = [0.5 * (scalar * w[i] + turned[i]) for i in range(3)]
    return list(zip([scalar, *vector], [scalar_rate, *vector_rate], strict=True))


def trajectory(case: str) -> tuple[Extended, Extended]:
    """Times and states `(w, Q, q, v)`, at the roundoff of the arithmetic."""
    dynamics = equations(case, np.longdouble)
    system = dynamics[:3] + attitude() + dynamics[3:]
    spin = constants(START_SPIN, np.longdouble)
    start = np.array([*spin, 1, 0, 0, 0, *np.zeros(6)], dtype=np.longdouble)
    integrator = hy.taylor_adaptive(system, start, fp_type=np.longdouble)
    times = np.linspace(0, CASES[case].duration, ROWS + 1, dtype=np.longdouble)
    return times, integrator.propagate_grid(times)[-1]


def invariants(case: str, state: Extended) -> Extended:
    """Energy and length of the angular momentum."""
    omega, q, v = state[:3], state[7:10], state[10:]
    r = ANCHOR + q
    velocity = np.cross(omega, r) + v
    momentum = HUB_INERTIA * omega + REDUCED_MASS * np.cross(r, velocity)
    kinetic = omega @ (HUB_INERTIA * omega) + REDUCED_MASS * (velocity @ velocity)
    energy = 0.5 * (kinetic + CASES[case].stiffness * (q @ q))
    return np.array([energy, np.sqrt(momentum @ momentum)])


def table(case: str) -> NDArray[np.float64]:
    """All columns of the reference table, rounded to double precision."""
    times, states = trajectory(case)
    rows = [
        [time, *state, *invariants(case, state)]
        for time, state in zip(times, states, strict=True)
    ]
    return np.array(rows, dtype=np.float64)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--write", action="store_true", help="write the table")
    arguments = parser.parse_args()
    path = REFERENCES / f"{arguments.case}.csv"
    computed = table(arguments.case)
    if arguments.write:
        np.savetxt(path, computed, "%.17g", ",", header=HEADER, comments="")
    else:
        published = np.loadtxt(path, delimiter=",", skiprows=1)
        difference = np.max(np.abs(computed - published), axis=0)
        for name, value in zip(HEADER.split(","), difference, strict=True):
            print(f"{name:6s} {value:.1e}")


if __name__ == "__main__":
    main()
