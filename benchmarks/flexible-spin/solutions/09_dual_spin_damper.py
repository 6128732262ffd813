"""Lagrange's equations of carrier and guided mass, DOP853, and their derivatives about the steady spin."""

from __future__ import annotations

from typing import Any

import guided


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    body = guided.body(data)
    start = body.state(data["start"]["angular_velocity"], [0.0])
    told = body.history(start, times)
    modes = body.modes(body.state(data["steady_spin_near"], [0.0]), start)
    return {
        "omega": told["omega"].tolist(),
        "coordinates": told["coordinates"][:, 0].tolist(),
        "energy": told["energy"].tolist(),
        "frequencies": modes.imag.tolist(),
        "decay_rates": (-modes.real).tolist(),
    }
