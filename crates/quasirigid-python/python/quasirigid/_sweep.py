"""Studies: the same question of many bodies, in this process or on a cluster."""

from __future__ import annotations

import contextlib
import functools
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

import numpy as np
from numpy.typing import NDArray

from quasirigid import _arguments, _cluster, _core
from quasirigid._errors import FileError, InputError, Interrupted
from quasirigid._model import Model
from quasirigid._progress import Progress, observer
from quasirigid._property import texts
from quasirigid._table import Table, Tabled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Sweep", "read_sweep", "sweep"]

# File that a dictionary is said to stand in; what it names is looked for beside it.
_NAMELESS = "study.toml"
# Time of a block of rows on a worker (s).
_BLOCK = 3.0
# Blocks that each worker has waiting, so that none stands idle between two.
_WAITING = 2
# The study that this process answered last, by its checksum.
_STUDIES: dict[str, _core.Sweep] = {}


class Sweep(Tabled):
    """Answers of a study: a row for each body, in the order of the study.

    ``study[name]`` is a column: an input, a quantity asked for, ``status``, ``reason`` or ``note``. Numbers that are missing are NaN,
    truth values and texts ``None``; times that never end are infinite. A study is false if not every row is answered. Arrow libraries
    read it: ``polars.DataFrame(study)``, ``pandas.DataFrame.from_arrow(study)``.

    >>> import quasirigid
    >>> study = quasirigid.sweep({
    ...     "model": quasirigid.Model(quasirigid.EXAMPLE),
    ...     "vary": {"spring.1.damping": {"list": [10.0, 30.0]}},
    ...     "answer": {"quantities": ["evolve.time"]},
    ... })
    >>> study.rows, study.status, study["evolve.time"].shape
    (2, ['answered', 'answered'], (2,))
    """

    __slots__ = ("_folder", "_summary", "_table", "_text")

    def __init__(self, table: Table, summary: dict[str, Any], text: str, folder: Path | None) -> None:
        self._table = table
        self._summary, self._text, self._folder = summary, text, folder

    def __getitem__(self, name: str) -> Any:
        """A column, an array ``(rows,)``; one of texts has ``dtype=object`` and ``None`` where there is no text."""
        column = self.table[name]
        return np.array(column, dtype=object) if isinstance(column, list) else column

    def __iter__(self) -> NoReturn:
        """Refuses: a study is no list of its rows."""
        raise TypeError("a Sweep is not iterable; take columns by name, or its table")

    def __len__(self) -> int:
        return self.rows

    def __bool__(self) -> bool:
        return self.rows == int(self.answered.sum())

    @property
    def rows(self) -> int:
        """Number of rows."""
        return self.table.rows

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(self.table)

    status = texts("Status of each row: ``answered``, ``refused``, ``invalid`` or ``failed``.")

    @property
    def reason(self) -> list[str | None]:
        """Reason of each row that is not answered."""
        return list(self.table["reason"])

    @property
    def answered(self) -> NDArray[np.bool_]:
        """Whether each row is answered, ``(rows,)``."""
        return np.array([status == "answered" for status in self.table["status"]], dtype=np.bool_)

    @property
    def folder(self) -> Path | None:
        """Folder of the results; none for results that were not kept."""
        return self._folder

    @property
    def summary(self) -> dict[str, Any]:
        """Percentiles, rank correlations and reasons: the object ``summary.json``."""
        return self._summary

    def __array__(self, *_: object, **__: object) -> NDArray[Any]:
        """Refuses: numbers and texts make no array."""
        return self.table.__array__()

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {status}" for status, count in self._summary["status"].items())
        return f"quasirigid.Sweep of {self.rows} rows: {counts}"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self._text)}</pre>"

    def plot(self, x: str | None = None, y: str | None = None) -> Figure:
        """Quantity against an input, or the histogram of a quantity (needs matplotlib).

        Args:
            x: column of the abscissa; without it, a histogram of ``y``.
            y: column of numbers; the first quantity by default.
        """
        from quasirigid import _plot

        return _plot.sweep(self, x, y)


