"""Every public name has a docstring, and the examples of docstrings run."""

from __future__ import annotations

import doctest
import inspect
from collections.abc import Iterator
from typing import Any

import pytest

import quasirigid

# Properties and small methods have their example in the class.
WITHOUT_EXAMPLE = {"StartError", "SympyEquations"}


def documented() -> Iterator[tuple[str, Any]]:
    """Public names and members of classes, each where it is defined."""
    yield "quasirigid", quasirigid
    for name in quasirigid.__all__:
        value = getattr(quasirigid, name)
        if isinstance(value, str):
            continue
        yield name, value
        for member, found in vars(value).items() if inspect.isclass(value) else ():
            if not member.startswith("_") and isinstance(found, property | classmethod | staticmethod):
                yield f"{name}.{member}", found
            elif not member.startswith("_") and inspect.isfunction(found):
                yield f"{name}.{member}", found


DOCUMENTED = dict(documented())


def examples(name: str) -> list[doctest.Example]:
    return doctest.DocTestParser().get_examples(inspect.getdoc(DOCUMENTED[name]) or "")


@pytest.mark.parametrize("name", DOCUMENTED)
def test_a_docstring_is_there_and_begins_with_a_sentence(name: str) -> None:
    doc = inspect.getdoc(DOCUMENTED[name])
    assert doc and doc[0].isupper() or doc and doc[0] == "`", name
    assert doc.split("\n\n")[0].rstrip().endswith((".", ":", "?", ")", "]")), doc


@pytest.mark.parametrize("name", [name for name in DOCUMENTED if examples(name)])
def test_the_examples_of_a_docstring_run(name: str) -> None:
    test = doctest.DocTest(examples(name), {}, name, None, None, None)
    told: list[str] = []
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    runner.run(test, out=told.append)
    assert not told, "".join(told)


def test_classes_and_questions_have_an_example() -> None:
    questions = {"Model.check", "Model.modes", "Model.reduce", "Model.simulate", "Model.evolve", "Model.spins", "Model.with_", "cite", "evolve_ellipsoids"}
    kinds = {name for name, value in DOCUMENTED.items() if inspect.isclass(value) and not issubclass(value, Exception)}
    missing = {name for name in questions | kinds if not examples(name)} - WITHOUT_EXAMPLE
    assert not missing
