"""Tables: arrays on shared memory, and Arrow into the libraries that are installed."""

from __future__ import annotations

import ctypes
import gc
import pickle

import numpy as np
import pytest

import quasirigid
from quasirigid import Model, Table

HISTORY = Model(quasirigid.EXAMPLE).simulate(duration=60, samples=7)
MANY = Model(quasirigid.EXAMPLE).evolve(initial=[[0.1, 1.2, 0.0], [np.nan, 0, 0]])


def test_columns_share_the_memory_of_the_table() -> None:
    t, again = HISTORY.table["t"], HISTORY.table["t"]
    assert np.shares_memory(t, again) and not t.flags.writeable and not t.flags.owndata
    with pytest.raises(ValueError, match="read-only"):
        t[0] = 1
    kept = Model(quasirigid.EXAMPLE).simulate(duration=60, samples=7).t
    gc.collect()
    np.testing.assert_array_equal(kept, t)


def test_a_table_is_a_mapping_with_units() -> None:
    table = HISTORY.table
    assert list(table)[:2] == ["t", "wx"] and len(table) == len(table.units) and "wz" in table
    assert table.units["momentum"] == "N m s" and table.rows == 7
    assert set(map(len, table.values())) == {7}
    with pytest.raises(KeyError, match="the columns are t, wx"):
        table["none"]
    twin = pickle.loads(pickle.dumps(table))
    assert twin.units == table.units
    np.testing.assert_array_equal(twin["wz"], table["wz"])
    assert pickle.loads(pickle.dumps(MANY.table))["message"] == MANY.table["message"]


def test_a_table_is_no_array_of_its_names() -> None:
    pandas = pytest.importorskip("pandas")
    for wrong in (np.asarray, pandas.DataFrame):
        with pytest.raises(TypeError, match="polars.DataFrame"):
            wrong(HISTORY.table)
    assert list(pandas.DataFrame.from_arrow(HISTORY.table)["wz"]) == list(HISTORY.table["wz"])


def test_pyarrow_reads_every_kind_of_column() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(MANY.table)
    table.validate(full=True)
    assert table.column_names == list(MANY.table)
    assert table.schema.field("time").metadata == {b"unit": b"s"} and table.schema.field("status").metadata is None
    np.testing.assert_array_equal(table["time"].to_numpy(), MANY.time)
    assert table["message"].to_pylist() == MANY.message
    assert pyarrow.schema(HISTORY) == pyarrow.table(HISTORY).schema
    reader = pyarrow.RecordBatchReader.from_stream(HISTORY)
    assert [batch.num_rows for batch in reader] == [7]
    empty = pyarrow.table(Model(quasirigid.EXAMPLE).evolve(initial=np.zeros((0, 3))))
    assert empty.num_rows == 0


def test_memory_outlives_the_table() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(Model(quasirigid.EXAMPLE).simulate(duration=60, samples=7))
    gc.collect()
    np.testing.assert_array_equal(table["wz"].to_numpy(), HISTORY.table["wz"])
    picked = pyarrow.table(HISTORY).select(["t"])["t"]
    gc.collect()
    assert picked.to_pylist()[-1] == 60.0


def test_polars_and_pandas_read_tables() -> None:
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame(HISTORY)
    assert frame.shape == (7, len(HISTORY.table))
    np.testing.assert_array_equal(frame["wz"].to_numpy(), HISTORY.table["wz"])
    assert polars.DataFrame(MANY)["status"].to_list() == MANY.status
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame.from_arrow(MANY)
    assert frame["status"].tolist() == MANY.status and np.isnan(frame["time"][1])


def test_a_stream_that_nobody_reads_is_freed() -> None:
    name = ctypes.pythonapi.PyCapsule_GetName
    name.restype, name.argtypes = ctypes.c_char_p, [ctypes.py_object]
    for _ in range(1000):
        assert name(HISTORY.__arrow_c_stream__()) == b"arrow_array_stream"
        assert name(HISTORY.__arrow_c_schema__()) == b"arrow_schema"


def test_tables_that_cannot_be_are_refused() -> None:
    from quasirigid import _core

    with pytest.raises(quasirigid.InputError, match="differ in number"):
        _core.Columns(["a"], [], [])
    with pytest.raises(quasirigid.InputError, match="differ in length"):
        _core.Columns(["a", "b"], ["", ""], [["x"], ["x", "y"]])
    assert isinstance(HISTORY.table, Table)
