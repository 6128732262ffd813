"""Functional mock-up units in FMPy: its validator, histories of both kinds, inputs, states that are saved."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES

from quasirigid import Model

fmpy = pytest.importorskip("fmpy")
validation = pytest.importorskip("fmpy.validation")

BODIES = ["three-masses", "boom-satellite", "friction-wheel"]
TARGETS = ["fmu2", "fmu3"]
NAMES = ["omega_x", "omega_y", "omega_z", "q_w", "q_x", "q_y", "q_z", "momentum", "energy"]
COLUMNS = ["wx", "wy", "wz", "qw", "qx", "qy", "qz", "momentum", "energy"]


def unit(example: str, target: str, folder: Path) -> str:
    """File of a unit, with a library for this platform."""
    path = folder / "body.fmu"
    written = Model.from_file(EXAMPLES / example / "model.toml").export(target, path, order=3)
    if any("compiler" in note for note in written.notes):
        pytest.skip("there is no C compiler")
    return str(path)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("example", BODIES)
def test_units_are_valid_and_run_like_simulate(example: str, target: str, tmp_path: Path) -> None:
    file = unit(example, target, tmp_path)
    assert validation.validate_fmu(file) == []
    model = Model.from_file(EXAMPLES / example / "model.toml")
    history = model.simulate(times=[0.0, 20.0], order=3, tolerance=1e-12)
    for kind, allowed in (("CoSimulation", 1e-9), ("ModelExchange", 1e-6)):
        run: Any = fmpy.simulate_fmu(
            file, fmi_type=kind, stop_time=20, output_interval=0.5, relative_tolerance=1e-12, output=[*NAMES, "valid", "power"]
        )
        for name, column in zip(NAMES, COLUMNS, strict=True):
            scale = 1.0 if column[0] in "wq" else history[column][0]
            # an attitude and its opposite are the same
            assert abs(abs(run[name][-1]) - abs(history[column][-1])) < allowed * scale, (kind, name)
        assert all(run["valid"]) and min(run["power"]) >= 0
        if kind == "CoSimulation":
            assert np.ptp(run["momentum"]) < 1e-12 * run["momentum"][0]
            assert max(np.diff(run["energy"])) <= 4e-15 * run["energy"][0]


@pytest.mark.parametrize("target", TARGETS)
def test_a_torque_does_work_and_a_force_moves_the_body(target: str, tmp_path: Path) -> None:
    file = unit("three-masses", target, tmp_path)
    model = Model.from_file(EXAMPLES / "three-masses" / "model.toml")
    mass = model.reduce(3).to_dict()["mass"]
    start = {"torque_z": 0.05, "force_x": 0.3}
    names = [*NAMES, "power", *(f"{what}_{axis}" for what in ("position", "velocity") for axis in "xyz")]
    run: Any = fmpy.simulate_fmu(file, start_values=start, stop_time=10, output_interval=0.01, output=names)
    work = np.trapezoid(0.05 * run["omega_z"] - run["power"], run["time"])
    assert run["energy"][-1] - run["energy"][0] == pytest.approx(work, rel=1e-3)
    speed = np.array([run[f"velocity_{axis}"] for axis in "xyz"])
    way = np.array([run[f"position_{axis}"] for axis in "xyz"])
    w, x, y, z = (run[f"q_{part}"] for part in "wxyz")
    along = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])  # the body's x in inertial axes
    pushed = 0.3 / mass * (along[:, 1:] + along[:, :-1]) / 2
    np.testing.assert_allclose(np.diff(speed) / 0.01, pushed, rtol=0, atol=1e-3 * 0.3 / mass)
    np.testing.assert_allclose(np.trapezoid(speed, run["time"]), way[:, -1], atol=1e-5)


@pytest.mark.parametrize("target", TARGETS)
def test_a_saved_state_goes_on_with_the_same_bits(target: str, tmp_path: Path) -> None:
    file = unit("three-masses", target, tmp_path)
    description: Any = fmpy.read_model_description(file)
    folder = fmpy.extract(file)
    body: Any = fmpy.instantiate_fmu(folder, description, "CoSimulation")
    if target == "fmu2":
        body.setupExperiment(startTime=0.0)
        body.enterInitializationMode()
    else:
        body.enterInitializationMode(startTime=0.0)
    body.exitInitializationMode()
    numbers = [variable.valueReference for variable in description.modelVariables if variable.name in NAMES]
    get = body.getReal if target == "fmu2" else body.getFloat64
    body.doStep(currentCommunicationPoint=0.0, communicationStepSize=1.0)
    save, restore, free = (
        (body.getFMUstate, body.setFMUstate, body.freeFMUstate)
        if target == "fmu2"
        else (body.getFMUState, body.setFMUState, body.freeFMUState)
    )
    state = save()
    body.doStep(currentCommunicationPoint=1.0, communicationStepSize=1.0)
    first = get(numbers)
    restore(state)
    body.doStep(currentCommunicationPoint=1.0, communicationStepSize=1.0)
    assert get(numbers) == first
    free(state)
    body.terminate()
    body.freeInstance()
