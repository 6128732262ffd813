"""Settings of a simulation, as the compiled part takes them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from quasirigid import _arguments
from quasirigid._errors import InputError

__all__: list[str] = []


def run(
    duration: float | str | None,
    samples: int | None,
    tolerance: float | None,
    form: str | None = None,
    integrator: str | None = None,
    times: ArrayLike | None = None,
) -> dict[str, Any]:
    """Settings of histories."""
    if times is not None and (duration is not None or samples is not None):
        raise InputError("times replace duration and samples; give one or the others")
    return {
        "duration": _arguments.duration(duration),
        "samples": _arguments.count(samples, "samples"),
        "tolerance": _arguments.number(tolerance, "tolerance"),
        "form": _arguments.word(form, "form"),
        "integrator": _arguments.word(integrator, "integrator"),
    }


def spin_manifold(degree: int | None, masters: str | Sequence[float] | None, style: str | None) -> dict[str, Any]:
    """Settings of the reduced equations about the spin."""
    return {
        "degree": _arguments.count(degree, "degree"),
        "masters": masters if masters is None or isinstance(masters, str) else [float(each) for each in masters],
        "style": _arguments.word(style, "style"),
    }


def table(
    system: str | None, about: dict[str, Any], coordinates: bool, displacements: bool, times: ArrayLike | None
) -> dict[str, Any]:
    """Contents of the table of a history."""
    return {
        "system": _arguments.word(system, "system"),
        "spin_manifold": about,
        "coordinates": bool(coordinates),
        "displacements": bool(displacements),
        "times": _arguments.times(times),
    }