@_arguments.renamed("out")
def sweep(
    study: str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str] | None = None,
    *,
    resume: bool = False,
    threads: int | None = None,
    client: Any = None,
    progress: Progress = False,
) -> Sweep:
    """Answer the same question of many bodies: grids, random draws, or a table of bodies.

    Args:
        study: file of a study; or the study as a dictionary with the keys of the file, whose ``model`` may be a ``Model``.
        out: folder of the results, with the report page; by default they are not kept.
        resume: go on in a folder with results of this study.
        threads: number of threads; all cores by default. No bit depends on it.
        client: cluster that answers the rows: a ``distributed.Client`` of Dask, the module ``ray``, or an executor of
            ``concurrent.futures`` with processes. Files that the study names must stand where its workers find them.
            The bits are those of one process, and the rows of a worker that is lost are answered by another.
        progress: ``True`` for a bar, or a function of the stage and the share done, which ends the work by ``False``.

    Returns:
        The rows. A row that cannot be answered has its reason.

    Raises:
        ModelError: a mistake in the study or its model, with its place.
        FileError: a folder that holds something else.
        Interrupted: ``progress`` ended the work; a folder keeps what was answered, for ``resume``.

    >>> import quasirigid
    >>> study = quasirigid.sweep({
    ...     "model": quasirigid.Model(quasirigid.EXAMPLE),
    ...     "samples": 20,
    ...     "vary": {"spring.1.stiffness": {"log-normal": {"median": "600 N/m", "decades": 0.1}}},
    ...     "answer": {"quantities": ["modes.nutation.time_constant"]},
    ... })
    >>> [row["percent"] for row in study.summary["quantities"][0]["percentiles"]]
    [16.0, 50.0, 84.0]
    """
    workers = _arguments.count(threads, "threads")
    if workers == 0:
        raise InputError("threads = 0: give at least one")
    if client is not None and workers is not None:
        raise InputError("threads and client exclude each other: the cluster has threads of its own")
    with contextlib.ExitStack() as stack:
        scratch = stack.enter_context(_scratch())
        parts = _parts(study)
        place = Path(_arguments.path(out, "out")) if out is not None else scratch / "results"
        show = stack.enter_context(observer(progress))
        core = _core.Sweep.open(*parts, show)
        try:
            if client is None:
                ended = core.run(str(place), resume, workers, show)
            else:
                ended = _on_cluster(core, parts, place, resume, _cluster.cluster(client), show)
        except Interrupted as error:
            raise Interrupted(f"{error}; go on in {place} with resume=True") if out is not None else error from None
        return _results(place, ended, kept=out is not None)


def read_sweep(folder: str | os.PathLike[str]) -> Sweep:
    """Read the results of a study from its folder, whoever answered the rows: this package, the program, an array of jobs.

    Raises:
        FileError: a folder in which not every row is answered.

    >>> import quasirigid
    >>> quasirigid.read_sweep("no-such-folder")
    Traceback (most recent call last):
        ...
    quasirigid.FileError: no-such-folder has no summary of a study: its rows are not all answered, or it is another folder; ...
    """
    place = _arguments.path(folder, "folder")
    columns, summary, text = _core.read_sweep(place)
    return Sweep(Table(columns), summary, text, Path(place))


def _results(place: Path, ended: tuple[int, int, int, bool], kept: bool) -> Sweep:
    there, parts, elsewhere, _ = ended
    if there < parts:
        raise FileError(f"{there} of {parts} parts are in {place}; another process is working on {elsewhere} more")
    found = read_sweep(place)
    return found if kept else Sweep(found.table, found.summary, str(found), None)


@contextlib.contextmanager
def _scratch() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="quasirigid-", ignore_cleanup_errors=True) as name:
        yield Path(name)


# File of a study, its text where it stands in none, and the text of a model that stands in none.
Parts: TypeAlias = tuple[str, str | None, str | None]
Show: TypeAlias = Callable[[str, float], object]


def _parts(study: str | os.PathLike[str] | Mapping[str, Any]) -> Parts:
    if not isinstance(study, Mapping):
        try:
            return os.path.abspath(_arguments.path(study, "study")), None, None
        except InputError as error:
            raise InputError(f"{error}; give the path of a study file, or a dictionary") from None
    entries, model_text = dict(study), None
    model = entries.get("model")
    if isinstance(model, Model):
        entries["model"], model_text = str(model.file), model.text
    elif isinstance(model, os.PathLike):
        entries["model"] = os.fsdecode(model)
    return os.path.abspath(_NAMELESS), _core.to_toml(entries), model_text


def _on_cluster(
    core: _core.Sweep, parts: Parts, place: Path, resume: bool, workers: _cluster.Workers, show: Show | None
) -> tuple[int, int, int, bool]:
    """Hands blocks of rows to workers, a few more than there are workers at a time, and collects their answers."""
    collector = core.collect(str(place), resume)
    share = max(1, core.rows // (4 * workers.count))
    size = min(share, max(1, int(_BLOCK / max(core.row_time, 1e-6))))
    task = functools.partial(_answer, parts, core.sha256)
    waiting = 0
    try:
        while True:
            while waiting < _WAITING * workers.count and (rows := collector.next(size)):
                workers.submit(task, rows)
                waiting += 1
            if waiting == 0:
                return collector.finish()
            for lines in workers.wait():
                waiting -= 1
                collector.keep(lines)
            if show is not None and show("answering", collector.done / core.rows) is False:
                raise Interrupted("the work was stopped on request")
    finally:
        workers.cancel()


def _opened(parts: Parts, sha256: str) -> _core.Sweep:
    """The study of a task, kept for the next."""
    known = _STUDIES.get(sha256)
    if known is not None:
        return known
    core = _core.Sweep.open(*parts, None)
    if core.sha256 != sha256:
        raise FileError(
            f"{parts[0]}: a worker finds another study here: its model, its table or its meshes differ from those of the client, or the "
            "version of quasirigid does"
        )
    _STUDIES.clear()
    return _STUDIES.setdefault(sha256, core)


def _answer(parts: Parts, sha256: str, rows: list[int]) -> bytes:
    """Answers of some rows, on a worker."""
    return _opened(parts, sha256).answer(rows)
