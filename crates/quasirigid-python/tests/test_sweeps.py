"""Studies: the rows of the program to the bit, in this process or in others; what cannot be answered is a row with its reason."""

from __future__ import annotations

import html
import multiprocessing
import os
import pickle
import signal
import subprocess
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest
from conftest import EXAMPLES, program

import quasirigid
from quasirigid import Model, sweep

BOOM = Model(quasirigid.EXAMPLE)
MODEL = EXAMPLES / "boom-satellite" / "model.toml"
STUDY = f"""
model = {str(MODEL)!r}
samples = 3
part = 4
[vary]
"spring.1.stiffness" = {{ list = ["500 N/m", "600 N/m", "-1 N/m"] }}
"spring.1.damping" = {{ log-normal = {{ median = "30 N s/m", decades = 0.3 }} }}
[answer]
quantities = ["check.valid", "modes.nutation.time_constant", "evolve.time", "evolve.mode.end"]
"""


def small(**changes: Any) -> dict[str, Any]:
    study: dict[str, Any] = {
        "model": BOOM,
        "vary": {"spring.1.damping": {"list": [10.0, 30.0, 90.0]}},
        "answer": {"quantities": ["modes.nutation.time_constant", "modes.stable"]},
    }
    return study | changes


@pytest.fixture(scope="module")
def serial(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The file of a study, and the folder that the program made of it."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "study.toml").write_text(STUDY)
    call = [str(program()), "sweep", str(folder / "study.toml"), "-o", str(folder / "serial"), "--threads", "1", "--quiet"]
    assert subprocess.run(call, check=False).returncode == 1  # a third of the rows is no model
    return folder / "study.toml", folder / "serial"


def contents(folder: Path) -> dict[str, bytes]:
    files = (path for path in sorted(folder.rglob("*")) if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def test_the_files_are_those_of_the_program(serial: tuple[Path, Path], tmp_path: Path) -> None:
    file, folder = serial
    study = sweep(file, tmp_path / "own")
    assert contents(tmp_path / "own") == contents(folder)
    assert study.rows == 9 and not study and study.answered.sum() == 6 and study.folder == tmp_path / "own"
    assert set(study.status) == {"answered", "invalid"} and "-1" in str(study.reason[7])
    read = quasirigid.read_sweep(folder)
    np.testing.assert_array_equal(read["evolve.time"], study["evolve.time"])
    assert read.summary == study.summary and str(read) == str(study)


def test_columns_are_those_of_the_parts(serial: tuple[Path, Path]) -> None:
    study = quasirigid.read_sweep(serial[1])
    parts = polars.read_parquet(serial[1] / "parts" / "*.parquet")
    frame = polars.DataFrame(study)
    assert frame.columns == parts.columns == study.columns and len(study) == 9
    assert frame.fill_nan(None).equals(parts)
    assert study["row"].dtype == np.int64 and study["check.valid"].dtype == object and study["check.valid"][8] is None
    assert study["reason"][~study.answered].tolist() == [reason for reason in study.reason if reason]
    assert study.units["evolve.time"] == "s" and study["evolve.mode.end"][8] is None
    back = pickle.loads(pickle.dumps(study))
    assert back.summary == study.summary and polars.DataFrame(back).equals(frame)


def test_a_dictionary_is_a_study_and_needs_no_file() -> None:
    study = sweep(small())
    assert study and study.folder is None and study["modes.stable"].tolist() == [False] * 3
    assert study["modes.stable"].dtype == np.bool_ and study.units["spring.1.damping"] == ""
    for damping, found in zip(study["spring.1.damping"], study["modes.nutation.time_constant"], strict=True):
        alone = BOOM.with_({"spring.1.damping": damping}).modes().time_constants[0]
        assert found == alone
    assert "3 rows answered" in str(study) and html.escape(str(study)) in study._repr_html_() and "3 answered" in repr(study)


def test_rows_that_do_not_hold_have_no_numbers() -> None:
    soft = {"spring.1.stiffness": {"list": [600.0, 30.0]}, "spring.2.stiffness": {"list": [600.0, 30.0]}}
    study = sweep(small(vary=soft, answer={"quantities": ["simulate.wz"], "times": ["1 min"]}))
    name = "simulate.wz at 1 min"
    assert study.status == ["answered", "refused", "refused", "refused"]
    assert np.isnan(study[name]).tolist() == [False, True, True, True]
    assert all("DO NOT HOLD" in str(reason) for reason in study.reason[1:])


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ({"vary": {"spring.1.dampin": {"list": [1.0]}}}, "damping"),
        ({"vary": {"spring.1.damping": {"lost": [1.0]}}}, "lost"),
        ({"answer": {"quantities": ["modes.tilt"]}}, "tilt"),
        ({"model": "nowhere.toml"}, "nowhere.toml"),
        ({"samples": 0}, "samples"),
    ],
)
def test_mistakes_are_told(change: dict[str, Any], part: str) -> None:
    with pytest.raises((quasirigid.ModelError, quasirigid.MissingFileError), match=part):
        sweep(small(**change))


