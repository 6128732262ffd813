"""The other programs, each run in processes of its own."""

import importlib.metadata
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from records import Failed, Record, call, finished, unfinished
from settings import SETTINGS

WORKER = Path(__file__).with_name("worker.py")


@dataclass(frozen=True)
class Program:
    """How a program is called in tables, and the distributions it is installed from."""

    title: str
    distributions: tuple[str, ...]

    @property
    def version(self) -> str:
        """Installed versions; raises `PackageNotFoundError` if one is missing."""
        return " + ".join(
            f"{name} {importlib.metadata.version(name)}" for name in self.distributions
        )


PROGRAMS = {
    "heyoka": Program("heyoka", ("heyoka",)),
    "scipy": Program("SciPy", ("scipy", "numba")),
    "rebound": Program("REBOUND", ("rebound", "numba")),
    "mujoco": Program("MuJoCo", ("mujoco",)),
    "exudyn": Program("Exudyn", ("exudyn",)),
    "basilisk": Program("Basilisk", ("bsk",)),
    "drake": Program("Drake", ("drake",)),
}


def runs(peer: str, case: str, limit: int) -> Iterator[Record]:
    """A record for each setting of a program on a case."""
    title = PROGRAMS[peer].title
    for number, setting in enumerate(SETTINGS[peer][case]):
        command = [sys.executable, str(WORKER), peer, case, str(number)]
        try:
            yield finished(case, title, setting.label, result_of(command, limit))
        except Failed as error:
            yield unfinished(case, title, setting.label, error)


def result_of(command: list[str], limit: int) -> dict[str, Any]:
    """The numbers of a run, in a folder of its own: MuJoCo leaves a log in it."""
    with tempfile.TemporaryDirectory() as folder:
        numbers = call(command, limit, Path(folder))[-1]
    if "failure" in numbers:
        raise Failed(numbers["failure"])
    return numbers
