"""Tables of a record as other programs read them: pandas, polars, pyarrow, NumPy."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pandas
import polars
import pyarrow.parquet
import pytest
from conftest import EXAMPLES, program


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A record with its tables in every format."""
    folder = tmp_path_factory.mktemp("tables") / "spin"
    call = [str(program()), "run", str(EXAMPLES / "axial-mass" / "model.toml"), "-o", str(folder), "--quiet"]
    subprocess.run([*call, "--samples", "301", "--duration", "60", "--tables", "csv,parquet,npz"], check=True)
    return folder


def test_every_reader_finds_the_same_numbers(record: Path) -> None:
    heads = json.loads((record / "record.json").read_text())["histories"][0]["columns"]
    table = pandas.read_csv(record / "history-reduced.csv")
    binary = pandas.read_parquet(record / "history-reduced.parquet")
    other = polars.read_parquet(record / "history-reduced.parquet")
    with np.load(record / "history-reduced.npz") as arrays:
        assert sorted(arrays.files) == sorted(["inputs", *(head["name"] for head in heads)])
        assert json.loads(str(arrays["inputs"])) == json.loads((record / "record.json").read_text())["inputs"]
        for head in heads:
            name = head["name"]
            assert table[name].to_numpy().tobytes() == arrays[name].tobytes() == binary[name].to_numpy().tobytes(), name
            assert other[name].to_numpy().tobytes() == arrays[name].tobytes()
            assert arrays[name].dtype == np.dtype("<f8") and arrays[name].shape == (301,)


def test_units_stand_in_the_metadata(record: Path) -> None:
    metadata = pyarrow.parquet.read_schema(record / "history-reduced.parquet").metadata
    units = json.loads(metadata[b"quasirigid.units"])
    heads = json.loads((record / "record.json").read_text())["histories"][0]["columns"]
    assert units == {head["name"]: head["unit"] for head in heads}


@pytest.mark.parametrize("form", ["parquet", "npz"])
def test_a_table_of_simulate_is_that_of_csv(form: str, tmp_path: Path) -> None:
    call = [str(program()), "simulate", str(EXAMPLES / "boom-satellite" / "model.toml"), "--quiet", "--duration", "60", "--samples", "101"]
    for name in [form, "csv"]:
        subprocess.run([*call, "--system", "full", "--coordinates", "--format", name, "--out", str(tmp_path / f"t.{name}")], check=True)
    table = pandas.read_csv(tmp_path / "t.csv")
    read = pandas.read_parquet(tmp_path / "t.parquet") if form == "parquet" else np.load(tmp_path / "t.npz")
    for name in table.columns:
        member = name.replace("/", "_") if form == "npz" else name
        assert np.array_equal(table[name].to_numpy(), np.asarray(read[member])), name
