"""The common problem: a free rigid hub carrying one sprung point mass.

The mass sits at `r = ANCHOR + q` in body axes, counted from the hub's own centre of
mass. The hub pulls it with `-(k q + c v)`, where `v` is the rate of `q` seen in body
axes, and feels the opposite force at the mass itself. Angular momentum is therefore
conserved exactly, and a steady spin loses no energy. With `mu = M m / (M + m)` and
`f = k q + c v`:

    w' = J^-1 (r x f - w x J w)
    v' = -f / mu - w' x r - 2 w x v - w x (w x r)

Units are kg, m, s, rad.
"""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

REFERENCES = Path(__file__).parents[2] / "data" / "published" / "common_problem"

HUB_MASS = 100.0
HUB_INERTIA = np.array([10.0, 14.0, 17.0])
POINT_MASS = 1.0
ANCHOR = np.array([0.8, 0.3, 0.5])
START_SPIN = np.array([0.3, 1.5, 0.2])

REDUCED_MASS = HUB_MASS * POINT_MASS / (HUB_MASS + POINT_MASS)


@dataclass(frozen=True)
class Case:
    """One stiffness, one dashpot, one length of time; `q` and `v` start at zero."""

    stiffness: float
    damping: float
    duration: float


CASES = {
    "A": Case(1e4, 20.0, 200.0),
    "B": Case(1e6, 200.0, 200.0),
    "C": Case(1e8, 2000.0, 200.0),
    "over": Case(1e6, 2e4, 200.0),
    "soft": Case(400.0, 4.0, 2000.0),
    "long": Case(1e4, 20.0, 20000.0),
}


def hub_start() -> tuple[Vector, Vector]:
    """Place and velocity of the hub when the common centre of mass rests at the origin."""
    share = POINT_MASS / (HUB_MASS + POINT_MASS)
    return -share * ANCHOR, -share * np.cross(START_SPIN, ANCHOR)


def momentum(omega: Vector, q: Vector, v: Vector) -> Vector:
    """Angular momentum about the common centre of mass, in body axes."""
    r = ANCHOR + q
    return HUB_INERTIA * omega + REDUCED_MASS * np.cross(r, np.cross(omega, r) + v)


def momentum_drift(omega: Vector, q: Vector, v: Vector) -> float:
    """Relative change of the length of the angular momentum since the start."""
    rest = np.zeros(3)
    before = np.linalg.norm(momentum(START_SPIN, rest, rest))
    return float(abs(np.linalg.norm(momentum(omega, q, v)) / before - 1.0))


@cache
def reference_spin(case: str) -> Vector:
    """Spin at the end of a case, from its table in `data/published/common_problem`."""
    table = np.loadtxt(REFERENCES / f"{case}.csv", delimiter=",", skiprows=1)
    if table[-1, 0] != CASES[case].duration:
        raise ValueError(f"{case}.csv ends at {table[-1, 0]:g} s")
    return table[-1, 1:4]


def spin_error(case: str, omega: Vector) -> float:
    """Largest component of the error in the spin at the end, in rad/s."""
    return float(np.max(np.abs(np.asarray(omega) - reference_spin(case))))
