"""Effective modal masses: the program's numbers, a sheet that comes back as it was given."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import Model

WING = """
[carrier]
mass = 300.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [60.0, 80.0, 90.0]

[[appendage]]
name = "wing"
at = [0.6, 0.0, 0.2]
mass = 22.0
center_of_mass = [2.4, 0.0, 0.0]
inertia = [9.0, 41.0, 50.0]
normal = [0, 0, 1]
modes = [{ frequency = "0.31 Hz", damping_ratio = 0.005, translation = [0, 0, 3.6], rotation = [0, -12.2, 0] }]

[initial]
angular_velocity = [0.0, 0.01, 0.06]
"""


def test_effective_masses_are_those_of_the_program(told: Any) -> None:
    found = Model(quasirigid.EXAMPLE).effective_masses([0.1, -0.2, 0.3])
    program = told("modes", "boom-satellite", "--effective-masses", "--about", "0.1,-0.2,0.3")
    for key in ("cantilever", "delta_t", "delta_r", "free", "parts", "residual_mass", "sentence"):
        assert found.to_dict()[key] == program[key]
    squares = np.cumsum(found.delta_t**2, axis=0)[-1] + found.residual_mass
    np.testing.assert_allclose(squares, program["parts"]["mass"], rtol=1e-12)


def test_a_sheet_comes_back_as_it_was_given() -> None:
    found = Model(WING).effective_masses([0.6, 0.0, 0.2])
    sign = np.sign(found.delta_t[0, 2])
    np.testing.assert_allclose(sign * found.delta_t, [[0, 0, 3.6]], atol=1e-12)
    np.testing.assert_allclose(sign * found.delta_r, [[0, -12.2, 0]], atol=1e-12)
    np.testing.assert_allclose(found.frequencies, [0.31 * 2 * np.pi])
    np.testing.assert_allclose(found.damping_ratios, [0.005])


def test_a_body_without_a_carrier_is_refused() -> None:
    stone = '[[ellipsoid]]\nsemi_axes = [3, 2, 1]\nmaterial = "rock"\n[material.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.25\n'
    with pytest.raises(quasirigid.UnsupportedError, match="no carrier that could be held"):
        Model(stone).effective_masses()
