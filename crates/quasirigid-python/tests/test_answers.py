"""Answers are the program's, number by number, and say first whether they hold."""

from __future__ import annotations

import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, QUICK

import quasirigid
from quasirigid import Model


def model(example: str) -> Model:
    return Model.from_file(EXAMPLES / example / "model.toml")


@pytest.mark.parametrize("example", QUICK)
def test_check_and_modes_are_those_of_the_program(told: Any, example: str) -> None:
    check = model(example).check()
    assert check.to_dict() == told("check", example)
    assert check.valid == check.to_dict()["valid"]
    assert model(example).modes().to_dict() == told("modes", example)


@pytest.mark.parametrize("example", ["three-masses", "nutation-damper"])
def test_reduced_equations_are_those_of_the_program(told: Any, example: str) -> None:
    assert model(example).reduce(4).to_dict() == told("derive", example, "--order", "4")


@pytest.mark.parametrize("system", ["reduced", "rigid", "full"])
def test_a_history_is_that_of_the_program(told: Any, system: str, tmp_path: Path) -> None:
    table = tmp_path / "history.csv"
    options = ["--system", system, "--duration", "1 min", "--samples", "11", "--out", str(table)]
    object = told("simulate", "three-masses", *options)
    history = model("three-masses").simulate(system, duration="1 min", samples=11)
    assert history.to_dict() == object and history.holds
    written = np.genfromtxt(table, delimiter=",", names=True)
    assert list(written.dtype.names) == list(history.table)
    for name in history.table:
        np.testing.assert_array_equal(written[name], history.table[name])
    np.testing.assert_array_equal(history.angular_velocity[:, 2], written["wz"])


@pytest.mark.parametrize("example", ["boom-satellite", "duende", "three-masses", "explorer1"])
def test_an_evolution_is_that_of_the_program(told: Any, example: str) -> None:
    evolution = model(example).evolve()
    object = told("evolve", example)
    assert evolution.to_dict() == object
    if evolution.time is not None and math.isfinite(evolution.time):
        assert evolution.time == object["time"]
    assert evolution.holds == (object["status"] == "finished")


def test_a_verification_is_that_of_the_program(told: Any) -> None:
    verification = model("three-masses").verify(orders=[2, 3], revolutions=1, halvings=2)
    options = ["--orders", "2,3", "--revolutions", "1", "--halvings", "2"]
    assert verification.to_dict() == told("verify", "three-masses", *options)
    assert verification.sentence == "Every order is reached."


def test_citations_are_those_of_the_program(told: Any) -> None:
    entries = quasirigid.cite(model("apophis"))
    assert entries == told("cite", "apophis")["bibtex"]
    assert entries.startswith("@article{chernousko1978,") and "breiter2012" in entries


def test_an_answer_that_does_not_hold_is_no_number() -> None:
    """Explorer 1 spins twelve times as fast as its whips vibrate: the reduced equations say nothing about it."""
    explorer = model("explorer1")
    check = explorer.check()
    assert not check and repr(check).startswith("DOES NOT HOLD: The reduced equations DO NOT HOLD")
    with pytest.raises(quasirigid.Refused, match="DO NOT HOLD"):
        check.require()
    with pytest.raises(quasirigid.PropagationError):
        explorer.simulate(duration=1, samples=3)
    fast = Model(quasirigid.EXAMPLE.replace("11.88 rpm", "50 rpm"))
    history = fast.simulate(duration=1, samples=3)
    assert not history and any("DO NOT HOLD" in note for note in history.notes)
    assert "DO NOT HOLD" in repr(history) and "DO NOT HOLD" in history._repr_html_()


# Booms as soft as these follow no average, and an average asked for by name is told not to hold.
SOFT = quasirigid.EXAMPLE.replace("stiffness = 500.0", "stiffness = 5.0")


