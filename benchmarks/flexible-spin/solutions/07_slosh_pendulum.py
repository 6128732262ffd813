"""Lagrange's equations of carrier and pendulum, DOP853, and their derivatives about the steady spin."""

from __future__ import annotations

from typing import Any

import hinged


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    body = hinged.body(data)
    start = body.state(data["start"]["angular_velocity"], data["start"]["angles"])
    told = body.history(start, times)
    modes = body.modes(body.state(data["steady_spin_near"], [0.0, 0.0]), start)
    return {
        **{name: told[name].tolist() for name in ("omega", "coordinates", "energy")},
        "frequencies": modes.imag.tolist(),
        "decay_rates": (-modes.real).tolist(),
    }
