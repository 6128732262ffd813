"""A carrier with masses on isotropic springs and dashpots, in momenta, which need no mass matrix.

With `p` the momenta of the masses beside the resting centre of mass, `r` their places from the carrier's, in carrier axes,

    omega = J^-1 (H - sum r x p),   dr/dt = p/m + sum(p)/m_c - omega x r,   dp/dt = F - omega x p,   dH/dt = -omega x H.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


def cross(a: Array, b: Array) -> Array:
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def history(data: dict[str, Any], times: list[float], tolerance: float = 1e-12) -> dict[str, Array]:
    """Angular velocity (rad/s), displacements (m), energy and its loss (J) at the times (s), the parts at rest in the carrier at first."""
    carrier, points = data["carrier"], data["points"]
    inverse, weight = np.linalg.inv(carrier["inertia"]), carrier["mass"]
    m, k, c = (np.array([point[key] for point in points]) for key in ("mass", "stiffness", "damping"))
    home = np.array([point["position"] for point in points]).T - np.array(carrier["center_of_mass"])[:, None]
    n = len(points)

    def split(state: Array) -> tuple[Array, Array, Array, Array, Array]:
        total, r, p = state[:3], state[3 : 3 + 3 * n].reshape(3, n), state[3 + 3 * n : 3 + 6 * n].reshape(3, n)
        omega = inverse @ (total - cross(r, p).sum(axis=1))
        speed = p / m + p.sum(axis=1)[:, None] / weight - cross(omega, r)
        return total, r, p, omega, speed

    def rates(_: float, state: Array) -> Array:
        total, r, p, omega, speed = split(state)
        force = -k * (r - home) - c * speed
        loss = (c * speed**2).sum()
        return np.concatenate([-cross(omega, total), speed.ravel(), (force - cross(omega, p)).ravel(), [loss]])

    omega = np.array(data["start"]["angular_velocity"])
    velocity = cross(omega, home)
    p = m * (velocity - (m * velocity).sum(axis=1)[:, None] / (weight + m.sum()))
    total = np.array(carrier["inertia"]) @ omega + cross(home, p).sum(axis=1)
    start = np.concatenate([total, home.ravel(), p.ravel(), [0.0]])
    done = solve_ivp(rates, (0, times[-1]), start, "DOP853", times, rtol=tolerance, atol=1e-15)
    assert done.success, done.message
    told: dict[str, list[Any]] = {"omega": [], "displacements": [], "energy": [], "loss": []}
    for state in done.y.T:
        _, r, p, omega, speed = split(state)
        shared = p.sum(axis=1)
        kinetic = 0.5 * omega @ carrier["inertia"] @ omega + 0.5 * (p**2 / m).sum() + 0.5 * shared @ shared / weight
        told["omega"].append(omega)
        told["displacements"].append((r - home).T.ravel())
        told["energy"].append(kinetic + 0.5 * (k * (r - home) ** 2).sum())
        told["loss"].append(state[-1])
    return {name: np.array(rows) for name, rows in told.items()}
