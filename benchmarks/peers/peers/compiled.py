"""The equations of motion compiled by numba, for programs that take a function."""

import numba as nb
from numpy.typing import NDArray
import numpy as np

from problem import ANCHOR, HUB_INERTIA, REDUCED_MASS

R1, R2, R3 = (float(x) for x in ANCHOR)
J1, J2, J3 = (float(x) for x in HUB_INERTIA)
MU = float(REDUCED_MASS)

Array = NDArray[np.float64]


@nb.njit
def rates(y: Array, out: Array, k: float, c: float) -> None:
    """Writes the rates of `y = (w, q, v)` to `out`."""
    w1, w2, w3, q1, q2, q3, v1, v2, v3 = y
    r1, r2, r3 = R1 + q1, R2 + q2, R3 + q3
    f1, f2, f3 = k * q1 + c * v1, k * q2 + c * v2, k * q3 + c * v3
    a1 = (r2 * f3 - r3 * f2 - (J3 - J2) * w2 * w3) / J1
    a2 = (r3 * f1 - r1 * f3 - (J1 - J3) * w3 * w1) / J2
    a3 = (r1 * f2 - r2 * f1 - (J2 - J1) * w1 * w2) / J3
    # Velocity of the mass relative to the hub, with the rotation of its arm; the
    # Coriolis term takes `v` once more.
    u1 = w2 * r3 - w3 * r2 + 2.0 * v1
    u2 = w3 * r1 - w1 * r3 + 2.0 * v2
    u3 = w1 * r2 - w2 * r1 + 2.0 * v3
    out[0], out[1], out[2] = a1, a2, a3
    out[3], out[4], out[5] = v1, v2, v3
    out[6] = -f1 / MU - (a2 * r3 - a3 * r2) - (w2 * u3 - w3 * u2)
    out[7] = -f2 / MU - (a3 * r1 - a1 * r3) - (w3 * u1 - w1 * u3)
    out[8] = -f3 / MU - (a1 * r2 - a2 * r1) - (w1 * u2 - w2 * u1)
