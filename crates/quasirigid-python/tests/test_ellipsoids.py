"""Populations of ellipsoids: rows are the evolutions of their models, refusals have their reasons."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import InputError, Model, evolve_ellipsoids

ROCK: dict[str, Any] = {"density": 2000.0, "shear": 5e8, "quality_factor": 100.0, "spin": 6e-5, "nutation": 1.0, "until_nutation": 0.1}
AXES = [170.0, 130.0, 100.0]


def model(axes: list[float], poisson: float, shear: float, loss: str, nutation: float, until: float, spin: float) -> Model:
    """The same ellipsoid as a model file, which turns about an axis ``nutation`` from that of greatest inertia, towards the middle one."""
    a, b, c = axes
    mass = 4 / 3 * np.pi * a * b * c * 2000
    middle, greatest = mass * (a * a + c * c) / 5, mass * (a * a + b * b) / 5
    momentum = greatest * spin
    omega = [0.0, float(momentum * np.sin(nutation) / middle), float(momentum * np.cos(nutation) / greatest)]
    return Model(
        f"""
        [material.rock]
        density = 2000
        shear = {shear}
        poisson = {poisson}
        {loss}
        [[ellipsoid]]
        name = "rock"
        semi_axes = {axes}
        material = "rock"
        [initial]
        angular_velocity = {omega}
        [run]
        evolve = {{ until = "{until} rad" }}
        """
    )


def test_rows_are_the_evolutions_of_their_models() -> None:
    starts = np.array([1.2, 0.5, 0.05])
    rows = evolve_ellipsoids(AXES, **{**ROCK, "nutation": starts, "until_nutation": starts / 4, "poisson": [0.2, 0.3, 0.4]})
    assert rows.holds.all() and rows.message == ["the end was reached"] * 3 and (rows.error < 1e-6).all()
    for i, (start, poisson) in enumerate(zip(starts, (0.2, 0.3, 0.4), strict=True)):
        one = model(AXES, poisson, 5e8, 'rheology = { kind = "quality-factor", Q = 100 }', start, start / 4, 6e-5).evolve()
        assert one.time == pytest.approx(rows.time[i], rel=1e-6) and one.turns == pytest.approx(rows.turns[i], rel=1e-6)
        assert one.power == pytest.approx(rows.power[i], rel=1e-6)


def test_numbers_are_broadcast_and_blocks_change_no_bit() -> None:
    shear = np.geomspace(1e8, 1e10, 2500)
    rows = evolve_ellipsoids(AXES, **{**ROCK, "shear": shear})
    np.testing.assert_allclose(rows.time, rows.time[0] * shear / shear[0], rtol=1e-9)
    for part in (slice(0, 1), slice(1020, 1030), slice(None, None, 100)):
        again = evolve_ellipsoids(AXES, **{**ROCK, "shear": shear[part]})
        np.testing.assert_array_equal(again.time, rows.time[part])
    exact = evolve_ellipsoids([AXES] * 2500, **{**ROCK, "shear": shear}, reproducible=True)
    np.testing.assert_allclose(exact.time, rows.time, rtol=1e-12)


def test_rows_that_do_not_hold_have_their_reason() -> None:
    given = {name: value for name, value in ROCK.items() if name != "nutation"}
    rows = evolve_ellipsoids(
        [AXES, AXES, [1.0, 1.0, 2.0], [1.0, np.nan, 2.0], AXES], **{**given, "shear": [5e8, 1e-3, 5e8, 5e8, 5e8], "ratio": [0.9, 0.9, 0.9, 0.9, 0.1]}
    )
    assert rows.holds.tolist() == [True, False, False, False, False] and np.isnan(rows.time[1:]).all() and not rows
    assert "does not hold" in rows.message[1] and "greatest inertia" in rows.message[2] and "NaN" in rows.message[3]
    assert "is not a rotation state" in rows.message[4] and rows.status == ["finished"] + 4 * ["refused"]
    assert "1 of 5 rows hold; DO NOT HOLD" in repr(rows)


def test_reasons_that_differ_in_their_numbers_are_one() -> None:
    """Of a thousand bodies each had its own reason."""
    rows = evolve_ellipsoids(AXES, **{**ROCK, "shear": [-1.0, -2e8, np.nan, 5e8]})
    assert len(set(rows.message[:3])) == 3, rows.message
    held, *reasons = rows.sentence.splitlines()
    assert "1 of 4 rows hold" in held and len(reasons) == 2, reasons
    assert reasons[0].startswith("  2 rows: the shear modulus is #;") and f"such as: {rows.message[0]}" in reasons[0]
    assert reasons[1] == f"  1 rows: {rows.message[2]}"


def test_arguments_are_told_by_their_names() -> None:
    for change, message in [
        ({"nutation": None}, "nutation and ratio, not neither"),
        ({"ratio": 0.9}, "not both"),
        ({"shear": [1e8, 1e9]}, None),
        ({"density": [1.0, 2.0], "shear": [1.0, 2.0, 3.0]}, "density has the shape"),
        ({"spin": "fast"}, "spin has the type"),
        ({"poisson": [[0.1]]}, "poisson has the shape"),
    ]:
        if message is None:
            assert len(evolve_ellipsoids(AXES, **{**ROCK, **change})) == 2
            continue
        with pytest.raises(InputError, match=message):
            evolve_ellipsoids(AXES, **{**ROCK, **change})
    with pytest.raises(InputError, match="semi_axes"):
        evolve_ellipsoids([1.0, 2.0], **ROCK)
    with pytest.raises(InputError, match="semi_axes has 2 rows"):
        evolve_ellipsoids([AXES, AXES], **{**ROCK, "shear": [1e8, 1e9, 1e10]})
    assert quasirigid.evolve_ellipsoids.__module__ == "quasirigid"
