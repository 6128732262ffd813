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


FREQUENCY = "modes.nutation.frequency"
SPUN = STONE.replace("[0.15, 0.02, 0.9]", "[0, 0, 0.9]")


def frequency(a: float) -> float:
    """Frequency of the nutation of the stone with this moment (rad/s): ω √((C−A)(C−B)/AB)."""
    return 0.9 * float(np.sqrt((17 - a) * 3 / (a * 14)))


def test_a_moment_is_inferred_from_a_frequency_and_a_prior() -> None:
    key = "carrier.inertia.1"
    measured = {FREQUENCY: f"{frequency(10.5)} rad/s +- 1e-3 rad/s"}
    alone = Model(SPUN).infer(vary=[key], measured=measured)
    sigma = np.sqrt(alone.covariance[0, 0])
    assert alone.holds and abs(alone.values[key] - 10.5) < 1e-6
    assert alone.measured[0]["fitted"] == pytest.approx(frequency(10.5), rel=1e-9)
    both = Model(SPUN).infer(vary=[key], measured=measured, prior={key: f"10.5 +- {sigma}"}, range={key: "9..12"})
    assert np.sqrt(both.covariance[0, 0]) == pytest.approx(sigma / np.sqrt(2), rel=1e-4)
    held = Model(SPUN).infer(vary=[key], measured=measured, range={key: "..10.2"}, profile="all")
    assert held.parameters[0]["at_bound"] == "high" and held.parameters[0]["sigma"] is None


def test_mistakes_in_inferences_are_refused() -> None:
    model = Model(SPUN)
    with pytest.raises(quasirigid.InputError, match="has no deviation"):
        model.infer(vary=["carrier.mass"], measured={"check.T1": "3 s"})
    with pytest.raises(quasirigid.InputError, match='loss = "cauchy" is not one of'):
        model.infer(vary=["carrier.mass"], measured={"check.T1": "3 s +- 1 s"}, loss="cauchy")
    with pytest.raises(quasirigid.Error, match="nothing is measured"):
        model.infer(vary=["carrier.inertia.1"])


def test_plans_are_ranked() -> None:
    sensors = ["wx +- 1e-4 rad/s", "wz +- 1e-4 rad/s"]
    manoeuvre = "initial.angular_velocity = [0.3, 0, 0.9]"
    found = Model(STONE).design(["carrier.inertia.1"], sensors, [manoeuvre], duration="60 s", system="rigid")
    assert found.holds and found.plans[0]["manoeuvre"] == manoeuvre and found.plans[0]["complete"]
    assert len(found.plans) == 6 and found.keys[0]["value"] == 10
    with pytest.raises(quasirigid.InputError, match="give a list"):
        Model(STONE).design(["carrier.inertia.1"], "wx +- 1e-4 rad/s")
