"""Attitudes against time: of histories and of the attitude files of other programs, for SciPy, xarray, pandas and polars.

An attitude is a unit quaternion of Hamilton's algebra, scalar first, that turns body components into those of the reference axes. The JPL
quaternion from the reference axes to the body has the same four numbers, scalar last; so have those of AEM and STK files. The quaternion of
SPICE's C-matrix is the conjugate, scalar first.
"""

from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from quasirigid import _arguments, _core
from quasirigid._property import column
from quasirigid._table import Table, Tabled

if TYPE_CHECKING:
    import polars
    import xarray

__all__ = ["Attitude", "Attitudes", "read_attitude"]

_QUATERNION = ("qw", "qx", "qy", "qz")
_RATES = ("wx", "wy", "wz")


class Attitudes(Tabled):
    """Table of attitudes, in the columns ``t``, ``qw`` … ``qz`` and ``wx`` … ``wz``."""

    __slots__ = ()

    attitude = column(
        "Attitude: unit quaternion, scalar first, that turns body components into inertial ones, ``(rows, 4)``.",
        *_QUATERNION,
    )
    angular_velocity = column("Angular velocity (rad/s), body axes, ``(rows, 3)``.", *_RATES)

    @property
    def _object(self) -> str:
        raise NotImplementedError

    def to_scipy(self) -> Any:
        """Rotations of SciPy, whose ``apply`` takes body components to those of the reference axes (needs SciPy)."""
        transform = _optional("scipy.spatial.transform", "scipy")
        return transform.Rotation.from_quat(self._stack(*_QUATERNION[1:], "qw"))

    def to_xarray(self) -> xarray.Dataset:
        """Dataset over ``t`` with ``attitude``, ``angular_velocity`` and the other columns, with units (needs xarray)."""
        library = _optional("xarray", "xarray")
        stacked = {"attitude": ("quaternion", _QUATERNION, "1"), "angular_velocity": ("axis", _RATES, "rad/s")}
        stacked = {name: found for name, found in stacked.items() if found[1][0] in self.table}
        alone = [name for name in self.table if name not in ("t", *_QUATERNION, *_RATES)]
        variables: dict[str, Any] = {
            name: (("t", dimension), self._stack(*columns), {"units": unit}) for name, (dimension, columns, unit) in stacked.items()
        }
        variables |= {name: ("t", self._column(name), {"units": self.units[name]}) for name in alone}
        axes = {"quaternion": ["w", "x", "y", "z"], "axis": ["x", "y", "z"]}
        coordinates: dict[str, Any] = {"t": ("t", self._column("t"), {"units": "s"})}
        coordinates |= {dimension: axes[dimension] for dimension, _, _ in stacked.values()}
        dataset: xarray.Dataset = library.Dataset(variables, coordinates, {"object": self._object})
        return dataset

    def to_pandas(self) -> Any:
        """Data frame of the columns, with ``t`` as its index (needs pandas)."""
        return _optional("pandas", "pandas").DataFrame(dict(self.table)).set_index("t")

    def to_polars(self) -> polars.DataFrame:
        """Data frame of the columns (needs polars)."""
        frame: polars.DataFrame = _optional("polars", "polars").DataFrame(dict(self.table))
        return frame

    def write_attitude(
        self,
        path: str | os.PathLike[str],
        format: str | None = None,
        *,
        epoch: str | None = None,
        time_system: str = "utc",
        frame: str = "icrf",
        rates: bool = True,
    ) -> None:
        """Writes an attitude file of another program, over a file of that name.

        Args:
            path: The file; beside data for ``msopck`` stands their setup file, ``path.setup``.
            format: ``aem``, ``aem1`` (version 1.0), ``stk``, ``msopck`` or ``basilisk``; by default that of the ending, ``.aem``, ``.a``,
                ``.msopck`` or ``.npz``.
            epoch: Epoch of time zero, ``2026-01-01T00:00:00``; by default 2000-01-01T12:00:00.
            time_system: Time scale of the epoch: ``utc``, ``tai``, ``tt``, ``tdb`` or ``gps``.
            frame: Inertial axes that the reference axes stand for: ``icrf`` or ``eme2000``.
            rates: Whether angular velocities are written, where there are some.

        Raises:
            InputError: a history that the format cannot say, such as one of UTC across a leap second.
            FileError: if the file cannot be written.
        """
        asked = {"object": self._object, "epoch": epoch, "time_system": time_system, "frame": frame, "rates": rates}
        _core.write_attitude(_arguments.path(path, "path"), format, self.table._columns, asked)


class Attitude(Attitudes):
    """Attitudes against time, as a file has them.

    >>> import tempfile, quasirigid
    >>> history = quasirigid.Model(quasirigid.EXAMPLE).simulate(duration=60, samples=7)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     history.write_attitude(f"{folder}/spin.aem", epoch="2026-01-01T00:00:00")
    ...     read = quasirigid.read_attitude(f"{folder}/spin.aem")
    >>> read
    quasirigid.Attitude of 7 records of 'boom satellite' against ICRF from 2026-01-01T00:00:00.000 UTC
    >>> float(abs(read.attitude - history.attitude).max()) < 1e-15
    True
    """

    __slots__ = ("_table", "epoch", "frame", "object", "time_system")

    def __init__(self, table: Table, told: tuple[str, str, str | None, str | None]) -> None:
        self._table = table
        self.object, self.frame, self.epoch, self.time_system = told

    t = column("Times (s) from the epoch, ``(rows,)``.")
    q = column("The same as ``attitude``.", *_QUATERNION)

    @property
    def omega(self) -> NDArray[np.float64] | None:
        """Angular velocity (rad/s), body axes, ``(rows, 3)``; ``None`` where the file has none."""
        return self.angular_velocity if "wx" in self.table else None

    @property
    def _object(self) -> str:
        return self.object

    def __len__(self) -> int:
        return self.table.rows

    def __repr__(self) -> str:
        of = f" of {self.object!r}" if self.object else ""
        against = f" against {self.frame}" if self.frame else ""
        since = f" from {self.epoch} {self.time_system}" if self.epoch else ""
        return f"quasirigid.Attitude of {len(self)} records{of}{against}{since}"

    def __reduce__(self) -> tuple[object, ...]:
        return Attitude, (self.table, (self.object, self.frame, self.epoch, self.time_system))


def read_attitude(path: str | os.PathLike[str]) -> Attitude:
    """Read an attitude file: an AEM of CCSDS as keywords and values, an attitude file of STK, or a history as CSV or Parquet.

    Raises:
        FileError: with the line and the reason.

    >>> import quasirigid
    >>> quasirigid.read_attitude("no-such-file.aem")
    Traceback (most recent call last):
        ...
    quasirigid.FileError: no-such-file.aem: entity not found; is the name right, and is the file readable?
    """
    columns, told = _core.read_attitude(_arguments.path(path, "path"))
    return Attitude(Table(columns), told)


def _optional(module: str, package: str) -> Any:
    """A library that the package works without."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"this needs {package}, which is not installed: pip install {package}") from error
