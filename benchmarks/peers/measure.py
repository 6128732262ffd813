"""What a run is asked for and what it gives back."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from problem import Vector, momentum_drift

T = TypeVar("T")


@dataclass(frozen=True)
class Setting:
    """A method with a fixed step in seconds or with a tolerance."""

    method: str
    value: float
    fixed: bool

    @property
    def label(self) -> str:
        """How the setting reads in a table."""
        if self.fixed:
            return f"{self.method}, step {1e3 * self.value:g} ms"
        return f"{self.method}, tolerance {self.value:.0e}"


@dataclass(frozen=True)
class Result:
    """The end of one run; `seconds` is the time of the integration alone."""

    omega: tuple[float, float, float]
    momentum_drift: float
    seconds: float
    steps: int | None
    setup_seconds: float


class Diverged(Exception):
    """The program went astray, as its own message tells."""


def timed(action: Callable[[], T]) -> tuple[T, float]:
    """What `action` returns, and the seconds it took."""
    start = time.perf_counter()
    value = action()
    return value, time.perf_counter() - start


def result(
    omega: Vector, q: Vector, v: Vector, seconds: float, steps: int | None, setup: float
) -> Result:
    """The result of a run that ended with this spin, elongation and rate."""
    state = np.concatenate((omega, q, v))
    if not np.all(np.isfinite(state)):
        raise Diverged("the end state is not finite")
    w0, w1, w2 = (float(x) for x in omega)
    return Result((w0, w1, w2), momentum_drift(omega, q, v), seconds, steps, setup)
