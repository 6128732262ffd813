"""Certificates of the program under their checker: true ones hold, and a changed number does not pass."""

from __future__ import annotations

import importlib.util
import json
import random
import subprocess
import sys
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, ROOT, program

from quasirigid import FileError, InputError, Model, UnsupportedError

CHECKER = ROOT / "tools" / "check_certificate.py"
SPINS = ["boom-satellite", "friction-wheel", "nutation-damper", "spherical-tank", "three-masses", "two-tanks"]
# Share of the largest number of its kind below which one is rounding, and may be any other.
ROUNDING = 1e-12
# Laws of a material with memory, on the spring of the damper.
LAWS = [
    '{ kind = "maxwell", time = "40 s" }',
    '{ kind = "standard-linear", time = "0.3 s", strength = 0.2 }',
    '{ kind = "quality-factor", Q = 40 }',
]


def checker() -> ModuleType:
    spec = importlib.util.spec_from_file_location("check_certificate", CHECKER)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


CHECK = checker()


def made(folder: Path, model: str, *arguments: str) -> Any:
    """A certificate of a model file or of its text."""
    file = EXAMPLES / model / "model.toml"
    if "\n" in model:
        file = folder / "model.toml"
        file.write_text(model, encoding="utf-8")
    path = folder / "certificate.json"
    command, *options = arguments
    call = [str(program()), command, str(file), "--quiet", "--certificate", str(path), "--overwrite", *options]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(path.read_text(encoding="utf-8"))


