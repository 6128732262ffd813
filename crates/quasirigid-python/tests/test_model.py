"""Models are values; what is wrong with one is told with its place."""

from __future__ import annotations

import copy
import pickle
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, ROOT

import quasirigid
from quasirigid import Model

BOOM = quasirigid.EXAMPLE


def test_the_example_is_the_one_of_the_checkout() -> None:
    assert (EXAMPLES / "boom-satellite" / "model.toml").read_text() == BOOM


def test_models_are_values() -> None:
    one, two = Model(BOOM), Model(BOOM)
    other = Model(BOOM + "\n")
    assert one == two and hash(one) == hash(two) and one != other
    assert one != BOOM and len({one, two, other}) == 2
    assert Model(BOOM, file="a/b.toml") != one
    time = one.evolve().time
    for twin in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
        assert twin == one and twin.evolve().time == time
    assert BOOM in pickle.dumps(one, protocol=0).decode("ascii", "replace").encode().decode("unicode_escape")
    for change in (lambda: setattr(one, "text", ""), lambda: setattr(one, "new", 1), lambda: delattr(one, "_core")):
        with pytest.raises(AttributeError, match="never changes"):
            change()
    assert "boom satellite" in repr(one)


def test_files_of_a_model_are_found_from_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    guide = ROOT / "docs" / "guide" / "data"
    (tmp_path / "brick.obj").write_bytes((guide / "brick.obj").read_bytes())
    text = (
        '[[surface]]\nfile = "brick.obj"\nmaterial = "rock"\ndegree = 2\n'
        "[material.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.25\n"
        '[initial]\nangular_velocity = [0.0, 0.001, 0.01]\n'
    )
    (tmp_path / "rock.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    model = Model.from_file("rock.toml")
    monkeypatch.chdir("/")
    twin = pickle.loads(pickle.dumps(model))
    assert twin.file == tmp_path / "rock.toml" and twin == model
    assert twin.reduce(2).mass == model.reduce(2).mass > 0
    with pytest.raises(quasirigid.ModelError):
        Model(text).check()
    assert Model(text, file=tmp_path / "other.toml").reduce(2).mass == model.reduce(2).mass


def same_but_for_the_order_of_the_text(one: dict[str, Any], other: dict[str, Any]) -> bool:
    def without_order(answer: dict[str, Any]) -> dict[str, Any]:
        values = sorted(answer["inputs"]["values"], key=lambda value: str(value["key"]))
        return {**answer, "inputs": {**answer["inputs"], "values": values, "files": len(answer["inputs"]["files"])}}

    return without_order(one) == without_order(other)


def test_dictionaries_have_the_vocabulary_of_the_file() -> None:
    whole = tomllib.loads(BOOM)
    model = Model.from_dict(whole)
    assert tomllib.loads(model.text) == whole
    assert same_but_for_the_order_of_the_text(model.check().to_dict(), Model(BOOM).check().to_dict())
    whole["carrier"]["inertia"] = np.array([9.0, 13.0, 16.0])
    whole["carrier"]["mass"] = np.float64(40)
    whole["run"]["order"] = np.int64(3)
    assert Model.from_dict(whole).check().to_dict() == model.check().to_dict()


def test_changed_copies() -> None:
    model = Model(BOOM)
    changed = model.with_({"spring.1.stiffness": "600 N/m", 'point."tip 1".mass': np.float64(4), "run.order": 5})
    by_hand = BOOM.replace("stiffness = 500.0", 'stiffness = "600 N/m"', 1).replace("mass = 5.0", "mass = 4.0", 1)
    by_hand = by_hand.replace("order = 3", "order = 5")
    assert changed.text == by_hand and changed.file == model.file and model.text == BOOM
    assert changed == Model(by_hand) and changed.check().to_dict() != model.check().to_dict()
    assert model.with_({}) == model
    turned = model.with_({"initial.angular_velocity": [0.1, 1.2, 0.0], "carrier.inertia.3": 15.0})
    assert turned.text.count("15.0") == 1
    with pytest.raises(quasirigid.ModelError) as caught:
        model.with_({"spring.1.stiffness": "600 kg"})
    assert caught.value.line == BOOM.splitlines().index("stiffness = 500.0") + 1
    for path, message in (
        ("sprong.1.stiffness", "sprong"),
        ("spring.3.stiffness", "3"),
        ('point."tip 9".mass', "tip 9"),
        ("", "path"),
        ("carrier.mass.x", "x"),
    ):
        with pytest.raises(quasirigid.InputError, match=message):
            model.with_({path: 1.0})
    with pytest.raises(quasirigid.InputError, match="is None"):
        model.with_({"carrier.mass": None})
    with pytest.raises(quasirigid.InputError, match="not a text"):
        model.with_({3: 1.0})  # type: ignore[dict-item]
    with pytest.raises(quasirigid.InputError, match="dictionary"):
        model.with_([("carrier.mass", 1.0)])  # type: ignore[arg-type]


class Odd:
    pass


looped: list[Any] = []
looped.append(looped)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mass": None}, "carrier.mass is None; leave it out"),
        ({"mass": Odd()}, "carrier.mass: a Odd is not allowed in a model"),
        ({"mass": 2**70}, "carrier.mass: .* is too large"),
        ({"mass": 1 + 2j}, "carrier.mass: a complex is not allowed"),
        ({"inertia": looped}, "nested more than 32 times"),
        ({3: 4}, "carrier: the key 3 is not a text"),
        ({"inertia": [1, {"a": None}]}, r"carrier.inertia\[1\].a is None"),
    ],
)
def test_what_toml_has_no_word_for_is_told_with_its_place(change: dict[Any, Any], message: str) -> None:
    whole = tomllib.loads(BOOM)
    whole["carrier"].update(change)
    with pytest.raises(quasirigid.InputError, match=message):
        Model.from_dict(whole)


