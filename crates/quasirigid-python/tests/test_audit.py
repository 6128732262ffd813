"""Audits of histories: the numbers of the program, arguments, exceptions."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import EXAMPLES, program

import quasirigid

HISTORY = EXAMPLES / "invented-damping" / "euler.csv"
MOMENTS = [10.0, 14.0, 17.0]


def test_the_answer_is_that_of_the_program() -> None:
    call = [str(program()), "audit", str(HISTORY), "--inertia", "10,14,17", "--json"]
    told = json.loads(subprocess.run(call, capture_output=True, text=True, check=True).stdout)
    found = quasirigid.audit(HISTORY, inertia=MOMENTS)
    assert {key: value for key, value in found.to_dict().items() if key != "badge"} == told
    assert found.holds and found.sentence == told["sentence"]
    assert found.invented_time_constant == pytest.approx(-6850, rel=0.02)
    assert found.worst_interval == tuple(told["worst_interval"])


def test_an_inertia_is_moments_entries_or_a_matrix() -> None:
    matrix = np.diag(MOMENTS)
    sentences = {quasirigid.audit(HISTORY, inertia=given).sentence for given in (MOMENTS, [*MOMENTS, 0, 0, 0], matrix)}
    assert len(sentences) == 1
    matrix[0, 1] = 1.0
    for given, words in [(matrix, "not symmetric"), ([1, 2], "three moments"), ([1, 2, 4], "exceed the sum"), ("x", "give three moments")]:
        with pytest.raises(quasirigid.InputError, match=words):
            quasirigid.audit(HISTORY, inertia=given)  # type: ignore[arg-type]


def test_limits_make_an_answer_false() -> None:
    assert quasirigid.audit(HISTORY, inertia=MOMENTS, min_time_constant="1 h").within_limits
    refused = quasirigid.audit(HISTORY, inertia=MOMENTS, limit=1e-6)
    assert not refused and refused.within_limits is False
    for limit in (0, -1.0, float("inf")):
        with pytest.raises(quasirigid.InputError, match="limit"):
            quasirigid.audit(HISTORY, inertia=MOMENTS, limit=limit)


def test_a_model_stands_in_place_of_an_inertia(tmp_path: Path) -> None:
    body = "[carrier]\nmass = 1.0\ncenter_of_mass = [0, 0, 0]\ninertia = [10, 14, 17]\n"
    model = quasirigid.Model(body)
    found = quasirigid.audit([HISTORY], model)
    assert found.explained == 0.0
    with pytest.raises(quasirigid.InputError, match="twice"):
        quasirigid.audit(HISTORY, model, inertia=MOMENTS)
    with pytest.raises(quasirigid.InputError, match="not given"):
        quasirigid.audit(HISTORY)
    bad = tmp_path / "bad.csv"
    bad.write_text("t,wx,wy,wz\n0,0,0,nan\n")
    with pytest.raises(quasirigid.FileError, match="bad.csv:2"):
        quasirigid.audit(bad, inertia=MOMENTS)
