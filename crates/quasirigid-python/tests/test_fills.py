"""Maps over fill and spin: the program's numbers, arrays, refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import Model

TWO_TANKS = Path(__file__).parents[3] / "examples" / "two-tanks" / "model.toml"


def test_maps_are_those_of_the_program(told: Any) -> None:
    found = Model.from_file(TWO_TANKS).fills(fill=(0.3, 0.6), spin=(2.0, 3.0), points=(3, 2))
    program = told("fills", "two-tanks", "--fill", "0.3,0.6", "--spin", "2,3", "--points", "3,2")
    assert found.points == program["points"] and found.worst == program["worst"]
    assert found.time_constants.shape == (2, 3) and np.all(found.time_constants > 0)
    np.testing.assert_allclose(found.fills, [0.3, 0.45, 0.6])
    np.testing.assert_allclose(found.spins, [2.0, 3.0])
    assert not found.holds and found.sentence.startswith("MAY NOT HOLD")


def test_maps_that_are_none_are_refused() -> None:
    model = Model.from_file(TWO_TANKS)
    with pytest.raises(quasirigid.Error, match="fills from 0"):
        model.fills(fill=(0.0, 0.5))
    with pytest.raises(quasirigid.Error, match="there is no"):
        model.fills(["oil"])
    with pytest.raises(quasirigid.InputError, match="a list of names"):
        model.fills("tank +x")
