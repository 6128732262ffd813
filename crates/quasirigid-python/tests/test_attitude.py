"""Attitude files: SciPy's rotations, SPICE's matrices, NumPy's arrays and other libraries see the same motion."""

from __future__ import annotations

import pickle
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import quasirigid

HISTORY = quasirigid.Model(quasirigid.EXAMPLE).simulate(duration=60, samples=241)


def matrices(scalar_last: NDArray[np.float64]) -> NDArray[np.float64]:
    """Matrices of a message: they take components in frame A to those in frame B."""
    return Rotation.from_quat(scalar_last).inv().as_matrix()


def test_rotations_follow_the_angular_velocity() -> None:
    rotations = HISTORY.to_scipy()
    assert len(rotations) == 241
    # mean rate of a step, in body axes of its middle, against the mean of both ends
    steps = (rotations[:-1].inv() * rotations[1:]).as_rotvec() / np.diff(HISTORY.t)[:, None]
    rates = 0.5 * (HISTORY.angular_velocity[1:] + HISTORY.angular_velocity[:-1])
    off = np.abs(steps - rates).max() / np.abs(rates).max()
    assert off < 0.02  # second order in the step of 0.25 s
    wrong = (rotations[:-1] * rotations[1:].inv()).as_rotvec() / np.diff(HISTORY.t)[:, None]
    assert np.abs(wrong - rates).max() / np.abs(rates).max() > 0.5


@pytest.mark.parametrize("format", ["aem", "aem1", "stk"])
def test_files_are_read_back_and_have_the_numbers_of_scipy(format: str, tmp_path: Path) -> None:
    path = tmp_path / "spin"
    HISTORY.write_attitude(path, format, epoch="2026-01-01T00:00:00", frame="eme2000")
    read = quasirigid.read_attitude(path)
    np.testing.assert_allclose(read.attitude, HISTORY.attitude, atol=1e-15)
    np.testing.assert_allclose(read.q, read.attitude, atol=0)
    assert read.omega is not None
    np.testing.assert_allclose(read.omega, HISTORY.angular_velocity, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(read.t, HISTORY.t, atol=1e-12)
    assert (read.epoch, read.time_system) == ("2026-01-01T00:00:00.000", "UTC")
    lines = [line.split() for line in path.read_text().splitlines()]
    numbers = np.array([[float(word) for word in line[1:]] for line in lines if len(line) == 8 and line[0][0].isdigit()])
    assert numbers.shape == (241, 7)
    inertial = np.array([0.3, -0.5, 0.7])
    np.testing.assert_allclose(matrices(numbers[:, :4]) @ inertial, HISTORY.to_scipy().inv().apply(inertial), atol=1e-14)
    np.testing.assert_allclose(np.radians(numbers[:, 4:]), HISTORY.angular_velocity, rtol=1e-14, atol=1e-15)
    copied = pickle.loads(pickle.dumps(read))
    np.testing.assert_array_equal(copied.attitude, read.attitude)


def test_spice_makes_the_same_matrices_of_the_data(tmp_path: Path) -> None:
    path = tmp_path / "spin.msopck"
    HISTORY.write_attitude(path, time_system="tdb")
    rows = np.loadtxt(path)
    spice = pytest.importorskip("spiceypy")
    for row in rows[::40]:
        expected = Rotation.from_quat(np.roll(HISTORY.attitude[int(row[0] * 4)], -1)).inv().as_matrix()
        np.testing.assert_allclose(spice.q2m(row[1:5]), expected, atol=1e-14)
    assert "'SPICE QUATERNIONS'" in (tmp_path / "spin.msopck.setup").read_text()


def test_basilisk_has_parameters_of_scipy(tmp_path: Path) -> None:
    path = tmp_path / "spin.npz"
    HISTORY.write_attitude(path)
    arrays = np.load(path)
    assert arrays["times"].dtype == np.int64 and arrays["times"][1] == 250_000_000
    np.testing.assert_allclose(arrays["sigma_BN"], HISTORY.to_scipy().as_mrp(), atol=1e-14)
    np.testing.assert_array_equal(arrays["omega_BN_B"], HISTORY.angular_velocity)


def test_frames_of_other_libraries_have_every_column() -> None:
    frame = HISTORY.to_pandas()
    np.testing.assert_array_equal(frame["wz"], HISTORY.table["wz"])
    np.testing.assert_array_equal(frame.index, HISTORY.t)
    assert HISTORY.to_polars().columns == list(HISTORY.table)
    dataset = HISTORY.to_xarray()
    assert dataset["attitude"].dims == ("t", "quaternion") and dataset["angular_velocity"].attrs["units"] == "rad/s"
    np.testing.assert_array_equal(dataset["attitude"].sel(quaternion="w"), HISTORY.table["qw"])
    np.testing.assert_array_equal(dataset["energy"], HISTORY.energy)
    assert dataset.attrs["object"] == "boom satellite"


def test_a_file_without_rates_and_a_table_are_read(tmp_path: Path) -> None:
    HISTORY.write_attitude(tmp_path / "spin.a", rates=False)
    read = quasirigid.read_attitude(tmp_path / "spin.a")
    assert read.omega is None and "angular_velocity" not in read.to_xarray()
    HISTORY.to_pandas().to_csv(tmp_path / "history.csv")
    table = quasirigid.read_attitude(tmp_path / "history.csv")
    np.testing.assert_allclose(table.attitude, HISTORY.attitude, atol=2e-16)
    assert repr(table) == "quasirigid.Attitude of 241 records"
    table.write_attitude(tmp_path / "again.aem")
    np.testing.assert_allclose(quasirigid.read_attitude(tmp_path / "again.aem").attitude, HISTORY.attitude, atol=1e-15)


def test_a_missing_library_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match="this needs xarray, which is not installed: pip install xarray"):
        HISTORY.to_xarray()


def test_wrong_arguments_and_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(quasirigid.InputError, match="endings of attitude files are aem, a, msopck and npz"):
        HISTORY.write_attitude(tmp_path / "spin.txt")
    with pytest.raises(quasirigid.InputError, match="no epoch; write"):
        HISTORY.write_attitude(tmp_path / "spin.aem", epoch="tomorrow")
    with pytest.raises(quasirigid.InputError, match='"utc", "tai"'):
        HISTORY.write_attitude(tmp_path / "spin.aem", time_system="local")
    with pytest.raises(quasirigid.InputError, match="leap second"):
        HISTORY.write_attitude(tmp_path / "spin.aem", epoch="2016-12-31T23:59:30")
    (tmp_path / "bad.aem").write_text("CCSDS_AEM_VERS = 2.0\nMETA_START\nOBJECT_NAME\n")
    with pytest.raises(quasirigid.FileError, match=r"bad.aem:3: .OBJECT_NAME. is not allowed here"):
        quasirigid.read_attitude(tmp_path / "bad.aem")
