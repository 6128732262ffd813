"""The Python of the README, of the package's page and of the guide runs, and prints what the pages show."""

from __future__ import annotations

import doctest
import re
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

PAGES = ["README.md", "crates/quasirigid-python/README.md", "docs/guide/12-modes.md", "docs/guide/18-python.md", "docs/guide/21-other-tools.md", "docs/guide/22-audit.md"]


def blocks(page: Path) -> list[tuple[int, str]]:
    """Blocks of Python with the lines that they begin on."""
    text = page.read_text(encoding="utf-8")
    found = re.finditer(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    return [(text.count("\n", 0, match.start()) + 1, match.group(1)) for match in found]


@pytest.mark.parametrize("name", PAGES)
def test_the_python_of_a_page_runs(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    scope: dict[str, Any] = {}
    found = blocks(ROOT / name)
    assert found, f"{name} has no Python"
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    for line, block in found:
        if ">>>" not in block:
            exec(compile(block, f"{name}:{line}", "exec"), scope)
            continue
        test = doctest.DocTestParser().get_doctest(block, scope, name, name, line)
        told: list[str] = []
        runner.run(test, out=told.append, clear_globs=False)
        scope.update(test.globs)
        assert not told, "".join(told)
