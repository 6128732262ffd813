"""Ensembles: many starts of one body in one call, a row for each."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from quasirigid import _core
from quasirigid._table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Evolutions", "Histories", "SpinPaths"]

# Reasons that differ in their numbers alone are one.
_NUMBER = re.compile(r"(?<!\w)[-+]?\d+(\.\d+)?([eE][-+]?\d+)?")


class _Rows:
    """Rows of an ensemble. One that does not hold, or failed, has its reason in ``message``."""

    __slots__ = ()

    holds: NDArray[np.bool_]

    @property
    def status(self) -> list[str]:
        """Status of each row: as of a single answer, or ``error``."""
        raise NotImplementedError

    @property
    def message(self) -> list[str]:
        """Status of each row in a sentence."""
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self.holds)

    @property
    def sentence(self) -> str:
        """Number of rows that hold, and the reasons of the others, most frequent first."""
        held = int(self.holds.sum())
        others = [message for message, holds in zip(self.message, self.holds, strict=True) if not holds]
        groups: dict[str, list[str]] = {}
        for text in others:
            groups.setdefault(_NUMBER.sub("#", text), []).append(text)
        largest = sorted(groups.items(), key=lambda group: -len(group[1]))[:5]
        reasons = "".join(
            f"\n  {len(texts)} rows: {texts[0] if len(set(texts)) == 1 else f'{masked} (such as: {texts[0]})'}"
            for masked, texts in largest
        )
        return f"{held} of {len(self)} rows hold{':' if held == len(self) else '; DO NOT HOLD:'}".rstrip(":") + (
            f":{reasons}" if reasons else ""
        )

    def __bool__(self) -> bool:
        return bool(self.holds.all())

    def __repr__(self) -> str:
        return f"{self.sentence}\n(quasirigid.{type(self).__name__})"


class Evolutions(_Rows):
    """Secular evolutions from many starts; attributes are arrays ``(n,)`` in the order of the starts.

    ``time``, ``turns``, ``power``, ``ratio_start``, ``ratio_end`` and ``separatrix_time`` are NaN in rows where no method holds.
    Rows that ended before their target do not hold, and have the numbers up to there.

    >>> import numpy as np, quasirigid
    >>> starts = [[0.1, 1.2, 0.0], [0.2, 1.2, 0.0], [np.nan, 0, 0]]
    >>> evolutions = quasirigid.Model(quasirigid.EXAMPLE).evolve(initial=starts)
    >>> evolutions.holds.tolist(), evolutions.status[2], np.isnan(evolutions.time).tolist()
    ([True, True, False], 'error', [False, False, True])
    """

    __slots__ = ("holds", "table")

    def __init__(self, columns: _core.Columns) -> None:
        self.table = Table(columns)
        """All columns, with units; Arrow libraries read it."""
        self.holds = np.array([status == "finished" for status in self.table["status"]], dtype=np.bool_)
        """Whether each row holds, ``(n,)``."""

    @property
    def status(self) -> list[str]:
        """``finished``, ``refused``, ``does-not-hold``, ``error``, or how the evolution ended before its target."""
        return list(self.table["status"])

    @property
    def message(self) -> list[str]:
        """Status of each row in a sentence."""
        return list(self.table["message"])

    @property
    def initial(self) -> NDArray[np.float64]:
        """Angular velocities at the start (rad/s), body axes, ``(n, 3)``."""
        return self.table.stack("wx", "wy", "wz")

    @property
    def time(self) -> NDArray[np.float64]:
        """Times from the start to the end (s); infinite where the end is never reached."""
        return self._column("time")

    @property
    def turns(self) -> NDArray[np.float64]:
        """Revolutions about the angular momentum."""
        return self._column("turns")

    @property
    def power(self) -> NDArray[np.float64]:
        """Mean powers dissipated at the start (W)."""
        return self._column("power")

    @property
    def ratio_start(self) -> NDArray[np.float64]:
        """``D/I₃`` at the start."""
        return self._column("ratio_start")

    @property
    def ratio_end(self) -> NDArray[np.float64]:
        """``D/I₃`` at the end."""
        return self._column("ratio_end")

    @property
    def separatrix_time(self) -> NDArray[np.float64]:
        """Times from the start to the separatrix (s); NaN where it is not passed."""
        return self._column("separatrix_time")

    @property
    def damping_time(self) -> NDArray[np.float64]:
        """Times in which a small wobble about the axis of greatest inertia decays by e (s)."""
        return self._column("damping_time")

    @property
    def growth_time(self) -> NDArray[np.float64]:
        """Times in which a small wobble about the axis of least inertia grows by e (s)."""
        return self._column("growth_time")

    @property
    def units(self) -> dict[str, str]:
        """SI units of the columns of the table."""
        return self.table.units

    def _column(self, name: str) -> NDArray[np.float64]:
        column: NDArray[np.float64] = self.table[name]
        return column

    def __arrow_c_schema__(self) -> object:
        """The types of the columns of the table, for libraries that speak Arrow."""
        return self.table.__arrow_c_schema__()

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The rows of the table, for libraries that speak Arrow."""
        return self.table.__arrow_c_stream__(requested_schema)

    def plot(self) -> Figure:
        """Histogram of the times (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.evolutions(self)


class Histories(_Rows):
    """Histories of the spin from many starts.

    Arrays have a first axis for the starts, in their order, and a second for the samples; behind the end of a history, and
    in rows that failed, they are NaN.

    >>> import quasirigid
    >>> starts = [[0.1, 1.2, 0.0], [0.2, 1.2, 0.0]]
    >>> histories = quasirigid.Model(quasirigid.EXAMPLE).simulate(initial=starts, duration=60, samples=7)
    >>> histories.angular_velocity.shape, histories.energy.shape
    ((2, 7, 3), (2, 7))
    """

    __slots__ = ("_parts", "_values", "holds")

    def __init__(self, parts: dict[str, Any]) -> None:
        self._parts = parts
        self._values: NDArray[np.float64] = parts["values"]
        self._values.flags.writeable = False
        self.holds: NDArray[np.bool_] = parts["holds"]
        """Whether each row holds, ``(n,)``."""

    @property
    def status(self) -> list[str]:
        """``finished``, ``event``, ``error``, or why the history ended early."""
        return list(self._parts["status"])

    @property
    def message(self) -> list[str]:
        """Status of each row in a sentence."""
        return list(self._parts["message"])

    @property
    def notes(self) -> list[list[str]]:
        """Notes to read before the numbers, for each row."""
        return [list(notes) for notes in self._parts["notes"]]

    @property
    def columns(self) -> list[str]:
        """Names of the columns, as in the table of a single history."""
        return list(self._parts["names"])

    @property
    def units(self) -> dict[str, str]:
        """SI units of the columns."""
        return dict(zip(self._parts["names"], self._parts["units"], strict=True))

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column of every history, ``(n, samples)``: a read-only view."""
        try:
            place = self._parts["names"].index(name)
        except ValueError:
            raise KeyError(name) from None
        return self._values[:, place, :]

    @property
    def t(self) -> NDArray[np.float64]:
        """Times (s), ``(n, samples)``."""
        return self._column("t")

    @property
    def energy(self) -> NDArray[np.float64]:
        """Energies (J), ``(n, samples)``."""
        return self._column("energy")

    @property
    def angular_velocity(self) -> NDArray[np.float64]:
        """Angular velocities (rad/s), body axes, ``(n, samples, 3)``."""
        return self._stack("wx", "wy", "wz")

    @property
    def attitude(self) -> NDArray[np.float64]:
        """Attitudes: unit quaternions, scalar first, ``(n, samples, 4)``."""
        return self._stack("qw", "qx", "qy", "qz")

    def _column(self, name: str) -> NDArray[np.float64]:
        if not self._parts["names"]:
            return np.full((len(self), self._values.shape[2]), np.nan)
        return self[name]

    def _stack(self, *names: str) -> NDArray[np.float64]:
        return np.stack([self._column(name) for name in names], axis=-1)

    def plot(self) -> Figure:
        """Size of the angular velocity and energy against time (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.histories(self)


class SpinPaths(_Rows):
    """Angular velocities along the reduced motion from many starts, without attitude and energy accounts.

    Arrays have a first axis for the starts, in their order, and a second for the times; behind the end of a path, and in rows that
    failed, they are NaN.

    >>> import quasirigid
    >>> starts = [[0.1, 1.2, 0.0], [0.2, 1.2, 0.0]]
    >>> paths = quasirigid.Model(quasirigid.EXAMPLE).spins(starts, [0, 60, 600])
    >>> paths.angular_velocity.shape, paths.holds.tolist()
    ((2, 3, 3), [True, True])
    """

    __slots__ = ("_parts", "angular_velocity", "holds", "t")

    def __init__(self, parts: dict[str, Any], times: list[float]) -> None:
        self._parts = parts
        self.t: NDArray[np.float64] = np.array(times)
        """Output times (s), ``(m,)``."""
        self.angular_velocity: NDArray[np.float64] = parts["values"]
        """Angular velocities (rad/s), body axes, ``(n, m, 3)``; read-only."""
        self.angular_velocity.flags.writeable = False
        self.holds: NDArray[np.bool_] = parts["holds"]
        """Whether each row holds, ``(n,)``."""

    @property
    def status(self) -> list[str]:
        """``finished``, ``error``, or why the path ended early."""
        return list(self._parts["status"])

    @property
    def message(self) -> list[str]:
        """Status of each row in a sentence."""
        return list(self._parts["message"])

    @property
    def notes(self) -> list[list[str]]:
        """Notes to read before the numbers, for each row."""
        return [list(notes) for notes in self._parts["notes"]]