def test_arguments_that_mean_nothing(tmp_path: Path) -> None:
    for arguments in ({"threads": 0}, {"client": 3}, {"threads": 1, "client": 3}):
        with pytest.raises(quasirigid.InputError):
            sweep(small(), **arguments)  # type: ignore[arg-type]
    with pytest.raises(quasirigid.InputError):
        sweep(3)  # type: ignore[arg-type]
    sweep(small(), tmp_path / "own")
    with pytest.raises(quasirigid.FileError, match="resume=True"):
        sweep(small(), tmp_path / "own")
    with pytest.raises(quasirigid.FileError, match="choose another folder with out"):
        sweep(small(samples=2, vary={}), tmp_path / "own", resume=True)


def test_a_study_that_its_observer_ends_goes_on(tmp_path: Path) -> None:
    study = small(samples=160, part=20, vary={"spring.1.damping": {"uniform": [10.0, 90.0]}})
    study["answer"] = {"quantities": ["modes.nutation.time_constant", "check.T3"]}
    with pytest.raises(quasirigid.Interrupted, match="go on in .* with resume=True"):
        sweep(study, tmp_path / "own", progress=lambda stage, share: share < 0.3)
    resumed = sweep(study, tmp_path / "own", resume=True)
    np.testing.assert_array_equal(resumed["check.T3"], sweep(study)["check.T3"])


def test_processes_give_the_same_bytes(serial: tuple[Path, Path], tmp_path: Path) -> None:
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        sweep(serial[0], tmp_path / "own", client=pool)
    assert contents(tmp_path / "own") == contents(serial[1])


@pytest.fixture
def cluster() -> Iterator[Any]:
    distributed = pytest.importorskip("distributed")
    quiet = {"distributed.worker.memory.terminate": False, "logging.distributed": "critical"}
    import dask

    with dask.config.set(quiet):
        local = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50)
        with local, distributed.Client(local) as client:
            yield client


def test_a_lost_worker_of_dask_loses_nothing(cluster: Any, serial: tuple[Path, Path], tmp_path: Path) -> None:
    killed: list[int] = []

    def kill_one(stage: str, share: float) -> bool:
        if stage == "answering" and share > 0 and not killed:
            killed.append(next(iter(cluster.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)
        return True

    sweep(serial[0], tmp_path / "own", client=cluster, progress=kill_one)
    assert killed and contents(tmp_path / "own") == contents(serial[1])


def test_a_lost_worker_of_ray_loses_nothing(serial: tuple[Path, Path], tmp_path: Path) -> None:
    ray = pytest.importorskip("ray")
    killed: list[int] = []

    def kill_one(stage: str, share: float) -> bool:
        if stage == "answering" and share > 0 and not killed:
            called = subprocess.run(["pgrep", "-f", "ray::_run"], capture_output=True, text=True, check=False)
            for pid in called.stdout.split()[:1]:
                os.kill(int(pid), signal.SIGKILL)
                killed.append(int(pid))
        return True

    # workers find the modules of this environment, and none of the tests'
    ray.init(num_cpus=2, include_dashboard=False, logging_level="critical", log_to_driver=False)
    try:
        sweep(serial[0], tmp_path / "own", client=ray, progress=kill_one)
    finally:
        ray.shutdown()
    assert contents(tmp_path / "own") == contents(serial[1])


def test_figures_of_a_study(serial: tuple[Path, Path]) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    study = quasirigid.read_sweep(serial[1])
    assert study.plot().axes[0].get_xlabel() == "modes.nutation.time_constant (s)"
    curve = study.plot("spring.1.damping", "evolve.time").axes[0]
    assert curve.get_ylabel() == "evolve.time (s)" and "3 of 9 rows" in curve.get_title()
    with pytest.raises(quasirigid.InputError):
        study.plot("status")
