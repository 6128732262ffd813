"""The table of simulators: its page against its results, and the audit against direct bookkeeping of the energy."""

from __future__ import annotations

import importlib
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from conftest import EXAMPLES, ROOT

import quasirigid

FOLDER = ROOT / "benchmarks" / "audit"


@pytest.fixture(autouse=True)
def importable(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The folder of the benchmark on the path, and its modules gone afterwards."""
    before = set(sys.modules)
    monkeypatch.syspath_prepend(str(FOLDER))
    yield
    for name in set(sys.modules) - before:
        if str(FOLDER) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]


def module(name: str) -> ModuleType:
    return importlib.import_module(name)


def test_page_and_figures_are_those_of_the_results() -> None:
    page = module("page")
    results = json.loads(page.RESULTS.read_text())
    assert (FOLDER / "README.md").read_text() == page.page(results)
    for name, text in page.figures(results).items():
        assert (FOLDER / f"{name}.svg").read_text() == text


def test_audit_and_bookkeeping_agree_on_every_clear_trend() -> None:
    page = module("page")
    results = json.loads(page.RESULTS.read_text())
    ratios = {(row["program"], row["name"]): page.ratio(row) for row in results["rows"] if not row["damping"]}
    told = {name: ratio for name, ratio in ratios.items() if ratio is not None}
    assert len({program for program, _ in told}) >= 8
    for name, ratio in told.items():
        assert ratio == pytest.approx(1.0, rel=0.05), name


# Seconds of each history: a dozen wobbles.
DURATION = 200.0
# Small wobbles: -ln|R(i lambda h)| of the methods of theory 22, and of the one that keeps K, whose energy alone grows.
CLOSED = {
    "explicit Euler": lambda rate, h: -2.0 / (rate**2 * h),
    "Runge-Kutta 4": lambda rate, h: 144.0 / (rate**6 * h**5),
    "Lie group, Runge-Kutta 4 (Munthe-Kaas)": lambda rate, h: 144.0 / (rate**6 * h**5),
}


def test_a_history_made_now_has_the_constant_of_bookkeeping_and_of_theory(tmp_path: Path) -> None:
    bodies, books, plain = module("bodies"), module("bookkeeping"), module("simulators.plain")
    file = tmp_path / "spin.csv"
    for method in plain.METHODS:
        for body in bodies.BODIES:
            step = method.steps[0]
            rows = books.told(plain.history(method, body, step, DURATION), body)
            np.savetxt(file, rows, fmt="%.17g", delimiter=",", header="t,wx,wy,wz,qw,qx,qy,qz", comments="")
            found = quasirigid.audit(file, inertia=list(body.moments)).invented_time_constant
            if method.name == "implicit midpoint":
                assert found is None
                continue
            assert found == pytest.approx(books.time_constant(rows, body), rel=0.05), (method.name, body.name)
            if method.name in CLOSED:
                # wobbles of 0.1 rad at the start, whose square is their difference from small ones, and of Euler up to 0.3
                assert found == pytest.approx(CLOSED[method.name](body.frequency, step), rel=0.08), (method.name, body.name)


def test_the_history_of_mujoco_has_the_constant_of_bookkeeping() -> None:
    bodies, books = module("bodies"), module("bookkeeping")
    file = EXAMPLES / "invented-damping" / "euler.csv"
    rows = np.loadtxt(file, delimiter=",", skiprows=1)
    found = quasirigid.audit(file, inertia=[10, 14, 17]).invented_time_constant
    assert found == pytest.approx(books.time_constant(rows, bodies.TRIAXIAL), rel=0.05)
