"""The flexible spin benchmark: its files, both of its solutions, and that a wrong answer fails."""

from __future__ import annotations

import copy
import csv
import importlib
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from conftest import ROOT, program

FOLDER = ROOT / "benchmarks" / "flexible-spin"
FILES = sorted((FOLDER / "problems").glob("*.json"))
NAMES = [json.loads(file.read_text())["name"] for file in FILES]
QUICK = ["rigid-wobble", "separatrix-crossing", "nutation-damper", "two-axis-hinge"]


@pytest.fixture(autouse=True)
def importable(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The folder of the benchmark on the path, and its modules gone afterwards."""
    before, path = set(sys.modules), sys.path.copy()
    monkeypatch.syspath_prepend(str(FOLDER))
    yield
    sys.path[:] = path
    for name in set(sys.modules) - before:
        if str(FOLDER) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]


def modules() -> tuple[ModuleType, ModuleType]:
    return importlib.import_module("solvers"), importlib.import_module("run")


def references(problem: dict[str, Any]) -> dict[str, Any]:
    return {name: quantity["values"] for name, quantity in problem["quantities"].items()}


def test_ten_problems_are_complete() -> None:
    page = (FOLDER / "README.md").read_text()
    assert len(set(NAMES)) == len(FILES) == 10
    for file in FILES:
        told = json.loads(file.read_text())
        assert file.stem[3:] == told["name"]
        assert f"problems/{file.name}" in page
        assert told["title"] and told["tests"] and told["statement"] and told["data"]
        assert told["times"] == sorted(told["times"])
        assert (FOLDER / told["solutions"]["program"]["model"]).exists()
        assert (FOLDER / told["solutions"]["independent"]["script"]).exists()
        for name, quantity in told["quantities"].items():
            values = np.array(quantity["values"], float)
            assert quantity["meaning"] and quantity["unit"], name
            assert 0.0 < quantity["tolerance"] <= 1e-2
            assert np.isfinite(values).all() and np.abs(values).max() > 0.0
            assert not quantity["at_times"] or len(values) == len(told["times"])


@pytest.mark.parametrize("name", NAMES)
def test_full_solver_has_the_references(name: str) -> None:
    solvers, run = modules()
    problem = solvers.problems()[name]
    scores = run.scored(problem, solvers.full_solver(problem, program()))
    assert all(score.passed for score in scores), run.table(scores)


@pytest.mark.parametrize("name", QUICK)
def test_independent_solution_has_the_references(name: str) -> None:
    pytest.importorskip("scipy")
    pytest.importorskip("mpmath")
    solvers, run = modules()
    problem = solvers.problems()[name]
    scores = run.scored(problem, solvers.independent(problem))
    assert all(score.passed for score in scores), run.table(scores)


def test_every_wrong_answer_fails_alone() -> None:
    solvers, run = modules()
    for problem in solvers.problems().values():
        right = references(problem)
        assert all(score.passed for score in run.scored(problem, right))
        for name, quantity in problem["quantities"].items():
            wrong = copy.deepcopy(right)
            for factor, passes in ((0.5, True), (2.0, False)):
                values = np.array(right[name], float)
                worst = np.unravel_index(np.abs(values).argmax(), values.shape)
                values[worst] *= 1.0 + factor * quantity["tolerance"]
                wrong[name] = values.tolist()
                failed = [score.quantity for score in run.scored(problem, wrong) if not score.passed]
                assert failed == ([] if passes else [name])


@pytest.mark.parametrize("given", [None, "much", [], [1.0], [float("nan")] * 5, {"a": 1}])
def test_answers_that_are_no_numbers_fail_with_a_reason(given: Any) -> None:
    solvers, run = modules()
    problem = solvers.problems()["rigid-wobble"]
    (score,) = [s for s in run.scored(problem, {**references(problem), "energy": given}) if s.quantity == "energy"]
    assert not score.passed and score.why


def test_command_line_tells_by_its_exit_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    solvers, run = modules()
    answers = {name: references(problem) for name, problem in solvers.problems().items()}
    file = tmp_path / "answers.json"

    def code(told: Any, *options: str) -> int:
        file.write_text(json.dumps(told))
        monkeypatch.setattr(sys, "argv", ["run.py", "--answers", str(file), *options])
        return int(run.main())

    assert code(answers) == 0
    assert code({**answers, "explorer-1": {}}) == 1
    assert "no answer" in capsys.readouterr().out
    assert code({**answers, "explorer-1": {}}, "--only", "rigid-wobble") == 0
    assert code([1, 2]) == 2
    assert code(answers, "--only", "perpetual-motion") == 2
    assert "rigid-wobble" in capsys.readouterr().err


def test_published_histories_have_the_references() -> None:
    problem = json.loads(FILES[9].read_text())
    flight = ROOT / "data" / "published" / "explorer_1" / "flight.csv"
    rows = {float(row["t"]): row for row in csv.DictReader(flight.open())}
    for column, name in (("wz", "axial_rate"), ("wperp", "transverse_rate"), ("E_total", "energy")):
        told = [float(rows[t][column]) for t in problem["times"]]
        right = np.array(problem["quantities"][name]["values"])
        error = np.abs(told - right).max() / np.abs(right).max()
        # the published program steps by 1e-4 s
        assert error < 1e-4, (name, error)

    beam = json.loads(FILES[7].read_text())
    table = np.loadtxt(ROOT / "data" / "published" / "simo_vuquoc_1988" / "spin_up.csv", delimiter=",", skiprows=1)
    right = np.array(beam["quantities"]["tip_across"]["values"])
    # rows every 0.25 s: parabolas between them
    between = [np.polyval(np.polyfit(near[:, 0] - t, near[:, 2], 2), 0.0) for t in beam["times"] for near in [nearest(table, t)]]
    assert np.abs(between - right).max() < 3e-3 * np.abs(right).max()
    assert beam["quantities"]["stretch"]["values"][0] == pytest.approx(5.14317e-4, rel=1e-3)


def nearest(table: Any, time: float) -> Any:
    return table[np.argsort(np.abs(table[:, 0] - time))[:3]]
