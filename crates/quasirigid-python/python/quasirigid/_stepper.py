"""Bodies that a program moves step by step: hardware loops, other simulators."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid import _arguments, _core
from quasirigid._errors import InputError

__all__ = ["Stepper"]


class Stepper:
    """Body under a torque on the carrier that is held over each step.

    Of the reduced equations the energy form moves, as in exported source: without a torque its numbers are those of
    ``simulate``, and how a torque itself bends the body is left out. The numbers of the full system are those of ``simulate``
    under the same torque.

    >>> import quasirigid
    >>> body = quasirigid.Model(quasirigid.EXAMPLE).stepper()
    >>> for _ in range(100):
    ...     status = body.step(-0.5 * body.omega, 0.01)
    >>> status, round(body.time, 9)
    ('holds', 1.0)
    """

    __slots__ = ("_stepper",)

    def __init__(self, stepper: _core.Stepper) -> None:
        self._stepper = stepper

    def step(self, torque: ArrayLike, dt: float) -> str:
        """Moves the body by ``dt`` (s) under a torque (N·m, body axes), ``(3,)``; gives the status.

        Raises:
            InputError: for a step that is not positive, and a torque that is not finite.
            PropagationError: where no step can be made.
        """
        try:
            return self._stepper.step(torque, dt)
        except InputError:
            raise
        except (TypeError, ValueError, OverflowError) as error:
            raise InputError(f"torque = {torque!r} and dt = {dt!r}: give three numbers (N·m) and one (s)") from error

    @property
    def status(self) -> str:
        """``holds``; of reduced equations also ``marginal`` and ``fails`` beyond their ``range``; of the full system ``left``
        where a part is displaced beyond the range of its paths.
        """
        return self._stepper.status

    @property
    def time(self) -> float:
        """Time (s) since the start; of the full system since it was last placed."""
        return self._stepper.time

    @property
    def omega(self) -> NDArray[np.float64]:
        """Angular velocity (rad/s), body axes, ``(3,)``."""
        return np.array(self._stepper.state()["omega"])

    @property
    def attitude(self) -> NDArray[np.float64]:
        """Quaternion from body to inertial axes, scalar first, ``(4,)``."""
        return np.array(self._stepper.state()["attitude"])

    @property
    def state(self) -> dict[str, NDArray[np.float64]]:
        """``omega``, ``attitude`` and ``angular_momentum`` (N·m·s, body axes); of the full system also ``q`` and ``rate`` of the
        internal coordinates ``(n,)``, ``place`` (m) and ``velocity`` (m/s).
        """
        return {name: np.array(value) for name, value in self._stepper.state().items()}

    def place(
        self,
        omega: ArrayLike,
        attitude: ArrayLike,
        *,
        q: ArrayLike | None = None,
        rate: ArrayLike | None = None,
        position: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
    ) -> None:
        """Puts the body into another state.

        Args:
            omega: Angular velocity (rad/s), body axes, ``(3,)``.
            attitude: Quaternion from body to inertial axes, scalar first, ``(4,)``.
            q: Internal coordinates of the full system, ``(n,)``, with ``rate``; those of the moment by default.
            rate: Rates of the internal coordinates, ``(n,)``.
            position: Place (m) of the full system, inertial axes, ``(3,)``, with ``velocity``; that of the moment by default.
            velocity: Velocity (m/s), ``(3,)``.

        Raises:
            InputError: for one of a pair without the other, and numbers that are no state.
        """
        for first, second, names in ((q, rate, "q and rate"), (position, velocity, "position and velocity")):
            if (first is None) != (second is None):
                raise InputError(f"give both {names}")
        if "q" not in self._stepper.state() and (q is not None or position is not None):
            raise InputError("the reduced equations have no coordinates and no place; leave them out")
        spin, turn = _arguments.array(omega, "omega"), _arguments.array(attitude, "attitude")
        if spin.shape != (3,) or turn.shape != (4,):
            raise InputError(f"omega and attitude have the shapes (3,) and (4,), not {spin.shape} and {turn.shape}")
        inside = None if q is None or rate is None else (_arguments.array(q, "q"), _arguments.array(rate, "rate"))
        outside = None
        if position is not None and velocity is not None:
            outside = (_arguments.array(position, "position"), _arguments.array(velocity, "velocity"))
        self._stepper.place((spin, turn), inside, outside)

    @property
    def range(self) -> NDArray[np.float64] | None:
        """Spins (rad/s) below which reduced equations hold, and from which they fail; None of the full system."""
        found = self._stepper.range
        return None if found is None else np.array(found)

    @property
    def wrong(self) -> str | None:
        """Reason for which the equations are not those of the body; its status is ``fails`` then."""
        return self._stepper.wrong

    @property
    def notes(self) -> list[str]:
        """Notes to read before the numbers."""
        return self._stepper.notes

    def __repr__(self) -> str:
        return f"quasirigid.Stepper: t = {self.time:g} s, {self.status}"
