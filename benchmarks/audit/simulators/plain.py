"""Methods of textbooks, written here, whose invented time constants are known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bodies import DURATION, Body, Rows
from simulators import Method

TITLE = "NumPy"
SCAN = (0.04, 0.08)
METHODS = (
    Method("explicit Euler", (0.01, 0.005), SCAN, "chosen", "Of first order: a step lengthens the wobble by $(\\lambda h)^2/2$, and feeds energy and angular momentum."),
    Method("semi-implicit Euler on the angular momentum", (0.01, 0.005), SCAN, "chosen", "The inertial angular momentum is kept and the attitude is turned by the rate of the old attitude: of first order in the energy, none in $\\lvert K\\rvert$."),
    Method("implicit midpoint", (0.01, 0.005), SCAN, "chosen", "It keeps quadratic invariants, and so both energy and angular momentum."),
    Method("Runge-Kutta 4", (0.1, 0.05), (0.2, 0.4), "chosen", "The fourth order of the solution is the fifth of what it loses of a wobble."),
    Method("Lie group, Runge-Kutta 4 (Munthe-Kaas)", (0.1, 0.05), (0.2, 0.4), "chosen", "The attitude is exact on the group; the rates are those of Runge and Kutta, and so is their loss."),
)


def version() -> str:
    return np.__version__


def cross(a: Rows, b: Rows) -> Rows:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def product(a: Rows, b: Rows) -> Rows:
    return np.array([a[0] * b[0] - a[1:] @ b[1:], *(a[0] * b[1:] + b[0] * a[1:] + cross(a[1:], b[1:]))])


def turned(q: Rows, rotation: Rows) -> Rows:
    """The attitude after a rotation vector in body axes."""
    angle = np.sqrt(rotation @ rotation)
    half = 0.5 * np.sinc(0.5 * angle / np.pi)
    found = product(q, np.array([np.cos(0.5 * angle), *(half * rotation)]))
    return found / np.sqrt(found @ found)


def seen_from_body(q: Rows, vector: Rows) -> Rows:
    """Body components of an inertial vector."""
    twice = 2.0 * cross(-q[1:], vector)
    return vector + q[0] * twice + cross(-q[1:], twice)


def euler(moments: Rows) -> Callable[[Rows], Rows]:
    return lambda w: cross(moments * w, w) / moments


def runge_kutta(rate: Callable[[Rows], Rows], y: Rows, h: float) -> Rows:
    a = rate(y)
    b = rate(y + h / 2 * a)
    c = rate(y + h / 2 * b)
    d = rate(y + h * c)
    return y + h / 6 * (a + 2 * b + 2 * c + d)


def midpoint(rate: Callable[[Rows], Rows], w: Rows, h: float) -> Rows:
    new = w
    for _ in range(60):
        last, new = new, w + h * rate(0.5 * (w + new))
        if np.abs(new - last).max() <= 1e-16:
            break
    return new


def munthe_kaas(moments: Rows, w: Rows, q: Rows, h: float) -> tuple[Rows, Rows]:
    """A step of fourth order: stages of the rates, and of the rotation vector by the inverse differential of the exponential map."""
    rate = euler(moments)

    def slope(state: Rows) -> Rows:
        u, v = state[:3], state[3:]
        return np.array([*(v + cross(u, v) / 2 + cross(u, cross(u, v)) / 12), *rate(v)])

    new = runge_kutta(slope, np.array([0.0, 0.0, 0.0, *w]), h)
    return new[3:], turned(q, new[:3])


def stepper(method: Method, body: Body) -> Callable[[Rows, Rows, float], tuple[Rows, Rows]]:
    moments = np.array(body.moments)
    rate = euler(moments)
    if method.name == "explicit Euler":
        return lambda w, q, h: (w + h * rate(w), turned(q, h * w))
    if method.name == "implicit midpoint":

        def middle(w: Rows, q: Rows, h: float) -> tuple[Rows, Rows]:
            new = midpoint(rate, w, h)
            return new, turned(q, h / 2 * (w + new))

        return middle
    if method.name == "Runge-Kutta 4":

        def fourth(w: Rows, q: Rows, h: float) -> tuple[Rows, Rows]:
            spin = lambda y: np.array([*rate(y[:3]), *product(y[3:], np.array([0.0, *y[:3]])) / 2])
            new = runge_kutta(spin, np.array([*w, *q]), h)
            return new[:3], new[3:] / np.sqrt(new[3:] @ new[3:])

        return fourth
    if method.name.startswith("Lie group"):
        return lambda w, q, h: munthe_kaas(moments, w, q, h)
    momentum = moments * np.array(body.rates)

    def kept(w: Rows, q: Rows, h: float) -> tuple[Rows, Rows]:
        new = turned(q, h * w)
        return seen_from_body(new, momentum) / moments, new

    return kept


def history(method: Method, body: Body, step: float, duration: float = DURATION) -> Rows:
    stepped = stepper(method, body)
    w, q = np.array(body.rates), np.array([1.0, 0.0, 0.0, 0.0])

    def advance() -> None:
        nonlocal w, q
        w, q = stepped(w, q, step)

    return body.followed(step, advance, lambda time: [time, *w, *q], duration)
