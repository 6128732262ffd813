"""A carrier with a sphere inside, by the angular momenta of the whole and of the sphere, in carrier axes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    locked, sphere = np.array(data["carrier"]["moments"]), data["sphere"]["inertia"]
    friction, omega = data["sphere"]["friction"], np.array(data["start"]["angular_velocity"])

    def split(state: Array) -> tuple[Array, Array, Array, Array]:
        whole, inner = state[:3], state[3:]
        turn = (whole - inner) / (locked - sphere)
        return whole, inner, turn, inner / sphere - turn

    def rates(_: float, state: Array) -> Array:
        (a, b, c), (d, e, f), (x, y, z), slip = split(state)
        u, v, w = friction * slip
        return np.array([b * z - c * y, c * x - a * z, a * y - b * x, e * z - f * y - u, f * x - d * z - v, d * y - e * x - w])

    def energy(state: Array) -> float:
        _, inner, turn, _ = split(state)
        return float(0.5 * (turn * (locked - sphere)) @ turn + 0.5 * inner @ inner / sphere)

    start = np.concatenate([locked * omega, sphere * omega])
    bound = float((locked * omega) @ (locked * omega) / (2 * locked[1]))

    def crossing(_: float, state: Array) -> float:
        return energy(state) - bound

    crossing.terminal = True  # type: ignore[attr-defined]
    done = solve_ivp(rates, (0, 1e5), start, "DOP853", times, events=crossing, rtol=1e-12, atol=1e-13)
    assert done.success and done.y.shape[1] == len(times)
    states = done.y.T
    return {
        "omega": [split(state)[2].tolist() for state in states],
        "energy": [energy(state) for state in states],
        "crossing_time": [float(done.t_events[0][0])],
    }
