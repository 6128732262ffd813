"""The reduced equations: vectorised values, coefficients, SymPy."""

from __future__ import annotations

import html
import json
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid import _arguments, _core

if TYPE_CHECKING:
    import sympy as _sympy

    from quasirigid._model import Model

__all__ = ["Part", "Reduced", "SympyEquations"]


class Part(NamedTuple):
    """One degree of a polynomial in the angular velocity.

    >>> import quasirigid
    >>> part = quasirigid.Model(quasirigid.EXAMPLE).reduce().coefficients("torque")[1]
    >>> part.degree, part.exponents.shape, part.values.shape
    (4, (15, 3), (15, 3))
    """

    degree: int
    """Degree; with momentum wheels, the part has lower monomials too."""
    exponents: NDArray[np.int64]
    """Exponents of ωx, ωy, ωz in each monomial, ``(m, 3)``."""
    values: NDArray[np.float64]
    """Coefficients of each monomial in SI units, ``(m, 3)`` of a vector, ``(m, 1)`` of a number."""


class SympyEquations(NamedTuple):
    """The reduced equations as expressions of SymPy."""

    omega: tuple[_sympy.Symbol, _sympy.Symbol, _sympy.Symbol]
    """Angular velocity (rad/s), body axes: ``wx``, ``wy``, ``wz``."""
    torque: _sympy.Matrix
    """Deviation torque μ(ω) (N·m)."""
    angular_momentum: _sympy.Matrix
    """Angular momentum K(ω) (N·m·s)."""
    rate: _sympy.Matrix
    """Rate of the angular velocity (rad/s²), without forces."""
    power: _sympy.Expr
    """Power dissipated (W)."""
    energy: _sympy.Expr
    """Energy (J)."""


