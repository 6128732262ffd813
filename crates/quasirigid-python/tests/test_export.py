"""Exported equations in the tools of Python: NumPy, SymPy, heyoka, and Modelica by CasADi; against the library and the program."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from conftest import EXAMPLES
from scipy.integrate import solve_ivp

from quasirigid import FileError, InputError, Model, UnsupportedError

BODIES = ["three-masses", "boom-satellite", "friction-wheel", "spherical-tank"]


def model_of(example: str) -> Model:
    """An example; its liquid is so viscous, and its spin so slow, that it follows the spin."""
    text = (EXAMPLES / example / "model.toml").read_text(encoding="utf-8")
    if example == "spherical-tank":
        text = text.replace("0.97 mPa s", "0.97 Pa s").replace("30 rpm", "0.1 rpm")
    return Model(text)


def imported(path: Path) -> ModuleType:
    """A module that was exported."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def exported(example: str, to: str, path: Path, order: int) -> ModuleType:
    model_of(example).export(to, path, order=order)
    return imported(path)


@pytest.mark.parametrize("order", [1, 3, 5])
@pytest.mark.parametrize("example", BODIES)
def test_the_module_of_python_is_the_library(example: str, order: int, tmp_path: Path) -> None:
    body = exported(example, "python", tmp_path / "body.py", order)
    reduced = model_of(example).reduce(order)
    assert body.self_test() < 1e-12
    momenta = body.TESTS[:, :3]
    found = [body.motion(K)[:2] for K in momenta]
    for mine, theirs in zip(
        (np.array([pair[0] for pair in found]), np.array([pair[1] for pair in found])),
        (reduced.angular_velocity(momenta), reduced.momentum_rate(momenta)),
        strict=True,
    ):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max())


def test_runs_and_steps_are_the_history_of_simulate(tmp_path: Path) -> None:
    model = model_of("three-masses")
    body = exported("three-masses", "python", tmp_path / "body.py", 3)
    history = model.simulate(times=[0.0, 10.0], order=3, tolerance=1e-12)
    end = solve_ivp(lambda _, y: body.rates(y), [0, 10], body.START, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    y = body.START
    for _ in range(2000):
        y = body.step(y, np.zeros(3), 0.005)
    wanted = [history[name][-1] for name in ("wx", "wy", "wz")]
    for state in (end, y):
        np.testing.assert_allclose(body.motion(state[:3])[0], wanted, rtol=0, atol=1e-9)
    assert abs(np.linalg.norm(y[:3]) / np.linalg.norm(body.START[:3]) - 1) < 1e-12
    assert body.status(y) == body.HOLDS and body.status(50 * y) == body.FAILS and body.status(np.nan * y) == body.NOT_FINITE
    np.testing.assert_allclose(body.momentum_of(body.motion(y[:3])[0]), y[:3], rtol=1e-11)


def test_under_a_torque_the_energy_gains_the_work(tmp_path: Path) -> None:
    body = exported("friction-wheel", "python", tmp_path / "body.py", 3)
    torque = np.array([0.02, -0.01, 0.03])

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        omega, _, power = body.motion(y[:3], torque)
        return np.array([*body.rates(y[:7], torque), omega @ torque - power])

    run = solve_ivp(rates, [0, 20], [*body.START, 0.0], method="DOP853", rtol=1e-12, atol=1e-13)
    gained = body.energy(run.y[:3, -1]) - body.energy(body.START[:3])
    assert gained == pytest.approx(run.y[7, -1], rel=1e-9)


@pytest.mark.parametrize("order", [1, 3, 5])
def test_sympy_has_the_same_equations(order: int, tmp_path: Path) -> None:
    pytest.importorskip("sympy")
    assert exported("friction-wheel", "sympy", tmp_path / "body.py", order).self_test() < 1e-12


@pytest.mark.parametrize("order", [1, 3, 5])
def test_heyoka_has_the_same_equations(order: int, tmp_path: Path) -> None:
    heyoka = pytest.importorskip("heyoka")
    body = exported("friction-wheel", "heyoka", tmp_path / "body.py", order)
    assert body.self_test() < 1e-12
    if order == 3:
        taylor = heyoka.taylor_adaptive(body.SYSTEM, body.START, pars=[0.0, 0.0, 0.0])
        taylor.propagate_until(20.0)
        numpy = exported("friction-wheel", "python", tmp_path / "numpy_body.py", order)
        run = solve_ivp(lambda _, y: numpy.rates(y), [0, 20], numpy.START, method="DOP853", rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(taylor.state, run.y[:, -1], rtol=0, atol=1e-9)


@pytest.mark.parametrize("order", [1, 3, 5])
def test_modelica_has_the_same_equations(order: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pymoca")
    casadi = pytest.importorskip("casadi")
    from pymoca.backends.casadi.api import transfer_model

    monkeypatch.setattr(casadi.MX, "__div__", casadi.MX.__truediv__, raising=False)  # pymoca asks for the operator of Python 2
    body = exported("friction-wheel", "python", tmp_path / "numpy_body.py", order)
    model = model_of("friction-wheel")
    model.export("modelica", tmp_path / "Wheel.mo", order=order)
    read = transfer_model(str(tmp_path), "Wheel", {"expand_vectors": True})
    names = [state.symbol.name() for state in read.states]
    assert names == [f"K[{i}]" for i in (1, 2, 3)] + [f"q[{i}]" for i in (1, 2, 3, 4)]
    known = [*read.states, *read.inputs, *read.parameters]
    sought = [*read.alg_states, *read.der_states]
    problem = {
        "x": casadi.vertcat(*(variable.symbol for variable in sought)),
        "p": casadi.vertcat(*(variable.symbol for variable in known)),
        "g": casadi.vertcat(*read.equations),
    }
    solve = casadi.rootfinder("solve", "newton", problem, {"abstol": 1e-13})
    numbers = [float(parameter.value) for parameter in read.parameters]
    for row in body.TESTS:
        state = [*row[:3], *body.START[3:]]
        values = np.array(solve(np.full(len(sought), 0.1), [*state, *row[3:6], *numbers])).ravel()
        found = dict(zip((variable.symbol.name() for variable in sought), values, strict=True))
        wanted = body.rates(np.array(state), row[3:6])
        rates = [found[f"der({name})"] for name in names]
        np.testing.assert_allclose(rates, wanted, rtol=0, atol=1e-11 * np.abs(wanted).max())
        assert found["energy"] == pytest.approx(row[13], rel=1e-11)


def test_what_is_not_exported_is_refused(tmp_path: Path) -> None:
    pushed = model_of("gravity-gradient")
    with pytest.raises(UnsupportedError, match="external forces"):
        pushed.export("python", tmp_path / "body.py")
    model = model_of("three-masses")
    with pytest.raises(InputError, match="there are c, python"):
        model.export("fortran", tmp_path / "body.f90")
    with pytest.raises(InputError, match="name it my_body"):
        model.export("matlab", tmp_path / "my-body.m")
    written = model.export("c", tmp_path / "body")
    assert written.holds and sorted(path.name for path in (tmp_path / "body").iterdir()) == [
        "README.md",
        "body.c",
        "body.h",
        "self-test.c",
    ]
    with pytest.raises(FileError, match="already exists"):
        model.export("c", tmp_path / "body")
    model.export("rust", tmp_path / "body.rs")
    with pytest.raises(FileError, match="already exists"):
        model.export("rust", tmp_path / "body.rs")
    assert model.export("rust", tmp_path / "body.rs", overwrite=True).to_dict()["order"] == 3
