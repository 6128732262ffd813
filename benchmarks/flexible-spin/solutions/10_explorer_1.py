"""Lagrange's equations of the tube and four whips at any angle, DOP853."""

from __future__ import annotations

from typing import Any

import hinged
import numpy as np


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    body = hinged.body(data)
    told = body.history(body.state(data["start"]["angular_velocity"], [0.0] * 8), times, 1e-11)
    omega = told["omega"]
    return {
        "axial_rate": omega[:, 2].tolist(),
        "transverse_rate": np.hypot(omega[:, 0], omega[:, 1]).tolist(),
        "energy": told["energy"].tolist(),
    }
