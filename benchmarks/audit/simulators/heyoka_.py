"""heyoka: Taylor's method on Euler's equations and the quaternion; a step is its tolerance."""

from __future__ import annotations

import heyoka as hy
import numpy as np

from bodies import Body, Rows
from simulators import Method

TITLE = "heyoka"
DEFAULT = 2.0**-52
METHODS = (
    Method("Taylor", (DEFAULT, 1e-12), (1e-9, 1e-6), "default", "The series is cut at the rounding, by default.", default=True, tolerance=True),
)


def version() -> str:
    return hy.__version__


def history(method: Method, body: Body, step: float) -> Rows:
    w = hy.make_vars("x", "y", "z")
    a, b, c, d = hy.make_vars("a", "b", "c", "d")
    x, y, z = w
    jx, jy, jz = body.moments
    system = [
        (x, (jy - jz) / jx * y * z),
        (y, (jz - jx) / jy * z * x),
        (z, (jx - jy) / jz * x * y),
        (a, 0.5 * (-b * x - c * y - d * z)),
        (b, 0.5 * (a * x + c * z - d * y)),
        (c, 0.5 * (a * y - b * z + d * x)),
        (d, 0.5 * (a * z + b * y - c * x)),
    ]
    integrator = hy.taylor_adaptive(system, [*body.rates, 1.0, 0.0, 0.0, 0.0], tol=step)
    times = body.times()
    state = integrator.propagate_grid(times)[-1]
    q = state[:, 3:] / np.linalg.norm(state[:, 3:], axis=1)[:, None]
    return np.column_stack([times, state[:, :3], q])
