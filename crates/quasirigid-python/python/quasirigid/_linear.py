"""Linear models, and their ways into other tools; each tool is imported where it is asked for."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid import _core
from quasirigid._answers import Answer, _matrix
from quasirigid._errors import InputError
from quasirigid._property import entry

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Linear"]


def _names(channels: list[dict[str, str]]) -> list[str]:
    return [channel["name"] for channel in channels]


class Linear(Answer):
    """Linear model ``dx/dt = A x + B u``, ``y = C x + D u`` about rest or a steady spin.

    >>> import quasirigid
    >>> plant = quasirigid.Model(quasirigid.EXAMPLE).linear(at="rest", outputs=["rate.y", "attitude.y"])
    >>> plant.inputs, plant.C.shape
    (['torque.x', 'torque.y', 'torque.z'], (2, 18))
    """

    __slots__ = ()

    A = entry(_matrix, "Matrix of the states, ``(n, n)``.")
    B = entry(_matrix, "Matrix of the inputs, ``(n, inputs)``.")
    C = entry(_matrix, "Matrix of the outputs, ``(outputs, n)``.")
    D = entry(_matrix, "Matrix from inputs to outputs, ``(outputs, inputs)``.")
    states = entry(_names, "Names of the states; units in ``to_dict()``.")
    inputs = entry(_names, "Names of the inputs.")
    outputs = entry(_names, "Names of the outputs.")

    def frequency_response(self, omega: ArrayLike) -> NDArray[np.complex128]:
        """Transfer matrix at frequencies (rad/s) ``(k,)``, as ``(k, outputs, inputs)``.

        >>> import quasirigid
        >>> plant = quasirigid.Model(quasirigid.EXAMPLE).linear(at="rest")
        >>> plant.frequency_response([0.1, 1.0]).shape
        (2, 3, 3)
        """
        A, B, C, D = self.A, self.B, self.C, self.D
        s = 1j * np.asarray(omega, dtype=np.float64)
        solved = np.linalg.solve(s[:, None, None] * np.eye(len(A)) - A, B.astype(np.complex128))
        return np.asarray(C @ solved + D, dtype=np.complex128)

    def truncated(self, states: int, *, method: str = "balanced") -> Linear:
        """The model with fewer states, and a bound on the error, which its text and ``sentence`` give first.

        Rigid motions are kept. Errors are those of ``frequency_response``, largest singular value, between inputs and outputs
        divided by ``input_scales`` and ``output_scales`` of ``to_dict()["truncation"]``; 1 is the largest response of the
        vibrations.

        Args:
            states: Number of states to keep.
            method: ``balanced`` keeps what decays by its Hankel singular values, with a bound at all frequencies; ``modal`` keeps
                the slowest modes and the static response of the others, with a bound up to ``up_to`` (rad/s).

        Raises:
            InputError: for a number of states that is not possible, with those that are.

        >>> import quasirigid
        >>> plant = quasirigid.Model(quasirigid.EXAMPLE).linear(at="rest")
        >>> plant.truncated(10).A.shape
        (10, 10)
        """
        return Linear(_core.linear_truncated(json.dumps(self.to_dict()), method, states, self.notes))

    def to_scipy(self) -> Any:
        """``scipy.signal.StateSpace`` of the matrices."""
        from scipy.signal import StateSpace

        return StateSpace(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """``control.ss`` of the matrices for python-control, with the names of states, inputs and outputs, whose dots it does not take, as
        ``torque_x``.
        """
        import control

        names = {
            kind: [name.replace(".", "_") for name in channels]
            for kind, channels in (("states", self.states), ("inputs", self.inputs), ("outputs", self.outputs))
        }
        return control.ss(self.A, self.B, self.C, self.D, **names)

    def to_xarray(self, omega: ArrayLike) -> Any:
        """Transfer matrix at frequencies (rad/s) ``(k,)``, as a ``xarray.DataArray`` over ``omega``, ``output`` and ``input``.

        >>> import quasirigid
        >>> plant = quasirigid.Model(quasirigid.EXAMPLE).linear(at="rest")
        >>> plant.to_xarray([0.1, 1.0]).sel(output="rate.y", input="torque.y").shape
        (2,)
        """
        from xarray import DataArray

        coordinates = {"omega": np.asarray(omega, dtype=np.float64), "output": self.outputs, "input": self.inputs}
        return DataArray(self.frequency_response(omega), coordinates, ("omega", "output", "input"), "response")

    def bode(self, omega: ArrayLike, *, input: str | None = None, output: str | None = None, ax: Any = None) -> Figure:
        """Gain and phase over frequencies (rad/s); of the first input and output by default.

        Args:
            ax: Two axes of matplotlib, for the gain (dB) and the phase (degrees); a new figure by default.
        """
        from quasirigid import _plot

        return _plot.bode(np.asarray(omega, dtype=np.float64), *self._channel(omega, input, output), ax)

    def nichols(self, omega: ArrayLike, *, input: str | None = None, output: str | None = None, ax: Any = None) -> Figure:
        """Gain (dB) over phase (degrees) at frequencies (rad/s); of the first input and output by default.

        Args:
            ax: Axes of matplotlib; a new figure by default.
        """
        from quasirigid import _plot

        return _plot.nichols(*self._channel(omega, input, output), ax)

    def _channel(self, omega: ArrayLike, input: str | None, output: str | None) -> tuple[NDArray[np.complex128], str]:
        places = []
        for name, known in ((output, self.outputs), (input, self.inputs)):
            if name is not None and name not in known:
                raise InputError(f"{name!r} is not among {known}")
            places.append(0 if name is None else known.index(name))
        label = f"{self.outputs[places[0]]} by {self.inputs[places[1]]}"
        return self.frequency_response(omega)[:, places[0], places[1]], label

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes matrices, names and units into a ``.mat`` file for MATLAB and Octave, or a ``.npz`` file.

        Raises:
            InputError: for another ending.
        """
        file = Path(path)
        file.write_bytes(bytes(_core.linear_file(file.name, json.dumps(self.to_dict()))))
