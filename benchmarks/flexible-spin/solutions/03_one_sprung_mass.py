"""In the momenta of carrier and mass, DOP853."""

from __future__ import annotations

from typing import Any

import sprung


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    told = sprung.history(data, times)
    return {name: told[name].tolist() for name in ("omega", "displacements", "loss")}
