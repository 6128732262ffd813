"""Populations in arrays: each row is its own model, whatever the rheology; uncertain values are drawn; xarray takes the answers."""

import numpy as np
import pytest

import quasirigid

MODEL = """
[material.rock]
density = 2000
shear = 5e8
poisson = 0.25
rheology = {rheology}
[[ellipsoid]]
semi_axes = [300, 200, 150]
material = "rock"
[initial]
periods = {{ rotation = "20 h", precession = "4 h", mode = "short-axis" }}
[run]
evolve = {{ until = "5 deg" }}
"""

RHEOLOGIES = {
    "quality-factor": '{ kind = "quality-factor", Q = 100 }',
    "maxwell": '{ kind = "maxwell", time = "1e7 s" }',
    "andrade": '{ kind = "andrade", time = "1e8 s" }',
}


@pytest.mark.parametrize("kind", RHEOLOGIES)
def test_rows_are_their_own_models(kind):
    model = quasirigid.Model(MODEL.format(rheology=RHEOLOGIES[kind]))
    rotation, shear = [20.0, 24.0, 30.0], 6e8
    found = quasirigid.evolve_population(
        model,
        {"initial.periods.rotation": rotation, "material.rock.shear": shear},
        units={"initial.periods.rotation": "h"},
    )
    assert found.time.shape == (3,)
    for row, period in enumerate(rotation):
        alone = model.with_({"initial.periods.rotation": f"{period} h", "material.rock.shear": shear}).evolve()
        assert found.holds[row] == alone.holds
        if alone.holds:
            # a study asks for fewer rows of the evolution, whose sums then differ in the last digit
            assert found.time[row] == pytest.approx(alone.time, rel=1e-13)
    assert found["initial.periods.rotation"].tolist() == rotation


def test_uncertain_values_are_drawn():
    model = quasirigid.Model(MODEL.format(rheology=RHEOLOGIES["quality-factor"]))
    key = "material.rock.density"
    found = quasirigid.evolve_population(model, {key: [2000.0, 2000.0]}, sigma={key: [0.0, 100.0]}, samples=20)
    assert found.time.shape == (2, 20)
    low, middle, high = found.percentiles("evolve.time").T
    assert low[0] == high[0] == middle[0]
    # the time goes as 1/density: a standard deviation of 5 % is one of 5 % of the time
    assert high[1] / low[1] == pytest.approx(1.05 / 0.95, rel=0.03)
    assert np.std(found[key][1]) == pytest.approx(100, rel=0.1)


def test_rows_without_a_value_have_a_reason():
    model = quasirigid.Model(MODEL.format(rheology=RHEOLOGIES["quality-factor"]))
    found = quasirigid.evolve_population(model, {"material.rock.density": [2000.0, np.nan]})
    assert found.holds.tolist() == [True, False] and np.isnan(found.time[1])
    assert found.reasons[0]["count"] == 1 and "nan" in found.reasons[0]["example"]
    assert "1 of 2 rows answered" in repr(found)


def test_xarray_takes_the_answers():
    pytest.importorskip("xarray")
    model = quasirigid.Model(MODEL.format(rheology=RHEOLOGIES["quality-factor"]))
    key = "material.rock.density"
    data = quasirigid.evolve_population(model, {key: [2000.0, 2500.0]}, sigma={key: 50.0}, samples=3).to_xarray()
    assert dict(data.sizes) == {"body": 2, "sample": 3}
    assert data["evolve.time"].attrs["units"] == "s" and key in data.coords


def test_arrays_that_do_not_fit_are_refused():
    model = quasirigid.Model(MODEL.format(rheology=RHEOLOGIES["quality-factor"]))
    key = "material.rock.density"
    with pytest.raises(quasirigid.InputError, match="give one value, or 3"):
        quasirigid.evolve_population(model, {key: [1.0, 2.0], "material.rock.shear": [1e8, 2e8, 3e8]})
    with pytest.raises(quasirigid.InputError, match="sigma has the key"):
        quasirigid.evolve_population(model, {key: [1.0]}, sigma={"other": 1.0}, samples=2)
