"""Every notebook of examples/notebooks runs in a fresh kernel, and is stored without outputs.

The notebooks check their own numbers by ``assert``; here they only have to reach their end. Libraries that a notebook imports and
that are not installed skip it, in words.
"""

from __future__ import annotations

import json
import re
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).resolve().parents[3] / "examples" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))

# Seconds for one cell; the slowest notebook takes about ten on one free core.
PATIENCE = 300

# Left out by the notebook itself, in words, where it is missing.
OPTIONAL = {"heyoka"}


def cells(path: Path, kind: str) -> list[dict[str, Any]]:
    """Cells of one kind."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return [cell for cell in notebook["cells"] if cell["cell_type"] == kind]


def source(cell: dict[str, Any]) -> str:
    """Text of a cell, which nbformat stores as lines."""
    return "".join(cell["source"])


def libraries(path: Path) -> set[str]:
    """Top-level names that the cells import."""
    code = "\n".join(source(cell) for cell in cells(path, "code"))
    return {name.split(".")[0] for name in re.findall(r"^\s*(?:import|from)\s+([\w.]+)", code, re.MULTILINE)}


def missing(names: set[str]) -> list[str]:
    """Those that are not installed."""
    return sorted(name for name in names - OPTIONAL if find_spec(name) is None)


def question(path: Path) -> str:
    """Title of a notebook."""
    return source(cells(path, "markdown")[0]).splitlines()[0].removeprefix("# ")


def test_there_are_notebooks() -> None:
    assert len(NOTEBOOKS) >= 9


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_notebook_runs(path: Path) -> None:
    lacking = missing({"nbclient", "nbformat", "ipykernel"} | libraries(path))
    if lacking:
        pytest.skip(f"{path.name} needs {', '.join(lacking)}; install with: pip install {' '.join(lacking)}")
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    place = {"metadata": {"path": str(FOLDER)}}
    NotebookClient(notebook, timeout=PATIENCE, kernel_name="python3", resources=place).execute()
    figures = [out for cell in notebook.cells for out in cell.get("outputs", []) if "image/png" in out.get("data", {})]
    assert len(figures) == 1, f"{path.name} draws {len(figures)} figures; one question, one figure"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_notebook_is_stored_without_outputs(path: Path) -> None:
    for number, cell in enumerate(cells(path, "code"), start=1):
        advice = f"code cell {number} of {path.name} has outputs; clear them: jupyter nbconvert --clear-output --inplace {path.name}"
        assert not cell["outputs"] and cell["execution_count"] is None, advice


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_notebook_asks_answers_and_checks(path: Path) -> None:
    opening = source(cells(path, "markdown")[0])
    assert "?" in question(path) and "\n**Answer.** " in opening
    assert re.search(r"^\s*assert ", source(cells(path, "code")[-1]), re.MULTILINE), "the last cell checks the numbers"
    listed = (FOLDER / "README.md").read_text(encoding="utf-8")
    assert f"[{question(path)}]({path.name})" in listed, f"README.md does not list {path.name} with its question"