def test_a_refused_evolution_has_no_time() -> None:
    evolution = Model(SOFT).evolve(method="average")
    assert not evolution.holds
    assert evolution.status in ("refused", "does-not-hold")
    assert evolution.time is None and evolution.turns is None and evolution.power is None
    assert repr(evolution).startswith(f"DOES NOT HOLD: {evolution.sentence}")
    assert evolution.to_dict()["sentence"] not in repr(evolution)
    with pytest.raises(quasirigid.Refused):
        evolution.plot()
    rows = Model(SOFT).evolve(initial=[[-0.168, 1.244, -0.05]], method="average")
    assert not rows and np.isnan(rows.time).all() and rows.message[0]


def test_a_run_is_written_once(tmp_path: Path, told: Any) -> None:
    folder = tmp_path / "run"
    run = model("three-masses").run(folder, samples=21)
    object = told("run", "three-masses", "--samples", "21", "-o", str(tmp_path / "program"))
    ours = run.to_dict()
    assert ours == object
    for name in ("record.json", "reduced.json", "report.html", "history-reduced.csv"):
        assert (folder / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name
    with pytest.raises(quasirigid.FileError, match="already"):
        model("three-masses").run(folder)
    run.report(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_bytes() == (folder / "report.html").read_bytes()
    with pytest.raises(quasirigid.FileError, match="create the folder above"):
        run.write(tmp_path / "no" / "such")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["page.html", "program", "run"]


def test_a_run_has_its_tables_in_the_formats_asked_for(tmp_path: Path) -> None:
    body = model("three-masses")
    asked = [("parquet", ["parquet"]), ("csv,npz", ["csv", "npz"]), (["npz", "csv"], ["csv", "npz"])]
    for number, (formats, endings) in enumerate(asked):
        folder = tmp_path / f"run-{number}"
        run = body.run(folder, samples=21, tables=formats)
        assert sorted(path.suffix[1:] for path in folder.glob("history-reduced.*")) == endings
        if "npz" in endings:
            np.testing.assert_array_equal(np.load(folder / "history-reduced.npz")["wx"], run.histories["reduced"]["wx"])
    with pytest.raises(quasirigid.InputError, match='"parquet", "csv", "npz"|"csv", "parquet", "npz"'):
        body.run(tmp_path / "other", tables="hdf5")
    with pytest.raises(quasirigid.InputError, match="folder"):
        body.run(tables="csv")
    with pytest.raises(quasirigid.InputError, match="folder"):
        body.run(resume=True)
    assert not (tmp_path / "other").exists()


def test_a_run_that_was_cut_off_goes_on_with_the_same_bits(tmp_path: Path) -> None:
    """Interrupted by its observer once it is on the disk; more rows than memory keeps, so that the histories come from the record."""
    body = model("boom-satellite").with_({"run.systems": ["reduced"]})
    kept = tmp_path / "cut-unfinished"

    def cut(stage: str, share: float) -> bool:
        return not (kept / "history-reduced.checkpoint").exists()

    with pytest.raises(quasirigid.InputError, match="no run here"):
        body.run(tmp_path / "cut", samples=150_001, resume=True)
    with pytest.raises(quasirigid.Interrupted):
        body.run(tmp_path / "cut", samples=150_001, progress=cut)
    assert kept.exists() and not (tmp_path / "cut").exists()
    with pytest.raises(quasirigid.InputError, match="resume=True"):
        body.run(tmp_path / "cut", samples=150_001)
    run = body.run(tmp_path / "cut", samples=150_001, resume=True)
    body.run(tmp_path / "whole", samples=150_001)
    names = {path.name for path in (tmp_path / "whole").iterdir()}
    assert names == {path.name for path in (tmp_path / "cut").iterdir()} and "history-reduced.parquet" in names
    for name in names:
        assert (tmp_path / "cut" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name
    assert not kept.exists() and run.histories["reduced"].rows == 150_001


def test_html_is_escaped() -> None:
    named = Model(quasirigid.EXAMPLE.replace('name = "boom satellite"', 'name = "<script>&"'))
    for shown in (named.check()._repr_html_(), named._repr_html_(), named.reduce()._repr_html_()):
        assert "<script>" not in shown and "&lt;script&gt;&amp;" in shown


def test_answers_are_pickled() -> None:
    boom = Model(quasirigid.EXAMPLE)
    for answer in (boom.check(), boom.simulate(duration=60, samples=7), boom.evolve(until="10 deg")):
        copy = pickle.loads(pickle.dumps(answer))
        assert repr(copy) == repr(answer) and copy.to_dict() == answer.to_dict()
        if hasattr(answer, "table"):
            np.testing.assert_array_equal(copy.table["t"], answer.table["t"])
    many = boom.evolve(initial=[[0.1, 1.2, 0.0]])
    assert pickle.loads(pickle.dumps(many)).time.tolist() == many.time.tolist()
    histories = boom.simulate(initial=[[0.1, 1.2, 0.0]], duration=60, samples=3)
    assert pickle.loads(pickle.dumps(histories)).energy.tolist() == histories.energy.tolist()
    reduced = boom.reduce(4)
    assert pickle.loads(pickle.dumps(reduced)).torque([0, 0, 1]).tolist() == reduced.torque([0, 0, 1]).tolist()
    with pytest.raises(TypeError, match="write"):
        pickle.dumps(boom.run(duration=10, samples=2))


def test_an_unstable_spin_is_refused_where_a_stable_one_is_required() -> None:
    found = Model(quasirigid.EXAMPLE)
    stable, unstable = found.modes(axis="greatest"), found.modes(axis="least")
    assert stable.require_stable() is stable and stable["nutation"] == stable.modes[0]
    assert unstable.holds and not unstable.stable
    with pytest.raises(quasirigid.Refused, match="UNSTABLE"):
        unstable.require_stable()
    with pytest.raises(KeyError, match="the modes are nutation"):
        stable["wobble"]
    with pytest.raises(quasirigid.InputError, match="axis='greatest'"):
        found.modes("greatest")


ROCK = """
[material.rock]
density = "2 g/cm^3"
shear = "0.5 GPa"
poisson = 0.25
rheology = { kind = "quality-factor", Q = 100 }
[[ellipsoid]]
semi_axes = [219.0, 151.0, 143.0]
material = "rock"
[initial]
wobble = { angle = "20 deg", rate = "1 rpm", mode = "short-axis" }
[run]
evolve = { until = "5 deg" }
"""


def test_the_uncertainty_of_an_evolution_is_in_its_answer() -> None:
    """The time is proportional to Q: its interval is that of Q, to one of 64 intervals of equal probability."""
    uncertain = Model(ROCK + '[uncertainty]\n"material.rock.rheology.Q" = { log-normal = { median = 100, decades = 0.5 } }\n')
    plain, drawn = uncertain.evolve(), uncertain.evolve(uncertainty_samples=64)
    assert plain.uncertainty is None and drawn.time == plain.time
    told = "the key in [uncertainty] has its stated value; uncertainty_samples, as 200, draws and gives intervals"
    assert told in plain.notes and told not in drawn.notes
    found = drawn.uncertainty
    assert found is not None and found["answered"] == 64 and found["intervals"][0]["name"] == "time"
    for end, sign in zip(found["intervals"][0]["interval_68"], (-1, 1), strict=True):
        assert math.log10(end / drawn.time) == pytest.approx(sign * 0.5 * 0.994458, abs=0.032)
    with pytest.raises(quasirigid.Error, match=r"has no \[uncertainty\]"):
        Model(ROCK).evolve(uncertainty_samples=9)


def test_one_name_of_two_modes_is_a_question() -> None:
    named = [("nutation", 0.5), ("tip", 6.0), ("tip", 7.0)]
    modes = quasirigid.Modes({"json": {"modes": [{"name": n, "frequency": f, "decay_rate": 0.25} for n, f in named]}})
    assert modes["nutation"]["frequency"] == 0.5
    with pytest.raises(KeyError, match=r"2 modes have the name 'tip'.*modes\[1\] \(frequency 6 rad/s, decay rate 0.25 1/s\)"):
        modes["tip"]
