"""A free body of a carrier and moved parts, by Lagrange's equations in quasi-velocities.

With `u = (omega, dq/dt)` and the mass matrix `M(q)` of the body about its centre of mass, the momenta are `(H, p) = M u`, and

    dH/dt = -omega x H,    dp/dt = 1/2 u^T (dM/dq) u - k q - c dq/dt,

in carrier axes. A wheel of constant speed adds a constant `h` to `H`. `dM/dq` is by complex steps, exact to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[Any]
STEP = 1e-30


@dataclass
class Body:
    """`mass(q)`: mass matrices (b, 3 + n, 3 + n) of coordinates (b, n); springs and dashpots, diagonal; spin of a wheel (N m s)."""

    mass: Callable[[Array], Array]
    stiffness: Array
    damping: Array
    wheel: Array = field(default_factory=lambda: np.zeros(3))

    def state(self, omega: list[float], q: list[float]) -> Array:
        """`(H, q, p)` of a carrier that turns with `omega` while the coordinates rest at `q`."""
        n = len(self.stiffness)
        momenta = self.mass(np.array([q], complex))[0].real @ np.concatenate([omega, np.zeros(n)])
        return np.concatenate([momenta[:3] + self.wheel, q, momenta[3:]])

    def parts(self, state: Array) -> tuple[Array, Array, Array]:
        """`H`, `q` and `u` of a state, and with them `1/2 u^T (dM/dq) u`, appended to `u`."""
        n = len(self.stiffness)
        total, q, p = state[:3], state[3 : 3 + n], state[3 + n :]
        matrices = self.mass(q + 1j * STEP * np.vstack([np.zeros(n), np.eye(n)]))
        u = np.linalg.solve(matrices[0].real, np.concatenate([total - self.wheel, p]))
        slopes = 0.5 * np.einsum("i,bij,j->b", u, matrices[1:].imag, u) / STEP
        return total, q, np.concatenate([u, slopes])

    def rates(self, _: float, state: Array) -> Array:
        n = len(self.stiffness)
        total, q, rest = self.parts(state)
        u, slopes = rest[: 3 + n], rest[3 + n :]
        force = slopes - self.stiffness * q - self.damping * u[3:]
        return np.concatenate([-np.cross(u[:3], total), u[3:], force])

    def energy(self, state: Array) -> float:
        """Kinetic and elastic energy (J) beside the wheel's own relative spin."""
        n = len(self.stiffness)
        total, q, rest = self.parts(state)
        u = rest[: 3 + n]
        own = np.concatenate([total - self.wheel, state[3 + n :]])
        return float(0.5 * own @ u + 0.5 * q @ (self.stiffness * q))

    def history(self, start: Array, times: list[float], tolerance: float = 1e-12) -> dict[str, Array]:
        """Angular velocity (rad/s), coordinates and energy (J) at the times (s)."""
        size = np.abs(start).max()
        done = solve_ivp(self.rates, (0, times[-1]), start, "DOP853", times, rtol=tolerance, atol=tolerance * size * 1e-2)
        assert done.success, done.message
        n = len(self.stiffness)
        return {
            "omega": np.array([self.parts(state)[2][:3] for state in done.y.T]),
            "coordinates": done.y[3 : 3 + n].T,
            "energy": np.array([self.energy(state) for state in done.y.T]),
        }

    def jacobian(self, state: Array) -> Array:
        """Derivatives of the rates, by central differences of the fourth order."""
        columns = []
        for k in range(len(state)):
            h = 1e-3 * max(1.0, abs(state[k])) * np.eye(len(state))[k]
            near, far = (self.rates(0, state + s * h) - self.rates(0, state - s * h) for s in (1, 2))
            columns.append((8 * near - far) / (12 * h[k]))
        return np.array(columns).T

    def modes(self, guess: Array, start: Array) -> Array:
        """Eigenvalues (1/s) with a frequency, about the steady spin near `guess` with the angular momentum of `start`, by frequency."""
        size, state = start[:3] @ start[:3], guess.copy()
        for _ in range(30):
            row = np.concatenate([2 * state[:3], np.zeros(len(state) - 3)])
            left = np.concatenate([self.rates(0, state), [state[:3] @ state[:3] - size]])
            state = state - np.linalg.lstsq(np.vstack([self.jacobian(state), row]), left)[0]
        assert np.abs(self.rates(0, state)).max() <= 1e-10 * np.sqrt(size)
        values = np.linalg.eigvals(self.jacobian(state))
        kept = values[values.imag > 1e-6 * np.abs(values).max()]
        return np.array(kept[np.argsort(kept.imag)])


def about_center(masses: Array, A: Array, B: Array, J: Array) -> Array:
    """Mass matrix about the common centre of mass of bodies with velocities `A u` (b, k, 3, n) and turns `B u`, tensors `J` (b, k, 3, 3)."""
    total = np.einsum("k,bkia->bia", masses, A)
    return np.array(
        np.einsum("k,bkia,bkic->bac", masses, A, A, optimize=True)
        + np.einsum("bkia,bkij,bkjc->bac", B, J, B, optimize=True)
        - np.einsum("bia,bic->bac", total, total) / masses.sum()
    )


def cross(r: Array) -> Array:
    """Matrices (..., 3, 3) of `v -> r x v`."""
    x, y, z = np.moveaxis(r, -1, 0)
    o = np.zeros_like(x)
    return np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], -2)
