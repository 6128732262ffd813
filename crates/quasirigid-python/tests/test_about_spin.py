"""Reduced equations about a spin are the program's, and follow the full system."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES

import quasirigid
from quasirigid import Model


def model(example: str) -> Model:
    return Model.from_file(EXAMPLES / example / "model.toml")


@pytest.mark.parametrize(
    ("example", "options", "settings"),
    [
        ("explorer1", ["--degree", "9"], {"degree": 9}),
        ("explorer1", [], {}),
        ("nutation-damper", ["--masters", "nutation", "--degree", "3"], {"masters": "nutation", "degree": 3}),
        ("nutation-damper", ["--style", "graph", "--degree", "3"], {"style": "graph", "degree": 3}),
        ("explorer1", ["--axis", "greatest"], {"axis": "greatest"}),
    ],
)
def test_they_are_those_of_the_program(
    told: Any, example: str, options: list[str], settings: dict[str, Any]
) -> None:
    about = model(example).about_spin(**settings)
    object = told("derive", example, "--about", "spin", *options)
    assert about.to_dict() == object
    assert (about.holds, about.sentence) == (object["holds"], object["sentence"])
    assert bool(about) == about.holds and about.degree == object["degree"]
    backbone = about.backbone
    for name in ["amplitude", "nutation", "decay_rate", "frequency", "power"]:
        np.testing.assert_array_equal(backbone[name], [point[name] for point in object["backbone"]])


def test_one_that_does_not_hold_says_so_first() -> None:
    about = model("explorer1").about_spin(degree=3)
    assert not about and repr(about).startswith("DOES NOT HOLD: The reduced equations about the spin DO NOT HOLD")
    with pytest.raises(quasirigid.Refused, match="its nutation is 23.9 degrees"):
        about.require()
    assert about.start is not None and not about.start["within"]


def test_coefficients_give_the_backbone() -> None:
    about = model("explorer1").about_spin(degree=9)
    exponents, values = about.coefficients()
    rho = about.backbone["amplitude"][1:]
    rate = (values * rho[:, None] ** (exponents.sum(axis=1) - 1)).sum(axis=1)
    np.testing.assert_allclose(-rate.real, about.backbone["decay_rate"][1:], rtol=1e-8)
    np.testing.assert_allclose(rate.imag, about.backbone["frequency"][1:], rtol=1e-12)


def test_a_history_is_that_of_the_program_and_of_the_full_system(told: Any) -> None:
    about = model("explorer1").about_spin(degree=9)
    history = about.simulate(times=[0, 2, 5], displacements=True)
    object = told("simulate", "explorer1", "--system", "spin-manifold", "--degree", "9", "--times", "0,2,5")
    assert history.to_dict() == object and history.holds and history.system == "manifold"
    direct = model("explorer1").simulate("spin-manifold", degree=9, times=[0, 2, 5])
    np.testing.assert_array_equal(direct.energy, history.energy)
    full = model("explorer1").simulate("full", times=[0, 2, 5])
    # 0.6 % of the energy beyond the steady spin are vibrations at the start
    np.testing.assert_allclose(history.energy, full.energy, rtol=2e-3)
    assert any(name.startswith("whip +x") for name in history.table)


def test_a_history_that_leaves_the_range_does_not_hold() -> None:
    history = model("explorer1").about_spin(degree=9).simulate(times=[0, 40])
    assert not history and history.status == "left-validity"
    assert history.sentence.startswith("The history LEFT THE RANGE")


def test_an_answer_is_pickled() -> None:
    about = model("explorer1").about_spin(degree=5)
    again = pickle.loads(pickle.dumps(about))
    assert again.to_dict() == about.to_dict()
    np.testing.assert_array_equal(again.backbone["frequency"], about.backbone["frequency"])
    assert again.simulate(times=[0, 1]).energy.shape == (2,)


def test_what_has_no_equations_is_refused_by_kind() -> None:
    with pytest.raises(quasirigid.UnsupportedError, match="no equations of motion of its own"):
        model("apophis").about_spin()
    with pytest.raises(quasirigid.UnsupportedError, match="without external forces"):
        model("gravity-gradient").about_spin()
    explorer = model("explorer1")
    cases: list[tuple[dict[str, Any], str]] = [
        ({"degree": 12}, "1 to 11"),
        ({"axis": "middle"}, "least or greatest"),
        ({"masters": [1e3]}, "no mode about this spin"),
        ({"masters": "everything"}, "names no masters"),
        ({"style": "modern"}, "modern"),
    ]
    for settings, message in cases:
        with pytest.raises(quasirigid.InputError, match=message):
            explorer.about_spin(**settings)
    with pytest.raises(quasirigid.InputError, match="spin-manifold"):
        explorer.simulate("full", degree=5, duration=1)
    with pytest.raises(quasirigid.InputError, match="does not circle"):
        explorer.about_spin(axis="greatest").simulate(duration=1)
