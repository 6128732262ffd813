"""Populations: one question of many bodies whose values stand in arrays, with their uncertainty."""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid._errors import InputError
from quasirigid._model import Model
from quasirigid._progress import Progress
from quasirigid._sweep import Sweep, sweep

if TYPE_CHECKING:
    import xarray

__all__ = ["Population", "evolve_population"]


class Population:
    """Answers of a population: arrays ``(n,)``, or ``(n, samples)`` of values that are drawn.

    ``population[name]`` is a quantity, or a value by its key; NaN where a row has none, infinite where a time never ends.

    >>> import quasirigid
    >>> model = quasirigid.Model.from_file("examples/apophis/model.toml")
    >>> slow, quick = quasirigid.evolve_population(model, {"material.rock.rheology.Q": [1000.0, 100.0]}).time
    >>> round(slow / quick)
    10
    """

    __slots__ = ("_columns", "_rows", "_samples", "_sizes", "quantities")

    def __init__(self, rows: Sweep, bodies: int, samples: int, columns: Mapping[str, str], quantities: Sequence[str]) -> None:
        self._rows, self._samples, self._columns = rows, samples, dict(columns)
        self._sizes = (bodies,) if samples == 1 else (bodies, samples)
        self.quantities = tuple(quantities)
        """Names of the quantities."""

    def __getitem__(self, name: str) -> NDArray[Any]:
        column: NDArray[Any] = self._rows[self._columns.get(name, name)]
        return column.reshape(self._sizes)

    def __len__(self) -> int:
        return self._sizes[0]

    def __bool__(self) -> bool:
        return bool(self.holds.all())

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the evolution (s)."""
        return self["evolve.time"]

    @property
    def holds(self) -> NDArray[np.bool_]:
        """Whether each row is answered."""
        return self._rows.answered.reshape(self._sizes)

    @property
    def reasons(self) -> list[dict[str, Any]]:
        """Reasons of the rows that are not answered, the most frequent first: ``count``, ``reason``, ``example``, ``first_row``."""
        reasons: list[dict[str, Any]] = self._rows.summary["reasons"]
        return reasons

    @property
    def notes(self) -> list[str]:
        """What was made of the values, where that is not plain."""
        notes: list[str] = self._rows.summary["notes"]
        return notes

    @property
    def rows(self) -> Sweep:
        """The rows as a study."""
        return self._rows

    def percentiles(self, name: str, percents: Sequence[float] = (16.0, 50.0, 84.0)) -> NDArray[np.float64]:
        """Percentiles of each body over its draws, ``(n, len(percents))``: values that were drawn, so that times may be infinite."""
        drawn = np.asarray(self[name], dtype=np.float64).reshape(len(self), self._samples)
        found = np.full((len(self), len(percents)), np.nan)
        for row, values in enumerate(drawn):
            known = values[~np.isnan(values)]
            if known.size:
                found[row] = np.percentile(known, percents, method="inverted_cdf")
        return found

    def to_xarray(self) -> xarray.Dataset:
        """The answers as a dataset with the dimensions ``body`` and ``sample`` (needs xarray)."""
        import xarray

        dimensions = ("body", "sample")[: len(self._sizes)]
        units = self._rows.table.units

        def variable(name: str) -> tuple[tuple[str, ...], NDArray[Any], dict[str, str]]:
            unit = units.get(self._columns.get(name, name), "")
            return dimensions, self[name], {"units": unit} if unit else {}

        data = {name: variable(name) for name in self.quantities} | {"holds": (dimensions, self.holds, {})}
        return xarray.Dataset(data, coords={name: variable(name) for name in self._columns})

    def __repr__(self) -> str:
        answered = int(self.holds.sum())
        text = f"quasirigid.Population of {len(self)} bodies: {answered} of {self.holds.size} rows answered"
        lines = [f"  {reason['count']} rows: {reason['reason']}" for reason in self.reasons]
        return "\n".join([text, *lines])


def evolve_population(
    model: Model,
    values: Mapping[str, ArrayLike],
    *,
    units: Mapping[str, str] | None = None,
    sigma: Mapping[str, ArrayLike] | None = None,
    samples: int = 1,
    seed: int = 0,
    quantities: Sequence[str] = ("evolve.time", "evolve.turns"),
    threads: int | None = None,
    client: Any = None,
    progress: Progress = False,
) -> Population:
    """Secular evolution, or other quantities, of many bodies: a model, and arrays of the values of its keys.

    The model may have any shape, rheology and start, such as observed periods. A value that is NaN loses its row, with a reason.

    Args:
        model: model of all bodies.
        values: numbers or texts ``(n,)`` by the paths of their keys, or one for all.
        units: units of the numbers, by key; SI by default.
        sigma: standard deviations, by key; each row then draws ``samples`` values, a positive one above zero.
        samples: draws of each body, of a Latin hypercube.
        seed: of the draws.
        quantities: paths into the answers of commands, as in a study.
        threads: number of threads; all cores by default.
        client: cluster that answers the rows, as of ``sweep``; its workers must see the temporary files of this machine.
        progress: ``True`` for a bar, or a function that ends the work by ``False``.

    Raises:
        InputError: arrays that do not fit each other, and keys of ``sigma`` and ``units`` without values.
        ModelError: a key or a unit that the model does not have.

    >>> import numpy as np, quasirigid
    >>> model = quasirigid.Model.from_file("examples/apophis/model.toml")
    >>> found = quasirigid.evolve_population(
    ...     model, {"initial.periods.rotation": [263.0, 270.0]}, units={"initial.periods.rotation": "h"},
    ...     sigma={"initial.periods.rotation": 6.0}, samples=5,
    ... )
    >>> found.time.shape, found.percentiles("evolve.time").shape
    ((2, 5), (2, 3))
    """
    units, sigma = dict(units or {}), dict(sigma or {})
    if not values:
        raise InputError("values has no keys; give arrays by the paths of keys, such as {'ellipsoid.1.diameter': [...]}")
    for name, given in (("units", units), ("sigma", sigma)):
        for key in given:
            if key not in values:
                raise InputError(f"{name} has the key {key!r}, and values has not")
    columns = {f"v{i}": np.asarray(values[key]) for i, key in enumerate(values)}
    columns |= {f"s{i}": np.asarray(sigma[key]) for i, key in enumerate(values) if key in sigma}
    count = max(column.size for column in columns.values())
    for (name, column), key in zip(columns.items(), [*values, *(key for key in values if key in sigma)], strict=True):
        if column.ndim > 1 or column.size not in (1, count):
            what = f"sigma of {key}" if name.startswith("s") else key
            raise InputError(f"{what} has the shape {column.shape}; give one value, or {count}")

    def source(i: int, key: str) -> dict[str, str]:
        told = {"name": f"v{i}"}
        if key in units:
            told["unit"] = units[key]
        if key in sigma:
            told["sigma"] = f"s{i}"
        return told

    with tempfile.TemporaryDirectory(prefix="quasirigid-", ignore_cleanup_errors=True) as folder:
        table = Path(folder) / "bodies.csv"
        _write(table, {name: np.broadcast_to(column.reshape(-1), count) for name, column in columns.items()})
        study = {
            "model": model,
            "seed": seed,
            "samples": samples,
            "sampling": "latin-hypercube",
            "table": {"file": str(table)},
            "columns": {key: source(i, key) for i, key in enumerate(values)},
            "answer": {"quantities": list(quantities)},
        }
        rows = sweep(study, threads=threads, client=client, progress=progress)
    return Population(rows, count, samples, {key: f"v{i}" for i, key in enumerate(values)}, quantities)


def _write(path: Path, columns: Mapping[str, NDArray[Any]]) -> None:
    def text(value: Any) -> str:
        return repr(float(value)) if isinstance(value, float | np.floating) else str(value)

    with path.open("w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out)
        writer.writerow(columns)
        writer.writerows([text(value) for value in row] for row in zip(*columns.values(), strict=True))
