"""Lagrange's equations of carrier and panel, DOP853."""

from __future__ import annotations

from typing import Any

import hinged


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    body = hinged.body(data)
    told = body.history(body.state(data["start"]["angular_velocity"], data["start"]["angles"]), times)
    return {name: told[name].tolist() for name in ("omega", "coordinates", "energy")}
