"""Paths of the checkout, and the program beside the package."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples"

# Examples without large meshes, one for each kind of body.
QUICK = ["axial-mass", "boom-satellite", "duende", "explorer1", "friction-wheel", "nutation-damper", "three-masses"]


def program() -> Path:
    """The program that `cargo test --workspace` built, or the one that QUASIRIGID names."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    path = Path(os.environ.get("QUASIRIGID", target / "debug" / "quasirigid"))
    if not path.exists():
        pytest.fail(f"the program {path} is missing; build it with: cargo build --workspace")
    return path


def until(page: Any, true: str) -> None:
    """Waits for an expression in a page; the page's own policy forbids the driver to poll it."""
    for _ in range(1200):
        if page.evaluate(true):
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never: {true}")


@pytest.fixture(scope="session")
def told() -> Callable[..., dict[str, Any]]:
    """What the program prints with --json."""

    def ask(command: str, example: str, *options: str) -> dict[str, Any]:
        call = [str(program()), command, str(EXAMPLES / example / "model.toml"), "--json", "--quiet", *options]
        done = subprocess.run(call, capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1), done.stderr
        answer: dict[str, Any] = json.loads(done.stdout)
        return answer

    return ask
