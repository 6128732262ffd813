"""Linear models: the program's numbers, SciPy's transfer functions, names that are none."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import signal

import quasirigid
from quasirigid import Model

BOOM = Model(quasirigid.EXAMPLE)


def test_a_linear_model_is_that_of_the_program(told: Any) -> None:
    plant = BOOM.linear(at="rest", inputs=["torque.y"], outputs=["rate.y", "attitude.y"])
    options = ["--at", "rest", "--inputs", "torque.y", "--outputs", "rate.y,attitude.y"]
    program = told("linear", "boom-satellite", *options)
    for key in ("A", "B", "C", "D", "states", "inputs", "outputs", "equilibrium", "sentence"):
        assert plant.to_dict()[key] == program[key]
    assert plant.holds and plant.outputs == ["rate.y", "attitude.y"]


def test_responses_are_those_of_scipy() -> None:
    plant = BOOM.linear(at=[0.0, 1.2, 0.0], inputs=["torque.y"], outputs=["rate.y"])
    scipy = plant.to_scipy()
    for matrix in ("A", "B", "C", "D"):
        np.testing.assert_array_equal(getattr(scipy, matrix), getattr(plant, matrix))
    omega = 0.7
    times = np.linspace(0.0, 40.0, 40001)
    _, response, _ = signal.lsim(scipy, np.cos(omega * times), times)
    # the ramp of the rate is the torque over the inertia; what is left oscillates with the torque
    gain = plant.frequency_response([omega])[0, 0, 0]
    steady = (gain * np.exp(1j * omega * times)).real
    late = slice(20000, None)
    np.testing.assert_allclose(response[late] - response[late].mean(), steady[late] - steady[late].mean(), atol=2e-3 * abs(gain))
    np.testing.assert_allclose(np.linalg.norm(plant.to_dict()["equilibrium"]["spin"]), 1.2, rtol=1e-12)


def test_the_names_reach_python_control() -> None:
    control = pytest.importorskip("control")
    plant = BOOM.linear(at="rest").to_control()
    assert isinstance(plant, control.StateSpace) and plant.input_labels == ["torque_x", "torque_y", "torque_z"]


def test_wrong_names_are_refused() -> None:
    with pytest.raises(quasirigid.InputError, match="give torque.x, force.x"):
        BOOM.linear(inputs=["torque.w"])
    with pytest.raises(quasirigid.InputError, match="'rest', 'spin' or an angular velocity"):
        BOOM.linear(at="fast")
