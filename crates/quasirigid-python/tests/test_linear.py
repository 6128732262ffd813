"""Linear models: the program's numbers, SciPy's transfer functions, names that are none."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import io, linalg, signal, sparse

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


# A hub with a material of constant loss, and a momentum wheel.
SOFT = """
[carrier]
mass = 40
center_of_mass = [0, 0.1, 0]
inertia = [9, 13, 16]

[[point]]
name = "tip"
mass = 1.2
position = [0.9, 0.1, 0.3]

[[spring]]
from = "tip"
to = "carrier"
stiffness = 50
rheology = { kind = "quality-factor", Q = 30 }

[[wheel]]
name = "w"
axis = [0, 0.6, 0.8]
momentum = 2
"""


@pytest.mark.parametrize("ending", [".mat", ".npz"])
def test_other_programs_read_what_is_saved(ending: str, tmp_path: Any) -> None:
    plant = Model(SOFT).linear(at="rest", inputs=["wheel.w.torque", "torque.x"], outputs=["rate.y", "wheel.w.momentum"])
    file = tmp_path / f"plant{ending}"
    plant.save(file)
    read: Any = io.loadmat(file, squeeze_me=False) if ending == ".mat" else np.load(file)
    for key in "ABCD":
        np.testing.assert_array_equal(read[key], getattr(plant, key))
    texts = {key: [str(np.squeeze(name)) if ending == ".npz" else str(name[0][0]) for name in read[key]] for key in ("inputs", "states_units")}
    assert texts["inputs"] == plant.inputs and texts["states_units"][0] == "rad"
    assert str(read["sentence"] if ending == ".npz" else read["sentence"][0]) == "About rest."
    with pytest.raises(quasirigid.InputError, match="give a .mat or a .npz file"):
        plant.save(tmp_path / "plant.txt")


def test_the_error_of_a_material_is_told_and_falls_with_the_band() -> None:
    wide, narrow = (Model(SOFT).linear(at="rest", band=band) for band in (None, [5.0, 8.0]))
    assert wide.to_dict()["accuracy"]["error"] < 0.1 and wide.holds
    assert narrow.to_dict()["accuracy"]["error"] < 0.05 and narrow.to_dict()["accuracy"]["band"] == [5.0, 8.0]
    assert "of the exact one of materials and liquids between" in str(wide)
    with pytest.raises(quasirigid.InputError, match="no band of frequencies"):
        Model(SOFT).linear(band=[3.0, 1.0])


def hankel_singular_values(plant: quasirigid.Linear, scales: dict[str, Any]) -> Any:
    """Of the part that decays, by Bartels and Stewart's solver and products of Gramians."""
    A, B, C = plant.A, plant.B / np.asarray(scales["input_scales"]), plant.C / np.asarray(scales["output_scales"])[:, None]
    T, Q, count = linalg.schur(A.astype(complex), output="complex", sort=lambda pole: pole.real < -1e-9)
    X = linalg.solve_sylvester(T[:count, :count], -T[count:, count:], -T[:count, count:])
    left = np.hstack([np.eye(count), -X]) @ Q.conj().T
    part = T[:count, :count], left @ B, C @ Q[:, :count]
    reached = linalg.solve_continuous_lyapunov(part[0], -part[1] @ part[1].conj().T)
    seen = linalg.solve_continuous_lyapunov(part[0].conj().T, -part[2].conj().T @ part[2])
    return np.sort(np.sqrt(np.abs(linalg.eigvals(reached @ seen))))[::-1]


@pytest.mark.parametrize("at", ["rest", [0.0, 1.2, 0.0]])
def test_truncated_models_keep_their_bound(at: Any) -> None:
    plant = BOOM.linear(at=at, outputs=["rate.x", "rate.y", "rate.z", "attitude.y"])
    told = plant.truncated(14).to_dict()["truncation"]
    own = np.array(told["hankel_singular_values"])
    np.testing.assert_allclose(own, hankel_singular_values(plant, told)[: len(own)], atol=1e-7 * own[0])
    omega = np.geomspace(1e-3, 1e3, 400)
    for states, method in ((14, "balanced"), (12, "balanced"), (14, "modal")):
        part = plant.truncated(states, method=method)
        told = part.to_dict()["truncation"]
        assert part.A.shape == (states, states) and str(part).index("response is within") < str(part).index("About")
        below = omega[omega <= (told["up_to"] or np.inf)]
        whole, error = (
            response / np.outer(told["output_scales"], told["input_scales"])
            for response in (plant.frequency_response(below), plant.frequency_response(below) - part.frequency_response(below))
        )
        gains = np.linalg.norm(error, 2, (1, 2)) - 1e-10 * np.linalg.norm(whole, 2, (1, 2))
        assert gains.max() <= told["bound"]


