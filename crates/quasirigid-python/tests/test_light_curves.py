"""Light curves: the program's numbers, places at times, refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import Model

TOUTATIS = Path(__file__).parents[3] / "examples" / "toutatis" / "model.toml"
SUN, OBSERVER = (1.0, 0.0, 0.0), (0.9, 0.4, 0.1)


def test_curves_are_those_of_the_program(told: Any) -> None:
    found = Model.from_file(TOUTATIS).light_curve(
        sun=SUN, observer=OBSERVER, duration="20 d", samples=41, law="mixed:0.1", albedo=0.13
    )
    places = ["--sun", "1,0,0", "--observer", "0.9,0.4,0.1", "--duration", "20d", "--samples", "41"]
    program = told("lightcurve", "toutatis", *places, "--law", "mixed:0.1", "--albedo", "0.13")
    np.testing.assert_array_equal(found.magnitude, program["magnitude"])
    np.testing.assert_array_equal(found.t, program["t"])
    assert found.holds and found.amplitude == program["amplitude"] and found["t"][-1] == 20 * 86400


def test_places_may_change_in_time() -> None:
    model, times = Model.from_file(TOUTATIS), np.linspace(0, 1e6, 11)
    fixed = model.light_curve(sun=SUN, observer=OBSERVER, times=times)
    moving = np.array(OBSERVER) + np.outer(np.linspace(0, 1, 11), [0.0, -0.8, 0.0])
    found = model.light_curve(sun=SUN, observer=moving, times=times)
    assert found.brightness[0] == pytest.approx(fixed.brightness[0], rel=1e-12)
    assert found.phase_angle[-1] == pytest.approx(np.arctan2(np.hypot(0.4, 0.1), 0.9), rel=1e-12)
    assert abs(found.brightness[5] / fixed.brightness[5] - 1) > 1e-3


def test_curves_that_are_none_are_refused() -> None:
    model = Model.from_file(TOUTATIS)
    with pytest.raises(quasirigid.InputError, match="both sun and observer"):
        model.light_curve(sun=SUN)
    with pytest.raises(quasirigid.InputError, match="11 rows for 3 times"):
        model.light_curve(sun=SUN, observer=np.ones((11, 3)), times=[0, 1, 2])
    with pytest.raises(quasirigid.InputError, match='law = "black"'):
        model.light_curve(sun=SUN, observer=OBSERVER, law="black")
    with pytest.raises(quasirigid.Error, match="surface"):
        Model(quasirigid.EXAMPLE).light_curve(sun=SUN, observer=OBSERVER)
