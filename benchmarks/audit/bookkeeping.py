"""Direct bookkeeping of energy and angular momentum: the second road to the numbers of `quasirigid audit`, written without it."""

from __future__ import annotations

import numpy as np

from bodies import Body, Rows

FEWEST = 24
WINDOW = 8
STEADY = 0.2


def accounts(rows: Rows, body: Body) -> tuple[Rows, Rows]:
    """Energy (J) and magnitude of the angular momentum (N m s) of each row."""
    w = rows[:, 1:4]
    momentum = w * np.array(body.moments)
    return 0.5 * (w * momentum).sum(axis=1), np.linalg.norm(momentum, axis=1)


def excess(rows: Rows, body: Body) -> Rows:
    """Energy beyond that of the steady spin about the circled axis with the same angular momentum, in parts of it, positive for a wobble."""
    energy, momentum = accounts(rows, body)
    own = body.moments[body.axis]
    return np.abs(2.0 * own * energy / momentum**2 - 1.0)


def told(rows: Rows, body: Body) -> Rows:
    """The rows up to where wobble energy or angular momentum have changed by a factor of e: a time constant is that of the start."""
    # a simulator that diverges leaves numbers that are no rates
    with np.errstate(all="ignore"):
        _, momentum = accounts(rows, body)
        over = excess(rows, body)
        change = np.maximum(np.abs(np.log(over / over[0])), np.abs(np.log(momentum / momentum[0])))
    beyond = np.flatnonzero(~(change <= 1.0))
    return rows if beyond.size == 0 else rows[: max(int(beyond[0]), FEWEST)]


def time_constant(rows: Rows, body: Body) -> float:
    """Time (s) in which the wobble falls e-fold, negative where it grows, from means of the excess over the first and the last eighth."""
    over, times = excess(rows, body), rows[:, 0]
    part = max(1, len(rows) // WINDOW)
    ratio = np.log(over[-part:].mean() / over[:part].mean())
    span = times[-part:].mean() - times[:part].mean()
    return float("inf") if ratio == 0.0 else float(-2.0 * span / ratio)


def is_steady(rows: Rows, body: Body) -> bool:
    """Whether both halves of a history have about its time constant: not where rounding walks, or where tolerances let steps change."""
    middle = len(rows) // 2
    whole = time_constant(rows, body)
    return all(abs(whole / time_constant(half, body) - 1.0) < STEADY for half in (rows[: middle + 1], rows[middle:]))


def changes(rows: Rows, body: Body) -> tuple[float, float]:
    """Relative change of energy and of angular momentum from start to end."""
    energy, momentum = accounts(rows, body)
    return float(energy[-1] / energy[0] - 1.0), float(momentum[-1] / momentum[0] - 1.0)
