"""SciPy: Euler's equations and the quaternion, by `solve_ivp`; a step is `rtol`, with `atol` a thousandth of it as by default."""

from __future__ import annotations

import numpy as np
import scipy
from scipy.integrate import solve_ivp

from bodies import Body, Rows
from simulators import Method
from simulators.plain import cross, product

TITLE = "SciPy"
STEPS = (1e-3, 1e-6)
WHY = {
    "RK45": "A tolerance bounds the error of a step; its part along the invariants adds up.",
    "DOP853": "The same at higher order, with longer steps.",
    "Radau": "L-stable: it takes from every oscillation, within the tolerance.",
    "LSODA": "Multistep: its order and step change, and so does the sign of what it invents.",
}
METHODS = tuple(
    Method(name, STEPS, (1e-9,), "default", why, default=name == "RK45", tolerance=True) for name, why in WHY.items()
)


def version() -> str:
    return scipy.__version__


def history(method: Method, body: Body, step: float) -> Rows:
    moments = np.array(body.moments)

    def rate(_: float, y: Rows) -> Rows:
        w, q = y[:3], y[3:]
        return np.array([*cross(moments * w, w) / moments, *product(q, np.array([0.0, *w])) / 2])

    times = body.times()
    start = [*body.rates, 1.0, 0.0, 0.0, 0.0]
    found = solve_ivp(rate, (0.0, times[-1]), start, method.name, times, rtol=step, atol=1e-3 * step)
    q = found.y[3:] / np.sqrt((found.y[3:] ** 2).sum(axis=0))
    return np.column_stack([found.t, found.y[:3].T, q.T])
