"""Tables: named columns with units, as NumPy arrays and through Arrow."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quasirigid import _core

__all__ = ["Table", "Tabled"]


class Table(Mapping[str, Any]):
    """A table of named columns of equal length, each with its SI unit.

    A mapping from names to columns: read-only arrays ``(rows,)`` of numbers, without a copy, arrays of truth values (with ``None`` where
    one is missing), or lists of texts.
    pandas, polars, DuckDB and pyarrow read it through the Arrow PyCapsule interface, without pyarrow here:
    ``polars.DataFrame(table)``, ``pandas.DataFrame.from_arrow(table)``, ``pyarrow.table(table)``.

    >>> import quasirigid
    >>> table = quasirigid.Model(quasirigid.EXAMPLE).simulate(duration=60, samples=7).table
    >>> table.rows, table.units["wz"]
    (7, 'rad/s')
    >>> print(table["t"])
    [ 0. 10. 20. 30. 40. 50. 60.]
    """

    __slots__ = ("_columns", "_places")

    def __init__(self, columns: _core.Columns) -> None:
        self._columns = columns
        self._places = {name: place for place, name in enumerate(columns.names)}

    def __getitem__(self, name: str) -> Any:
        try:
            place = self._places[name]
        except KeyError:
            raise KeyError(f"{name!r} is no column; the columns are {', '.join(self._places)}") from None
        values = self._columns.values(place)
        if isinstance(values, list) and any(isinstance(value, bool) for value in values):
            return np.array(values, dtype=object if None in values else np.bool_)
        return values

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return self._columns.rows

    @property
    def units(self) -> dict[str, str]:
        """SI units by column: ``1`` for pure numbers, empty for texts."""
        return dict(zip(self._columns.names, self._columns.units, strict=True))

    def stack(self, *names: str) -> NDArray[np.float64]:
        """Array ``(rows, len(names))`` of some columns of numbers; a copy.

        >>> import quasirigid
        >>> table = quasirigid.Model(quasirigid.EXAMPLE).simulate(duration=60, samples=7).table
        >>> table.stack("wx", "wy", "wz").shape
        (7, 3)
        """
        return np.column_stack([self[name] for name in names])

    def __array__(self, *_: object, **__: object) -> NDArray[Any]:
        """Refuses: numbers and texts make no array. (NumPy and ``pandas.DataFrame(table)`` would take the names for the rows.)"""
        raise TypeError(
            "a table is no array: take columns by name, table.stack('wx', 'wy', 'wz'), polars.DataFrame(table), "
            "or pandas.DataFrame.from_arrow(table)"
        )

    def __arrow_c_schema__(self) -> object:
        """The types of the columns, for libraries that speak Arrow."""
        return self._columns.arrow_schema()

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The rows, for libraries that speak Arrow; another schema than the table's own is not made."""
        return self._columns.arrow_stream()

    def __reduce__(self) -> tuple[object, ...]:
        columns = [self._columns.values(place) for place in range(len(self))]
        values = [np.array(value) if isinstance(value, np.ndarray) else value for value in columns]
        return _table, (self._columns.names, self._columns.units, values)

    def __repr__(self) -> str:
        columns = ", ".join(f"{name} ({unit})" if unit else name for name, unit in self.units.items())
        return f"quasirigid.Table of {self.rows} rows: {columns}"


class Tabled:
    """Answer with a table."""

    __slots__ = ()
    _table: Table | None

    @property
    def table(self) -> Table:
        """The table, with every column; Arrow libraries read it."""
        assert self._table is not None
        return self._table

    @property
    def units(self) -> dict[str, str]:
        """SI units of the columns."""
        return self.table.units

    def _column(self, name: str) -> NDArray[np.float64]:
        column: NDArray[np.float64] = self.table[name]
        return column

    def _stack(self, *names: str) -> NDArray[np.float64]:
        return self.table.stack(*names)

    def __arrow_c_schema__(self) -> object:
        """The types of the columns of the table, for libraries that speak Arrow."""
        return self.table.__arrow_c_schema__()

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The rows of the table, for libraries that speak Arrow."""
        return self.table.__arrow_c_stream__(requested_schema)


def _table(names: list[str], units: list[str], values: list[Any]) -> Table:
    return Table(_core.Columns(names, units, values))