def test_a_truncated_model_is_that_of_the_program(told: Any) -> None:
    part = BOOM.linear(at="rest").truncated(13)
    program = told("linear", "boom-satellite", "--at", "rest", "--truncate", "balanced", "--keep", "13")
    for key in ("A", "B", "C", "D", "states", "truncation"):
        assert part.to_dict()[key] == program[key]
    with pytest.raises(quasirigid.InputError, match="states do not decay"):
        BOOM.linear(at="rest").truncated(2)
    with pytest.raises(quasirigid.InputError, match="give 'balanced' or 'modal'"):
        BOOM.linear(at="rest").truncated(13, method="best")
    with pytest.raises(quasirigid.InputError, match="truncate the whole model"):
        part.truncated(12)


def test_figures_are_drawn_on_the_axes_given() -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plant = BOOM.linear(at="rest", inputs=["torque.x", "torque.y"], outputs=["rate.y", "attitude.y"])
    omega = np.geomspace(0.1, 10.0, 50)
    figure, axes = plt.subplots(3, 1)
    assert plant.bode(omega, input="torque.y", output="attitude.y", ax=axes[:2]) is figure
    assert plant.nichols(omega, input="torque.y", output="attitude.y", ax=axes[2]) is figure
    gain, phase = (axis.lines[0].get_ydata() for axis in axes[:2])
    response = plant.to_xarray(omega).sel(input="torque.y", output="attitude.y").values
    np.testing.assert_allclose(10 ** (np.asarray(gain) / 20) * np.exp(1j * np.radians(phase)), response, rtol=1e-12)
    with pytest.raises(quasirigid.InputError, match="is not among"):
        plant.bode(omega, input="torque.z")
    plt.close(figure)


CARRIER = """
[carrier]
mass = 30.0
center_of_mass = [0.1, 0, 0]
inertia = [9, 11, 13]
[initial]
angular_velocity = [0.1, -0.2, 0.3]
[[controller]]
name = "law"
kind = "state-space"
inputs = ["rate.x", "rate.y", "attitude.z"]
outputs = ["torque.x", "torque.y"]
"""


def test_controllers_take_their_matrices_from_files_of_matlab_and_numpy(tmp_path: Path) -> None:
    law = {
        "A": np.array([[-0.5, 0.2], [0.0, -1.0]]),
        "B": np.array([[1.0, 0.0, 0.5], [0, 2, 0]]),
        "C": np.array([[-3.0, 0.0], [0.25, -4.0]]),
        "D": np.array([[-1, 0, 0], [0, -2, 0]], dtype=np.int16),
    }
    rows = "".join(f"{name} = {matrix.tolist()}\n" for name, matrix in law.items())
    times = np.linspace(0, 5, 6)
    known = Model(CARRIER + rows).simulate("full", times=times).angular_velocity
    io.savemat(tmp_path / "packed.mat", law | {"about": "a law"}, do_compression=True)
    io.savemat(tmp_path / "plain.mat", law | {"C": sparse.csc_matrix(law["C"])})
    np.savez(tmp_path / "law.npz", **law)
    for file in ("packed.mat", "plain.mat", "law.npz"):
        (tmp_path / "model.toml").write_text(CARRIER + f'matrices = "{file}"\n')
        found = Model.from_file(tmp_path / "model.toml").simulate("full", times=times).angular_velocity
        np.testing.assert_array_equal(found, known)
    io.savemat(tmp_path / "other.mat", {"K": law["A"]})
    for lines, said in (('matrices = "other.mat"', "neither A nor D"), ('matrices = "law.npz"\nD = [[1]]', "`D` here and `matrices`")):
        (tmp_path / "model.toml").write_text(CARRIER + lines)
        with pytest.raises(quasirigid.ModelError, match=said):
            Model.from_file(tmp_path / "model.toml")


def test_matrices_of_parts_come_from_files_of_matlab(tmp_path: Path) -> None:
    nodes = "1 1 0 0\n2 2 0 0\n"
    stiffness = np.diag(np.arange(6) + 50.0) + 0.5
    mass = np.diag([2.0, 2, 2, 1, 1, 1])
    part = '[carrier]\nmass = 30.0\ncenter_of_mass = [0.1, 0, 0]\ninertia = [9, 11, 13]\n[[matrices]]\nname = "p"\nnodes = "nodes.csv"\n'
    (tmp_path / "nodes.csv").write_text(nodes)
    io.savemat(tmp_path / "km.mat", {"K": sparse.csr_matrix(stiffness), "M": mass}, do_compression=True)
    np.savez(tmp_path / "km.npz", K=stiffness, M=mass)
    found = []
    for file in ("km.mat", "km.npz"):
        keys = f'stiffness = {{ file = "{file}", name = "K" }}\nmass = {{ file = "{file}", name = "M" }}\n'
        (tmp_path / "model.toml").write_text(part + keys + "[initial]\nangular_velocity = [0, 0, 0.3]\n")
        found.append(Model.from_file(tmp_path / "model.toml").modes().to_dict()["modes"])
    assert found[0] == found[1] and len(found[0]) >= 6