class Reduced:
    """Reduced equations of a body: Euler's with a small torque, polynomials in the angular velocity.

    Methods take arrays ``(..., 3)`` of angular velocities (rad/s, body axes).

    >>> import numpy as np, quasirigid
    >>> reduced = quasirigid.Model(quasirigid.EXAMPLE).reduce(order=3)
    >>> omega = np.array([[-0.17, 1.24, -0.05], [0.0, 0.0, 1.0]])
    >>> reduced.torque(omega).shape, reduced.power(omega) >= 0
    ((2, 3), array([ True,  True]))
    """

    __slots__ = ("_model", "_order", "_reduced")

    def __init__(self, model: Model, order: int | None, reduced: _core.Reduced) -> None:
        self._model = model
        self._order = order
        self._reduced = reduced

    @property
    def order(self) -> int:
        """Order p: the motion over a fixed time is in error by ε to the power p + 1."""
        return self._reduced.order

    @property
    def mass(self) -> float:
        """Mass (kg)."""
        return self._reduced.mass

    @property
    def inertia(self) -> NDArray[np.float64]:
        """Inertia tensor of the frozen body about the pole (kg·m²), in the file's axes, ``(3, 3)``."""
        part = self.coefficients("angular_momentum")[0]
        tensor = np.zeros((3, 3))
        for exponents, value in zip(part.exponents, part.values, strict=True):
            if exponents.sum() == 1:
                tensor[:, int(exponents.argmax())] = value
        return tensor

    @property
    def notes(self) -> list[str]:
        """Notes to read before the numbers."""
        return self._reduced.notes

    def torque(self, omega: ArrayLike) -> NDArray[np.float64]:
        """Deviation torque μ(ω) of ``J dω/dt + ω × Jω = μ(ω)`` (N·m), body axes, ``(..., 3)``.

        Raises:
            InputError: for an array that is not ``(..., 3)`` or not of real numbers.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).reduce().torque([0, 0, 1.0]).shape
        (3,)
        """
        return self._vectors(self._reduced.torque, omega)

    def angular_momentum(self, omega: ArrayLike) -> NDArray[np.float64]:
        """Angular momentum K(ω) on the slow manifold (N·m·s), body axes, ``(..., 3)``."""
        return self._vectors(self._reduced.angular_momentum, omega)

    def angular_velocity(self, K: ArrayLike) -> NDArray[np.float64]:
        """Angular velocity ω(K) of the energy form (rad/s), of angular momenta (N·m·s), body axes, ``(..., 3)``."""
        return self._vectors(self._reduced.angular_velocity, K)

    def momentum_rate(self, K: ArrayLike) -> NDArray[np.float64]:
        """Rate of the angular momentum in body axes ``K × ω(K)`` (N·m), without forces, ``(..., 3)``.

        The energy form keeps ``|K|`` and loses exactly its power, whatever the order.
        """
        return self._vectors(self._reduced.momentum_rate, K)

    def rate(self, omega: ArrayLike) -> NDArray[np.float64]:
        """Rate of the angular velocity without forces (rad/s²), body axes, ``(..., 3)``."""
        return self._vectors(self._reduced.rate, omega)

    def power(self, omega: ArrayLike) -> NDArray[np.float64]:
        """Power dissipated (W), never negative, ``(...,)``."""
        return self._numbers(self._reduced.power, omega)

    def energy(self, omega: ArrayLike) -> NDArray[np.float64]:
        """Energy of the whole body on the slow manifold (J), ``(...,)``."""
        return self._numbers(self._reduced.energy, omega)

    def coefficients(self, of: str) -> list[Part]:
        """Coefficients of ``torque``, ``angular_momentum``, ``rate``, ``power`` or ``energy``, degree by degree.

        Raises:
            InputError: for another name.

        >>> import quasirigid
        >>> [part.degree for part in quasirigid.Model(quasirigid.EXAMPLE).reduce().coefficients("power")]
        [2, 3, 4, 5, 6]
        """
        return [Part(*part) for part in self._reduced.coefficients(_arguments.word(of, "of") or "")]

    def to_dict(self) -> dict[str, Any]:
        """The object that ``quasirigid derive --json`` prints."""
        equations: dict[str, Any] = json.loads(self._reduced.json())
        return equations

    def to_latex(self) -> str:
        """Displays for a document that loads amsmath."""
        return self._reduced.latex()

    def to_sympy(self) -> SympyEquations:
        """The equations as expressions of SymPy, coefficients as floats of double precision.

        Raises:
            ImportError: without SymPy.

        >>> import quasirigid
        >>> equations = quasirigid.Model(quasirigid.EXAMPLE).reduce().to_sympy()
        >>> equations.torque.shape
        (3, 1)
        """
        try:
            import sympy
        except ImportError as error:
            raise ImportError("expressions need SymPy; install it with: pip install sympy") from error
        omega = sympy.symbols("wx wy wz", real=True)

        def rows(of: str) -> Any:
            parts = self.coefficients(of)
            columns = parts[0].values.shape[1] if parts else 1
            sums = [sympy.Integer(0)] * columns
            for part in parts:
                for exponents, values in zip(part.exponents.tolist(), part.values.tolist(), strict=True):
                    monomial = sympy.prod([w**power for w, power in zip(omega, exponents, strict=True)])
                    for row, value in enumerate(values):
                        if value != 0.0:
                            sums[row] += sympy.Float(value) * monomial
            return sums

        torque, momentum, rate = (sympy.Matrix(rows(of)) for of in ("torque", "angular_momentum", "rate"))
        return SympyEquations(omega, torque, momentum, rate, rows("power")[0], rows("energy")[0])

    def _vectors(self, value: Any, omega: ArrayLike) -> NDArray[np.float64]:
        given = _arguments.vectors(omega, "omega")
        found: NDArray[np.float64] = value(given.reshape(-1, 3)).reshape(given.shape)
        return found

    def _numbers(self, value: Any, omega: ArrayLike) -> NDArray[np.float64]:
        given = _arguments.vectors(omega, "omega")
        found: NDArray[np.float64] = value(given.reshape(-1, 3)).reshape(given.shape[:-1])
        return found

    def __str__(self) -> str:
        return self._reduced.text

    def __repr__(self) -> str:
        return f"quasirigid.Reduced: {self._reduced.name}, order {self.order}"

    def _repr_html_(self) -> str:
        notes = "".join(f"<p>Note: {html.escape(note)}</p>" for note in self.notes)
        return f"{notes}<pre>{html.escape(str(self))}</pre>"

    def __reduce__(self) -> tuple[object, ...]:
        return _reduced, (self._model, self._order)


def _reduced(model: Model, order: int | None) -> Reduced:
    return model.reduce(order)
