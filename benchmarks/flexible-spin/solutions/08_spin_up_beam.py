"""A beam of Simo and Reissner in its plane, in inertial axes: linear elements, one point of quadrature, Radau.

Strains of an element with the mean rotation a: `x' cos a + y' sin a - 1`, `y' cos a - x' sin a`, `a'`; masses at the nodes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.sparse import bmat, csr_matrix

Array = NDArray[np.float64]
ELEMENTS = 40


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    beam, end = data["beam"], data["start"]["spin_up_time"]
    n, h, final = ELEMENTS, beam["length"] / ELEMENTS, data["start"]["final_rate"]
    pull, shear, bend = beam["EA"], beam["GA"], beam["EI"]
    share = np.append(np.ones(n - 1), 0.5) * h
    weight = np.concatenate([beam["mass_per_length"] * share] * 2 + [beam["rotary_inertia_per_length"] * share])

    def turned(t: float) -> float:
        wave = end / (2 * np.pi)
        return float(final / end * (0.5 * t**2 + wave**2 * (np.cos(t / wave) - 1)))

    def forces(t: float, q: Array) -> Array:
        x, y, a = (np.concatenate([[root], part]) for root, part in zip((0.0, 0.0, turned(t)), q.reshape(3, n), strict=True))
        dx, dy, da, mean = np.diff(x) / h, np.diff(y) / h, np.diff(a) / h, 0.5 * (a[1:] + a[:-1])
        c, s = np.cos(mean), np.sin(mean)
        along, across = dx * c + dy * s - 1, dy * c - dx * s
        N, V = pull * along, shear * across
        fx, fy, moment = N * c - V * s, N * s + V * c, bend * da
        couple = 0.5 * h * (N * across - V * (along + 1))

        def at_nodes(stress: Array) -> Array:
            return np.append(np.diff(stress), -stress[-1])

        ends = couple + np.append(couple[1:], 0.0)
        return np.concatenate([at_nodes(fx), at_nodes(fy), at_nodes(moment) - ends])

    def rates(t: float, state: Array) -> Array:
        q, v = state[: 3 * n], state[3 * n :]
        return np.concatenate([v, forces(t, q) / weight])

    near = np.kron(np.ones((3, 3)), np.tri(n, n, 1) - np.tri(n, n, -2))
    pattern = bmat([[None, csr_matrix(np.eye(3 * n))], [csr_matrix(near), None]])
    place = np.arange(1, n + 1) * h
    start = np.concatenate([place, np.zeros(5 * n)])
    done = solve_ivp(rates, (0, times[-1]), start, "Radau", times, rtol=1e-6, atol=1e-8, jac_sparsity=pattern)
    assert done.success, done.message
    x, y, a = done.y[n - 1], done.y[2 * n - 1], np.array([turned(t) for t in times])
    along = x * np.cos(a) + y * np.sin(a) - beam["length"]
    return {
        "stretch": along[-1:].tolist(),
        "tip_along": along.tolist(),
        "tip_across": (y * np.cos(a) - x * np.sin(a)).tolist(),
    }