def numbers(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Every number of a document, with its place."""
    if isinstance(node, dict | list):
        inner = node.items() if isinstance(node, dict) else enumerate(node)
        for key, value in inner:
            yield from numbers(value, (*path, key))
    elif not isinstance(node, str):
        yield path, node


def at(document: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        document = document[key]
    return document


def passes(document: Any) -> bool:
    try:
        return not CHECK.checked(document).wrong
    except CHECK.UNREADABLE:
        return False


def is_rounding(document: Any, path: tuple[Any, ...]) -> bool:
    """Whether a number, or the one that its index places, is rounding beside the others of its kind."""
    entry = at(document, path[:-1])
    own = entry[-1] if isinstance(entry, list) and isinstance(entry[0], int) else at(document, path)
    kind = next(i for i, key in enumerate(path) if isinstance(key, str) and i >= 2)
    others = [abs(v) for _, v in numbers(at(document, path[: kind + 1])) if isinstance(v, float)]
    return isinstance(own, float) and abs(own) <= ROUNDING * max(others, default=0.0)


def is_weak(history: Any, other: Any) -> bool:
    """Whether other polynomials move the body in each row as those of a history, within the errors allowed."""
    one, two = CHECK.Energy(history), CHECK.Energy(other)
    for row in history["rows"]:
        K = one.momentum(np.array(row[1:4]))
        (omega, rate, power, energy), (other_omega, other_rate, other_power, other_energy) = one.motion(K), two.motion(K)
        spin, size = np.linalg.norm(omega), np.linalg.norm(K)
        apart = [np.linalg.norm(omega - other_omega) / spin, np.linalg.norm(rate - other_rate) / (size * spin)]
        if max(*apart, abs(energy / other_energy - 1)) > 3e-9 or abs(power - other_power) > 2e-5 * abs(power):
            return False
    return True


def tampered(document: Any, count: int, seed: int) -> list[tuple[tuple[Any, ...], Any]]:
    """Changes of numbers, each alone, that pass and are not rounding: by a thousandth, and of sign."""
    found = [(path, value) for path, value in numbers(document) if path[0] != "version"]
    random.Random(seed).shuffle(found)
    passed = []
    for path, value in found[:count]:
        if isinstance(value, bool):
            changes: list[Any] = [not value]
        elif isinstance(value, int):
            changes = [value + 1]
        else:
            changes = [1.001 * value, -value] if value else [1e-3]
        place = at(document, path[:-1])
        for change in changes:
            place[path[-1]] = change
            if passes(document):
                changed = deepcopy(document)
                place[path[-1]] = value
                weak = path[1] in ("E", "c", "T") and is_weak(document["history"], changed["history"])
                if not weak and not is_rounding(document, path):
                    passed.append((path, change))
            place[path[-1]] = value
    return passed


@pytest.mark.parametrize("example", SPINS)
def test_modes_of_examples_hold(example: str, tmp_path: Path) -> None:
    judge = CHECK.checked(made(tmp_path, example, "modes"))
    assert not judge.wrong
    points = example not in ("spherical-tank", "two-tanks")
    assert any("rebuilt" in line and "does not" not in line for line in judge.told) == points


@pytest.mark.parametrize("law", LAWS)
def test_modes_of_materials_with_memory_hold(law: str, tmp_path: Path) -> None:
    text = (EXAMPLES / "nutation-damper" / "model.toml").read_text(encoding="utf-8")
    text = text.replace("damping = 0.0562", f"rheology = {law}")
    document = made(tmp_path, text, "modes")
    assert document["spins"][0]["materials"]
    assert not CHECK.checked(document).wrong
    assert not tampered(document, 12, seed=5)


def test_the_mode_of_a_spring_that_flows_is_certified_beside_the_nutation(tmp_path: Path) -> None:
    """Both iterations from the modes with dashpots lead to the nutation."""
    text = (EXAMPLES / "nutation-damper" / "model.toml").read_text(encoding="utf-8")
    model = Model(text.replace("damping = 0.0562", 'rheology = { kind = "maxwell", time = "0.4 s" }'))
    model.modes(axis="greatest", certificate=tmp_path / "flows.json")
    document = json.loads((tmp_path / "flows.json").read_text(encoding="utf-8"))
    assert passes(document)
    first, second = document["spins"][0]["modes"]
    assert abs(first["decay_rate"] - second["decay_rate"]) > 0.5


def test_a_changed_number_of_modes_does_not_pass(tmp_path: Path) -> None:
    document = made(tmp_path, "nutation-damper", "modes")
    assert passes(document)
    assert not tampered(document, 200, seed=1)
    for example, count in [("boom-satellite", 4), ("friction-wheel", 8)]:
        assert not tampered(made(tmp_path, example, "modes"), count, seed=2)


def test_a_missing_or_repeated_mode_is_found(tmp_path: Path) -> None:
    document = made(tmp_path, "boom-satellite", "modes", "--axis", "greatest")
    modes = document["spins"][0]["modes"]
    for changed in (modes[1:], modes[:-1], [*modes[:-1], modes[1]], [*modes, modes[1]]):
        document["spins"][0]["modes"] = changed
        assert not passes(document)


def test_the_matrices_are_those_of_the_model(tmp_path: Path) -> None:
    """A body that is another one, with modes of its own that solve its equations."""
    own, other = (made(tmp_path, "nutation-damper", "modes"), None)
    text = (EXAMPLES / "nutation-damper" / "model.toml").read_text(encoding="utf-8")
    other = made(tmp_path, text.replace("damping = 0.0562", "damping = 0.0563"), "modes")
    other["model"] = own["model"]
    assert any("damping of the model file" in line for line in CHECK.checked(other).wrong)


@pytest.mark.parametrize("example", ["boom-satellite", "friction-wheel"])
def test_histories_hold_and_their_numbers_cannot_be_changed(example: str, tmp_path: Path) -> None:
    document = made(tmp_path, example, "simulate", "--duration", "4", "--samples", "4")
    assert passes(document)
    assert not tampered(document, 14, seed=3)
    rows = [(path, value) for path, value in numbers(document["history"]["rows"])]
    for (row, column), value in random.Random(4).sample(rows, 6):
        document["history"]["rows"][row][column] = 1.001 * value if value else 1e-6
        assert not passes(document), (row, column)
        document["history"]["rows"][row][column] = value


@pytest.mark.parametrize("unit", [1e-4, 1e4])
@pytest.mark.parametrize("moments", [[9.0, 13.0, 16.0], [16.0, 9.0, 9.0], [9.0, 9.0, 16.0]])
def test_bodies_of_other_sizes_and_shapes_hold(unit: float, moments: list[float], tmp_path: Path) -> None:
    """Lengths in another unit, stiffer and softer springs, strong dampers: eigenvalues from fast to slow."""
    for stiffness, damping in [(500.0, 50.0), (5e5, 5.0), (60.0, 600.0)]:
        text = f"""
[carrier]
mass = 40.0
center_of_mass = [0, {0.1 * unit}, 0]
inertia = {[m * unit**2 for m in moments]}
[[point]]
name = "tip"
mass = 5.0
position = [{0.4 * unit}, {unit}, {0.5 * unit}]
[[spring]]
from = "tip"
to = "carrier"
stiffness = {stiffness}
damping = {damping}
[initial]
angular_velocity = [0.1, 0.2, 1.2]
"""
        assert passes(made(tmp_path, text, "modes")), (stiffness, damping)


def test_a_unit_that_the_checker_does_not_know_is_no_fault(tmp_path: Path) -> None:
    """The matrices are then taken as stated, and told to be."""
    text = """
[carrier]
mass = "0.074 t"
center_of_mass = [0, 0, 0]
inertia = [24.0, 23.0, 22.0]
[[rotor]]
name = "r"
axis = [2, 2, -0.4]
inertia = "99.18 t mm^2"
friction = 0.4
[initial]
angular_velocity = [0.9, -1.1, -0.5]
"""
    assert passes(made(tmp_path, text, "modes"))
    path = tmp_path / "certificate.json"
    done = subprocess.run([sys.executable, str(CHECKER), str(path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "does not rebuild the unit" in done.stdout, done.stdout + done.stderr


def test_the_checker_tells_its_verdict_by_its_exit_code(tmp_path: Path) -> None:
    document = made(tmp_path, "nutation-damper", "modes")
    path = tmp_path / "certificate.json"

    def verdict(text: str) -> tuple[int, str]:
        path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, str(CHECKER), str(path)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    code, told = verdict(json.dumps(document))
    assert code == 0 and told.startswith(f"{path}: holds\n")
    document["spins"][0]["modes"][0]["decay_rate"] *= 1.0001
    code, told = verdict(json.dumps(document))
    assert code == 1 and "does NOT hold" in told and "decay_rate" in told
    for text in ("{", "[]", '{"kind": "another"}', "\0"):
        assert verdict(text)[0] == 2


def test_python_writes_the_certificate_of_the_program(tmp_path: Path) -> None:
    model = Model.from_file(EXAMPLES / "nutation-damper" / "model.toml")
    path = tmp_path / "python.json"
    model.modes(certificate=path)
    assert json.loads(path.read_text(encoding="utf-8")) == made(tmp_path, "nutation-damper", "modes")
    with pytest.raises(FileError, match="already exists"):
        model.modes(certificate=path)
    with pytest.raises(UnsupportedError, match="no certificate"):
        model.simulate("full", duration=1.0, certificate=tmp_path / "full.json")
    with pytest.raises(InputError, match="one history"):
        model.simulate(initial=[[0.0, 0.0, 1.0]], certificate=tmp_path / "many.json")  # type: ignore[call-overload]
