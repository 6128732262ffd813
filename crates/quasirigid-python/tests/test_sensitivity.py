"""Sensitivities and inference: the program's numbers, closed forms, refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import Model

STONE = """
[carrier]
mass = 100.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [10.0, 14.0, 17.0]
[initial]
angular_velocity = [0.15, 0.02, 0.9]
"""


def test_sensitivities_are_those_of_the_program(told: Any) -> None:
    of, key = "modes.nutation.time_constant", "spring.1.stiffness"
    found = Model(quasirigid.EXAMPLE).sensitivity(of, [key])
    program = told("sensitivity", "boom-satellite", "--of", of, "--with", key)
    assert found.derivatives == program["derivatives"] and found.value == program["value"]
    assert found.holds and set(found.relative) == {key}


def test_quantities_and_keys_that_do_not_exist_are_refused() -> None:
    model = Model(quasirigid.EXAMPLE)
    with pytest.raises(quasirigid.InputError, match="begins with a command"):
        model.sensitivity("T1")
    with pytest.raises(quasirigid.InputError, match="a list of paths"):
        model.sensitivity("check.T1", "carrier.mass")
    with pytest.raises(quasirigid.Error, match="is no number of the model"):
        model.sensitivity("check.T1", ["carrier.weight"])


def test_a_moment_is_inferred_from_noisy_rates(tmp_path: Path) -> None:
    model = Model(STONE)
    history = model.simulate(system="rigid", times=np.linspace(0, 60, 121))
    random = np.random.default_rng(5)
    table = np.column_stack([history.t, history.angular_velocity + 1e-3 * random.standard_normal((121, 3))])
    path = tmp_path / "measured.csv"
    np.savetxt(path, table, delimiter=",", header="t,wx,wy,wz", comments="")
    found = model.with_({"carrier.inertia.1": 10.4}).infer(path, ["carrier.inertia.1"], sigma=1e-3, system="rigid")
    sigma = np.sqrt(found.covariance[0, 0])
    assert found.holds and abs(found.values["carrier.inertia.1"] - 10) < 4 * sigma < 0.2
    assert found.degrees_of_freedom == 362
    with pytest.raises(quasirigid.FileError, match="cannot be read|not found|is the name right"):
        model.infer(tmp_path / "nothing.csv", ["carrier.mass"])