def test_every_mistake_has_its_place() -> None:
    with pytest.raises(quasirigid.ModelError) as caught:
        Model(BOOM.replace("mass = 40.0", "mas = 40.0").replace("stiffness = 500.0", 'stiffness = "500 kg"', 1))
    error = caught.value
    assert [d.line for d in error.diagnostics] == sorted(d.line for d in error.diagnostics)
    assert len(error.diagnostics) >= 2
    mistake = next(each for each in error.diagnostics if "mas" in each.message and each.help and "did you mean" in each.help)
    line = BOOM.splitlines().index("mass = 40.0") + 1
    assert (mistake.line, mistake.column) == (line, 1)
    assert str(error).startswith(f"model:{error.line}:{error.column}: ")
    assert isinstance(error, ValueError)
    twin = pickle.loads(pickle.dumps(error))
    assert twin.diagnostics == error.diagnostics and str(twin) == str(error)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "# nothing",
        "[carrier",
        "\0",
        "[carrier]\nmass = nan\ncenter_of_mass = [0, 0, 0]\ninertia = [1, 1, 1]",
        "[carrier]\nmass = -1\ncenter_of_mass = [0, 0, 0]\ninertia = [1, 1, 1]",
        "[carrier]\nmass = 1\ncenter_of_mass = [0, 0, 0]\ninertia = [1, 1, 9]",
        BOOM.replace("stiffness = 500.0", "stiffness = 0.0"),
        BOOM.replace('from = "tip 1"', 'from = "tip 9"'),
    ],
)
def test_bad_models_are_model_errors(text: str) -> None:
    with pytest.raises(quasirigid.Error) as caught:
        Model(text).check()
    assert type(caught.value) is not quasirigid.InternalError and str(caught.value)


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(quasirigid.MissingFileError, match="there is no such file"):
        Model.from_file(tmp_path / "none.toml")
    with pytest.raises(FileNotFoundError):
        Model.from_file(tmp_path / "none.toml")
    with pytest.raises(quasirigid.FileError, match="folder"):
        Model.from_file(tmp_path)
    (tmp_path / "latin.toml").write_bytes(b"[body]\nname = '\xe9'\n")
    with pytest.raises(quasirigid.ModelError, match="UTF-8"):
        Model.from_file(tmp_path / "latin.toml")


def test_arguments_of_the_wrong_kind() -> None:
    for call in (
        lambda: Model(b"x"),  # type: ignore[arg-type]
        lambda: Model(BOOM, file=3),  # type: ignore[arg-type]
        lambda: Model.from_file(None),  # type: ignore[arg-type]
        lambda: Model.from_file(3),  # type: ignore[arg-type]
        lambda: Model.from_dict([1]),  # type: ignore[arg-type]
        lambda: quasirigid.cite("x"),  # type: ignore[arg-type]
    ):
        with pytest.raises(quasirigid.InputError):
            call()


def test_a_start_that_is_none() -> None:
    still = BOOM[: BOOM.index("[initial]")]
    for ask in (lambda m: m.check(), lambda m: m.evolve(), lambda m: m.simulate(), lambda m: m.run()):
        with pytest.raises(quasirigid.StartError, match="no initial spin"):
            ask(Model(still))
    assert Model(still).evolve(initial=[[0.1, 1.2, 0.0]]).holds.all()
    spinning = still + "[initial]\nangular_velocity = [0.0, 0.0, 0.0]\n"
    with pytest.raises(quasirigid.StartError, match="does not turn"):
        Model(spinning).evolve()
