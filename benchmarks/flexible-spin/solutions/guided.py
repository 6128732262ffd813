"""A carrier with one mass that slides along a line: its mass matrix, and its solutions."""

from __future__ import annotations

from typing import Any

import numpy as np
from lagrange import Array, Body, about_center, cross


def body(data: dict[str, Any]) -> Body:
    carrier, point = data["carrier"], data["point"]
    masses = np.array([carrier["mass"], point["mass"]])
    place, line = np.array(point["position"]), np.array(point["line"], float)
    line /= np.linalg.norm(line)

    def mass(q: Array) -> Array:
        A = np.zeros((len(q), 2, 3, 4), complex)
        B, J = np.zeros_like(A), np.zeros((len(q), 2, 3, 3), complex)
        A[:, 0, :, :3], B[:, 0, :, :3], J[:, 0] = -cross(np.array(carrier["center_of_mass"])), np.eye(3), carrier["inertia"]
        A[:, 1, :, :3], A[:, 1, :, 3] = -cross(place + q * line), line
        return about_center(masses, A, B, J)

    wheel = data.get("wheel", {"inertia": 0.0, "speed": 0.0, "axis": [0, 0, 1]})
    spin = wheel["inertia"] * wheel["speed"] * np.array(wheel["axis"], float)
    return Body(mass, np.array([point["stiffness"]]), np.array([point["damping"]]), spin)


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    """History from rest on the line, and the modes about the steady spin."""
    guided = body(data)
    start = guided.state(data["start"]["angular_velocity"], [0.0])
    told = guided.history(start, times)
    modes = guided.modes(guided.state(data["steady_spin_near"], [0.0]), start)
    return {
        "omega": told["omega"].tolist(),
        "coordinates": told["coordinates"][:, 0].tolist(),
        "energy": told["energy"].tolist(),
        "frequencies": modes.imag.tolist(),
        "decay_rates": (-modes.real).tolist(),
    }
