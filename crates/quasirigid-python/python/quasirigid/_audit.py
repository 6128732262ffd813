"""Audits of histories that other programs wrote: does a simulator invent damping?"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from quasirigid import _arguments, _core
from quasirigid._answers import Answer, _copies, _copy
from quasirigid._errors import InputError
from quasirigid._model import Model
from quasirigid._property import entry

__all__ = ["Audit", "audit"]


def _optional(value: Any) -> float | None:
    return None if value is None else float(value)


class Audit(Answer):
    """Audit of a history: drifts of the invariants, and the time constant that the integrator invents.

    >>> import pathlib, tempfile, quasirigid
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder, "spin.csv")
    ...     rows = "".join(f"{0.1 * k:.1f},0,0,1\\n" for k in range(100))
    ...     _ = file.write_text("t,wx,wy,wz\\n" + rows)
    ...     found = quasirigid.audit(file, inertia=[10, 14, 17])
    >>> found.energy_drift, found.invented_time_constant
    (0.0, None)
    """

    __slots__ = ()

    momentum_drift = entry(float, "Change of the angular momentum from the first row to the last, relative.")
    energy_drift = entry(float, "Change of the energy from the first row to the last, relative.")
    invented_time_constant = entry(
        _optional, "Time constant (s) of the small wobble that the body does not have, negative where it grows; ``None`` where none is above the digits."
    )
    seen_time_constant = entry(_optional, "Time constant (s) of the small wobble in the history.")
    model_time_constant = entry(_optional, "That of the model (s).")
    explained = entry(_optional, "Share of the seen rate that the model explains.")
    within_limits = entry(lambda value: None if value is None else bool(value), "Whether the limits are kept; ``None`` without any.")
    dissipation = entry(_copies, "Intervals with ``interval`` (s), ``wobble`` (rad), ``relative_power`` (1/s) and ``time_constant`` (s).")
    units = entry(_copy, "Units of the file, and where they were found.")
    badge = entry(_copy, "Badge in the form of an endpoint of shields.io.")

    @property
    def worst_interval(self) -> tuple[float, float] | None:
        """Interval (s) in which energy or angular momentum changed fastest."""
        found = self._parts["json"]["worst_interval"]
        return None if found is None else (float(found[0]), float(found[1]))


def audit(
    files: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    model: Model | None = None,
    *,
    inertia: ArrayLike | None = None,
    limit: float | None = None,
    min_time_constant: float | str | None = None,
    steps: Iterable[float] = (),
) -> Audit:
    """Audit a history of a free body that another program wrote.

    Args:
        files: The history: a table ``t, wx, wy, wz``, perhaps with a quaternion, as CSV, Parquet, NPZ, AEM or STK; or several of one run at
            different steps, which show the order of the integrator.
        model: Model of the body, whose own dissipation is told apart.
        inertia: In its place three moments, six entries ``XX, YY, ZZ, XY, XZ, YZ`` of the tensor, or the matrix ``(3, 3)`` (kg·m²), in the axes
            of the rates; an entry ``XY`` is ``−∫ x y dm``.
        limit: Largest relative change of energy and angular momentum.
        min_time_constant: Least invented time constant, in s or with a unit, ``"1 yr"``.
        steps: Step (s) of each of several histories, by default the time between rows.

    Raises:
        FileError: for a file that is not read.
        InputError: for an inertia that no body has, and a history that no units make one of this body.

    >>> import quasirigid
    >>> quasirigid.audit("no-such-file.csv", inertia=[10, 14, 17])
    Traceback (most recent call last):
        ...
    quasirigid.FileError: no-such-file.csv: entity not found; is the name right, and is the file readable?
    """
    single = isinstance(files, (str, bytes, os.PathLike))
    listed = [files] if single else list(files)  # type: ignore[arg-type]
    if model is not None and not isinstance(model, Model):
        raise InputError(f"model is a {type(model).__name__}; give a Model, or inertia")
    asked = {
        "inertia": None if inertia is None else _entries(inertia),
        "limit": _positive(_arguments.number(limit, "limit"), "limit"),
        "min_time_constant": _positive(_arguments.quantity(min_time_constant, "min_time_constant"), "min_time_constant"),
        "steps": [_positive(_arguments.number(step, "steps"), "steps") for step in steps],
    }
    paths = [_arguments.path(file, "files") for file in listed]  # type: ignore[arg-type]
    return Audit(_core.audit_histories(paths, None if model is None else model._core, asked))


def _positive(value: Any, name: str) -> Any:
    if isinstance(value, float) and not 0 < value < float("inf"):
        raise InputError(f"{name} = {value} is not a positive number")
    return value


def _entries(inertia: ArrayLike) -> list[float]:
    """Three moments or six entries of a tensor."""
    try:
        found = np.asarray(inertia, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"inertia = {inertia!r}: give three moments, six entries or a matrix of numbers") from error
    if found.shape != (3, 3):
        return [float(entry) for entry in found.ravel()]
    if not np.allclose(found, found.T, rtol=0, atol=1e-12 * float(abs(found).max())):
        raise InputError("inertia is not symmetric")
    return [float(found[place]) for place in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]]
