"""The reduced equations: two derivations of each value."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES

import quasirigid
from quasirigid import Model

OMEGA = np.random.default_rng(7).normal(size=(4, 5, 3))


@pytest.mark.parametrize("example", ["boom-satellite", "three-masses", "friction-wheel", "nutation-damper"])
def test_values_are_the_sums_of_the_coefficients(example: str) -> None:
    reduced = Model.from_file(EXAMPLES / example / "model.toml").reduce(3)
    for of in ("torque", "angular_momentum", "rate", "power", "energy"):
        values = getattr(reduced, of)(OMEGA)
        total = np.zeros((*OMEGA.shape[:-1], 3 if values.ndim == OMEGA.ndim else 1))
        for part in reduced.coefficients(of):
            monomials = np.prod(OMEGA[..., None, :] ** part.exponents, axis=-1)
            total += monomials @ part.values
        np.testing.assert_allclose(values, total.reshape(values.shape), rtol=1e-10, atol=1e-10 * np.abs(total).max())


def test_balances() -> None:
    """Energy falls by the power dissipated, and K is kept in inertial axes: gradients by SymPy, values by the extension."""
    reduced = Model(quasirigid.EXAMPLE).reduce(3)
    sympy = pytest.importorskip("sympy")
    equations = reduced.to_sympy()
    flux = -sum(
        sympy.diff(equations.energy, w) * rate for w, rate in zip(equations.omega, equations.rate, strict=True)
    )
    at = dict(zip(equations.omega, (0.03, -0.02, 0.05), strict=True))
    # Elastic power begins at degree 6, where the balance is exact; what is cut off is of degree 8.
    assert float(flux.subs(at)) == pytest.approx(float(reduced.power(list(at.values()))), rel=0.05)
    omega = sympy.Matrix(equations.omega)
    moment = reduced.inertia @ np.array(list(at.values()))
    torque = reduced.inertia @ reduced.rate(list(at.values())) + np.cross(list(at.values()), moment)
    np.testing.assert_allclose(torque, reduced.torque(list(at.values())), atol=1e-15)
    expressed = equations.torque.subs(at)
    np.testing.assert_allclose(np.array(expressed, dtype=float)[:, 0], reduced.torque(list(at.values())), rtol=1e-12)
    assert omega.shape == (3, 1)


def test_the_energy_form_keeps_its_laws() -> None:
    """By its rate |K| stays and the energy falls, at spins far outside the range too; the rate is that of the exported polynomials."""
    reduced = Model(quasirigid.EXAMPLE).reduce(4)
    terms = reduced.to_dict()

    def at(name: str, K: Any) -> Any:
        return sum(np.prod(np.array(K) ** term["exponents"]) * np.array(term["value"]) for term in terms[name])

    def slope(K: Any, axis: int) -> Any:
        step = 1e-6 * np.linalg.norm(K) * np.eye(3)[axis]
        return (at("energy_of_momentum", K + step) - at("energy_of_momentum", K - step)).item() / (2e-6 * np.linalg.norm(K))

    for K in np.array([[0.3, -0.2, 0.5], [30.0, -20.0, 50.0]]):
        rate, omega = reduced.momentum_rate(K), reduced.angular_velocity(K)
        np.testing.assert_allclose(np.cross(K, omega), rate, atol=1e-12 * np.linalg.norm(rate))
        gradient = np.array([slope(K, axis) for axis in range(3)])
        v = np.cross(K, gradient)
        xx, yy, zz, yz, zx, xy = at("T", K)
        T = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])
        cofactors = np.array([np.cross(T[1], T[2]), np.cross(T[2], T[0]), np.cross(T[0], T[1])])
        a = 1 + K @ at("c", K)
        expected = (a * v + np.cross(K, T @ v)) / (a * a + K @ cofactors @ K)
        np.testing.assert_allclose(rate, expected, atol=1e-8 * np.linalg.norm(rate))
        assert gradient @ rate <= 0
        assert gradient @ rate == pytest.approx(-rate @ T @ rate, abs=1e-8 * np.linalg.norm(gradient) * np.linalg.norm(rate))


def test_shapes_and_kinds_of_arrays() -> None:
    reduced = Model(quasirigid.EXAMPLE).reduce()
    one = reduced.torque(OMEGA[0, 0])
    assert one.shape == (3,) and reduced.power(OMEGA[0, 0]).shape == ()
    np.testing.assert_array_equal(reduced.torque(OMEGA)[0, 0], one)
    for other in (OMEGA.tolist(), np.asfortranarray(OMEGA), OMEGA[::-1][::-1], OMEGA.astype(">f8")):
        np.testing.assert_array_equal(reduced.torque(other), reduced.torque(OMEGA))
    assert reduced.torque(np.zeros((0, 3))).shape == (0, 3)
    np.testing.assert_array_equal(reduced.torque([1, 2, 3]), reduced.torque([1.0, 2.0, 3.0]))
    np.testing.assert_array_equal(reduced.torque(OMEGA[..., [2, 1, 0]][..., ::-1]), reduced.torque(OMEGA))
    assert np.isnan(reduced.torque([np.nan, 0, 1])).any()


def test_inertia_is_that_of_the_program() -> None:
    wheel = Model(quasirigid.EXAMPLE + '[[wheel]]\nname = "w"\naxis = [3, 0, 4]\nmomentum = 7.0\n').reduce()
    np.testing.assert_array_equal(wheel.inertia, wheel.to_dict()["inertia"])
    np.testing.assert_allclose(wheel.angular_momentum([0.0, 0.0, 0.0]), [4.2, 0.0, 5.6])
    reduced = Model(quasirigid.EXAMPLE).reduce()
    np.testing.assert_array_equal(reduced.inertia, reduced.to_dict()["inertia"])
    assert reduced.mass == reduced.to_dict()["mass"] == 50.0
    assert r"\begin" in reduced.to_latex() and "order 3" in str(reduced)
