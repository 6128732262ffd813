"""Secular evolution of populations of homogeneous ellipsoids, each with its own shape, material and rotation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid import _arguments, _core
from quasirigid._ensemble import _Rows
from quasirigid._errors import InputError
from quasirigid._progress import Progress, observer
from quasirigid._property import column

__all__ = ["EllipsoidEvolutions", "evolve_ellipsoids"]


class EllipsoidEvolutions(_Rows):
    """Secular evolutions of many ellipsoids; attributes are arrays ``(n,)`` in the order of the rows, NaN in rows that do not hold.

    >>> import quasirigid
    >>> evolutions = quasirigid.evolve_ellipsoids(
    ...     [[170, 130, 100], [100, 100, 200]], density=2000, shear=5e8, quality_factor=100, spin=6e-5, nutation=1.0, until_nutation=0.1,
    ... )
    >>> evolutions.holds.tolist(), evolutions.message[1][:31]
    ([True, False], 'the two greatest moments are eq')
    """

    __slots__ = ("_parts", "_reasons", "holds")

    def __init__(self, parts: dict[str, Any]) -> None:
        self._parts = parts
        self._reasons: dict[int, str] = dict(parts["reasons"])
        self.holds: NDArray[np.bool_] = parts["holds"]
        """Whether each row holds, ``(n,)``."""

    time = column("Times from the start to the end (s).")
    turns = column("Revolutions about the angular momentum.")
    power = column("Mean powers dissipated at the start (W).")
    error = column("Bounds of the relative errors of the times, of the average and of its quadrature.")

    @property
    def status(self) -> list[str]:
        """``finished`` or ``refused``."""
        return ["finished" if holds else "refused" for holds in self.holds.tolist()]

    @property
    def message(self) -> list[str]:
        """Status of each row in a sentence."""
        return [self._reasons.get(row, "the end was reached") for row in range(len(self))]

    def _column(self, name: str) -> NDArray[np.float64]:
        column: NDArray[np.float64] = self._parts[name]
        return column


def evolve_ellipsoids(
    semi_axes: ArrayLike,
    *,
    density: ArrayLike,
    shear: ArrayLike,
    poisson: ArrayLike = 0.25,
    quality_factor: ArrayLike | None = None,
    kelvin_voigt_time: ArrayLike | None = None,
    spin: ArrayLike,
    nutation: ArrayLike | None = None,
    ratio: ArrayLike | None = None,
    until_nutation: ArrayLike | None = None,
    until_ratio: ArrayLike | None = None,
    reproducible: bool = False,
    progress: Progress = False,
) -> EllipsoidEvolutions:
    """Averaged evolution of the tumbling of homogeneous ellipsoids, a row each: eight at a time on every core.

    Every argument is one number for all rows, or one for each. Start and end are given by the nutation or by the ratio.

    Args:
        semi_axes: Semi-axes (m), in any order, ``(n, 3)`` or ``(3,)``.
        density: Density (kg/m³).
        shear: Shear modulus (Pa).
        poisson: Poisson's ratio.
        quality_factor: Quality factor of the material, or
        kelvin_voigt_time: the time η/μ (s) of a Kelvin-Voigt material.
        spin: Angular momentum over the greatest moment of inertia (rad/s), the spin at the end of the tumbling.
        nutation: Greatest angle at the start (rad) between the angular momentum and the axis of greatest inertia, or
        ratio: ``D/I₃`` at the start, which reaches tumbling about the long axis, too.
        until_nutation: Angle at the end, or
        until_ratio: ``D/I₃`` at the end.
        reproducible: The same bits on every processor.

    Raises:
        InputError: for arguments that are missing, given twice, or of shapes that do not fit each other.

    >>> import numpy as np, quasirigid
    >>> evolutions = quasirigid.evolve_ellipsoids(
    ...     [170, 130, 100], density=2000, shear=np.geomspace(1e8, 1e10, 3), quality_factor=100,
    ...     spin=2 * np.pi / 1e5, nutation=1.0, until_nutation=0.1,
    ... )
    >>> bool(evolutions), np.round(evolutions.time[1:] / evolutions.time[:-1], 6).tolist()
    (True, [10.0, 10.0])
    """
    loss = _one(quality_factor=quality_factor, kelvin_voigt_time=kelvin_voigt_time)
    start = _one(nutation=nutation, ratio=ratio)
    end = _one(until_nutation=until_nutation, until_ratio=until_ratio)
    axes = _arguments.vectors(semi_axes, "semi_axes")
    if axes.ndim > 2:
        raise InputError(f"semi_axes has the shape {axes.shape}; give the semi-axes of an ellipsoid a row, (n, 3)")
    given = {"density": density, "shear": shear, "poisson": poisson, "spin": spin, loss[0]: loss[1], start[0]: start[1], end[0]: end[1]}
    columns = {name: _arguments.array(value, name) for name, value in given.items()}
    rows = max([axes.size // 3 if axes.ndim == 2 else 1, *(column.size for column in columns.values() if column.ndim)])
    if axes.ndim == 2 and len(axes) not in (1, rows):
        raise InputError(f"semi_axes has {len(axes)} rows, and another argument has {rows}")

    def column(name: str) -> NDArray[np.float64]:
        values = columns[name]
        if values.ndim > 1 or values.size not in (1, rows):
            raise InputError(f"{name} has the shape {values.shape}; give one number, or {rows}")
        return np.ascontiguousarray(np.broadcast_to(values, rows))

    asked = {
        "semi_axes": np.ascontiguousarray(np.broadcast_to(axes, (rows, 3))),
        **{name: column(name) for name in ("density", "shear", "poisson", "spin")},
        "loss": column(loss[0]),
        "kelvin_voigt": loss[0] == "kelvin_voigt_time",
        "from": column(start[0]),
        "until": column(end[0]),
        "ratios": [start[0] == "ratio", end[0] == "until_ratio"],
    }
    with observer(progress) as watch:
        return EllipsoidEvolutions(_core.evolve_ellipsoids(asked, bool(reproducible), watch))


def _one(**given: ArrayLike | None) -> tuple[str, ArrayLike]:
    """The one of two arguments that is given, with its name."""
    found = [(name, value) for name, value in given.items() if value is not None]
    if len(found) != 1:
        raise InputError(f"give one of {' and '.join(given)}, not {'both' if found else 'neither'}")
    return found[0]
