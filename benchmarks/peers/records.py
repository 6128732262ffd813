"""What the runner keeps of each run, of the other programs and of quasirigid alike."""

import json
import os
import resource
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from problem import spin_error

ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "RAYON_NUM_THREADS": "1",
}


@dataclass(frozen=True)
class Run:
    """A run that came to its end; what a program does not tell is None."""

    case: str
    program: str
    setting: str
    seconds: float
    setup_seconds: float | None
    error: float
    momentum_drift: float
    steps: int | None


@dataclass(frozen=True)
class Failure:
    """A run without an end, and why."""

    case: str
    program: str
    setting: str
    reason: str
    stopped: bool


Record = Run | Failure


class Failed(Exception):
    """A process ended without a result."""

    def __init__(self, reason: str, stopped: bool = False) -> None:
        super().__init__(reason)
        self.stopped = stopped


def call(
    command: Sequence[str], limit: int, folder: Path | None = None
) -> list[dict[str, Any]]:
    """Runs a process and reads the lines of its output that are JSON objects.

    The limit is in CPU seconds, so that a busy machine stops nothing early.
    """
    try:
        process = subprocess.run(
            command,
            capture_output=True,
            check=False,
            cwd=folder,
            env=os.environ | ONE_THREAD,
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_CPU, (limit, limit + 5)
            ),
            text=True,
        )
    except OSError as error:
        raise Failed(str(error)) from None
    if process.returncode == -signal.SIGXCPU:
        raise Failed(f"> {limit} s", stopped=True)
    lines = [line for line in process.stdout.splitlines() if line.startswith("{")]
    if process.returncode != 0 or not lines:
        said = process.stderr.strip().splitlines() or ["no output"]
        raise Failed(f"exit status {process.returncode}: {said[-1]}")
    return [json.loads(line) for line in lines]


def finished(case: str, program: str, setting: str, numbers: dict[str, Any]) -> Run:
    """The record of a run that printed these numbers."""
    return Run(
        case,
        program,
        setting,
        seconds=numbers["seconds"],
        setup_seconds=numbers.get("setup_seconds"),
        error=spin_error(case, numbers["omega"]),
        momentum_drift=numbers["momentum_drift"],
        steps=numbers["steps"],
    )


def unfinished(case: str, program: str, setting: str, error: Failed) -> Failure:
    """The record of a run that ended without a result."""
    return Failure(case, program, setting, str(error), error.stopped)
