"""Ensembles: many starts of one body in one call, a row for each."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from quasirigid import _core
from quasirigid._property import column, part, texts
from quasirigid._table import Table, Tabled

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


class _Noted(_Rows):
    """Rows whose status, message and notes are parts of the answer."""

    __slots__ = ("_parts", "holds")

    def __init__(self, parts: dict[str, Any]) -> None:
        self._parts = parts
        self.holds: NDArray[np.bool_] = parts["holds"]
        """Whether each row holds, ``(n,)``."""

    message = part(list[str], "Status of each row in a sentence.")

    @property
    def notes(self) -> list[list[str]]:
        """Notes to read before the numbers, for each row."""
        return [list(notes) for notes in self._parts["notes"]]


class Evolutions(_Rows, Tabled):
    """Secular evolutions from many starts; attributes are arrays ``(n,)`` in the order of the starts.

    ``time``, ``turns``, ``power``, ``ratio_start``, ``ratio_end`` and ``separatrix_time`` are NaN in rows where no method holds.
    Rows that ended before their target do not hold, and have the numbers up to there.

    >>> import numpy as np, quasirigid
    >>> starts = [[0.1, 1.2, 0.0], [0.2, 1.2, 0.0], [np.nan, 0, 0]]
    >>> evolutions = quasirigid.Model(quasirigid.EXAMPLE).evolve(initial=starts)
    >>> evolutions.holds.tolist(), evolutions.status[2], np.isnan(evolutions.time).tolist()
    ([True, True, False], 'error', [False, False, True])
    """

    __slots__ = ("_table", "holds")

    def __init__(self, columns: _core.Columns) -> None:
        self._table = Table(columns)
        self.holds = np.array([status == "finished" for status in self.table["status"]], dtype=np.bool_)
        """Whether each row holds, ``(n,)``."""

    status = texts("``finished``, ``refused``, ``does-not-hold``, ``error``, or how the evolution ended before its target.")
    message = texts("Status of each row in a sentence.")
    initial = column("Angular velocities at the start (rad/s), body axes, ``(n, 3)``.", "wx", "wy", "wz")
    time = column("Times from the start to the end (s); infinite where the end is never reached.")
    turns = column("Revolutions about the angular momentum.")
    power = column("Mean powers dissipated at the start (W).")
    ratio_start = column("``D/I₃`` at the start.")
    ratio_end = column("``D/I₃`` at the end.")
    separatrix_time = column("Times from the start to the separatrix (s); NaN where it is not passed.")
    damping_time = column("Times in which a small nutation about the axis of greatest inertia decays by e (s).")
    growth_time = column("Times in which a small nutation about the axis of least inertia grows by e (s).")

    def plot(self) -> Figure:
        """Histogram of the times (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.evolutions(self)


class Histories(_Noted):
    """Histories of the spin from many starts.

    Arrays have a first axis for the starts, in their order, and a second for the samples; behind the end of a history, and
    in rows that failed, they are NaN.

    >>> import quasirigid
    >>> starts = [[0.1, 1.2, 0.0], [0.2, 1.2, 0.0]]
    >>> histories = quasirigid.Model(quasirigid.EXAMPLE).simulate(initial=starts, duration=60, samples=7)
    >>> histories.angular_velocity.shape, histories.energy.shape
    ((2, 7, 3), (2, 7))
    """

    __slots__ = ("_values",)

    def __init__(self, parts: dict[str, Any]) -> None:
        super().__init__(parts)
        self._values: NDArray[np.float64] = parts["values"]
        self._values.flags.writeable = False

    status = part(list[str], "``finished``, ``event``, ``error``, or why the history ended early.")

    columns = part(list[str], "Names of the columns, as in the table of a single history.", "names")

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

    t = column("Times (s), ``(n, samples)``.")
    energy = column("Energies (J), ``(n, samples)``.")
    angular_velocity = column("Angular velocities (rad/s), body axes, ``(n, samples, 3)``.", "wx", "wy", "wz")
    attitude = column("Attitudes: unit quaternions, scalar first, ``(n, samples, 4)``.", "qw", "qx", "qy", "qz")

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


class SpinPaths(_Noted):
    """Angular velocities along the reduced motion from many starts, without attitude and energy accounts.

    Arrays have a first axis for the starts, in their order, and a second for the times; behind the end of a path, and in rows that
    failed, they are NaN.

    >>> import quasirigid
    >>> starts = [[0.1, 1.2, 0.0], [0.2, 1.2, 0.0]]
    >>> paths = quasirigid.Model(quasirigid.EXAMPLE).spins(starts, [0, 60, 600])
    >>> paths.angular_velocity.shape, paths.holds.tolist()
    ((2, 3, 3), [True, True])
    """

    __slots__ = ("angular_velocity", "t")

    def __init__(self, parts: dict[str, Any], times: list[float]) -> None:
        super().__init__(parts)
        self.t: NDArray[np.float64] = np.array(times)
        """Output times (s), ``(m,)``."""
        self.angular_velocity: NDArray[np.float64] = parts["values"]
        """Angular velocities (rad/s), body axes, ``(n, m, 3)``; read-only."""
        self.angular_velocity.flags.writeable = False

    status = part(list[str], "``finished``, ``error``, or why the path ended early.")
