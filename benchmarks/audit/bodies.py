"""Three rigid bodies that turn freely, and the rows that a simulator hands over."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.float64]

DURATION = 600.0
BETWEEN_ROWS = 0.5
MASS = 100.0
FAST = 10.0


@dataclass(frozen=True)
class Body:
    """A free rigid body at its start: principal moments (kg m²), rates in body axes (rad/s), spin (rad/s)."""

    name: str
    moments: tuple[float, float, float]
    rates: tuple[float, float, float]
    spin: float = 1.0

    @property
    def axis(self) -> int:
        """The principal axis that it circles."""
        return 2 if self.rates[2] > self.rates[0] else 0

    @property
    def frequency(self) -> float:
        """Rate of a small wobble in the body (rad/s), of theory 22."""
        own = self.moments[self.axis]
        a, b = (moment for k, moment in enumerate(self.moments) if k != self.axis)
        return self.spin * float(np.sqrt((own - a) * (own - b) / (a * b)))

    def faster(self, factor: float) -> Body:
        """The same motion, faster."""
        x, y, z = (factor * rate for rate in self.rates)
        return replace(self, name=f"{self.name}, {factor:g} rad/s", rates=(x, y, z), spin=factor)

    def schedule(self, step: float, duration: float = DURATION) -> tuple[int, int]:
        """Steps between rows, and rows after the first; a faster body is followed for as many revolutions."""
        every = max(1, round(BETWEEN_ROWS / self.spin / step))
        return every, round(duration / self.spin / (every * step))

    def followed(self, step: float, advance: Callable[[], None], row: Callable[[float], list[float]], duration: float = DURATION) -> Rows:
        """Rows at the start and after so many steps of a program that keeps its state itself."""
        every, rows = self.schedule(step, duration)
        found = [row(0.0)]
        for k in range(1, rows + 1):
            for _ in range(every):
                advance()
            found.append(row(k * every * step))
        return np.array(found)

    def times(self) -> Rows:
        """Times of the rows where a program chooses its own steps."""
        return np.linspace(0.0, DURATION / self.spin, round(DURATION / BETWEEN_ROWS) + 1)


BODIES = (
    Body("oblate", (10.0, 10.1, 17.0), (0.15, 0.0, 1.0)),
    Body("triaxial", (10.0, 14.0, 17.0), (0.15, 0.0, 1.0)),
    Body("prolate", (5.0, 16.0, 17.0), (1.0, 0.0, 0.03)),
)
TRIAXIAL = BODIES[1]
