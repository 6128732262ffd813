"""Answers of the study: validity, modes, histories, evolution, verification, records."""

from __future__ import annotations

import copy
import html
import math
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NoReturn, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid import _arguments, _core, _settings
from quasirigid._attitude import Attitudes
from quasirigid._errors import InputError, Refused
from quasirigid._progress import Progress, observer
from quasirigid._property import Named, column, entry, part
from quasirigid._table import Table, Tabled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["AboutSpin", "Answer", "Check", "Design", "EffectiveMasses", "Evolution", "FillMap", "History", "Inferred", "LightCurve", "Modes", "Run", "Sensitivity", "Verification"]


def _array(values: list[float | None]) -> NDArray[np.float64]:
    return np.array([math.nan if value is None else value for value in values], dtype=np.float64)


def _of_each(key: str) -> Callable[[list[dict[str, Any]]], NDArray[np.float64]]:
    return lambda modes: _array([mode[key] for mode in modes])


def _copy(table: dict[str, Any]) -> dict[str, Any]:
    return copy.deepcopy(table)


def _copies(tables: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return copy.deepcopy(tables)


def _time(doc: str) -> Named[float]:
    return Named(lambda answer, name: float(answer._parts["numbers"][name]), doc)


def _number(doc: str) -> Named[float | None]:
    return Named(lambda answer, name: None if math.isnan(value := float(answer._parts["numbers"][name])) else value, doc)


class Answer:
    """Answer of a study, which says first whether it holds.

    An answer that does not hold is false (``if not answer: ...``), begins its text with the reason, and has ``None`` for
    numbers that the program does not give either. ``require()`` turns it into an exception.

    >>> import quasirigid
    >>> answer = quasirigid.Model(quasirigid.EXAMPLE).check()
    >>> answer.holds, answer.sentence
    (True, 'The reduced equations hold at this spin.')
    """

    __slots__ = ("_parts", "_table")

    def __init__(self, parts: dict[str, Any]) -> None:
        self._parts = parts
        columns = parts.get("columns")
        self._table = None if columns is None else Table(columns)

    holds = part(bool, "Whether the answer holds; the program's exit code is 0 then.")
    sentence = part(str, "The answer in one or two sentences.")
    notes = part(list[str], "Notes to read before the numbers.")

    def to_dict(self) -> dict[str, Any]:
        """The object that the program prints with ``--json``, SI units throughout; a copy.

        >>> import quasirigid
        >>> sorted(quasirigid.Model(quasirigid.EXAMPLE).check().to_dict())[:3]
        ['T1', 'T2', 'T3']
        """
        answer: dict[str, Any] = copy.deepcopy(self._parts["json"])
        return answer

    def require(self) -> Self:
        """The answer itself, if it holds.

        Raises:
            Refused: with the sentence, if it does not.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).check().require().T3 > 0
        True
        """
        if not self.holds:
            raise Refused(self.sentence)
        return self

    def __bool__(self) -> bool:
        return self.holds

    def __str__(self) -> str:
        return str(self._parts["text"])

    def __repr__(self) -> str:
        kind, notes = f"quasirigid.{type(self).__name__}", self.notes
        if self.holds:
            counted = f", {len(notes)} note{'s' * (len(notes) > 1)}" if notes else ""
            return f"{self.sentence}\n({kind}{counted})"
        told = "".join(f"\nNote: {note}" for note in notes if note not in self.sentence)
        return f"DOES NOT HOLD: {self.sentence}{told}\n({kind})"

    def _repr_html_(self) -> str:
        verdict = "" if self.holds else f"<p><strong>DOES NOT HOLD:</strong> {html.escape(self.sentence)}</p>"
        notes = "".join(f"<p>Note: {html.escape(note)}</p>" for note in self.notes)
        return f"{verdict}{notes}<pre>{html.escape(str(self))}</pre>"

    def __reduce__(self) -> tuple[object, ...]:
        columns = None if self._table is None else self._table
        return _answer, (type(self), {**self._parts, "columns": None}, columns)


def _answer(kind: type[Answer], parts: dict[str, Any], table: Table | None) -> Answer:
    answer = kind(parts)
    answer._table = table
    return answer


class Check(Answer):
    """Validity of the reduced equations at the spin of the start.

    >>> import quasirigid
    >>> check = quasirigid.Model(quasirigid.EXAMPLE).check()
    >>> check.verdict, check.frequencies.shape
    ('holds', (6,))
    """

    __slots__ = ()

    valid = entry(bool, "Whether no criterion of the motion fails.")
    verdict = entry(str, "``holds``, ``marginal`` or ``fails``, of the motion.")
    dissipation_verdict = entry(str, "The same of the power that is dissipated.")
    averages = entry(str, "The same of averages along rigid polhodes.")
    reasons = entry(list[str], "Sentences of the criteria that do not hold, the worst first.")
    T1 = _time("Longest period of free vibration (s).")
    T2 = _time("Time in which the slowest free vibration decays by e (s); infinite without damping.")
    T3 = _time("Time of the spin, 1/|ω| (s).")
    frequencies = entry(_array, "Elastic frequencies (rad/s), ascending, ``(n,)``.")
    free_frequencies = entry(_array, "The same of the body that is free to turn (rad/s), ``(n,)``.")
    decay_rates = entry(_array, "Decay rates of the free vibrations (1/s), ``(n,)``.")
    relaxation_times = entry(_array, "Times in which rotors and liquids come to rest (s), descending, ``(n,)``.")
    criteria = entry(_copies, "Every criterion: ``name``, ``symbol``, ``value``, ``limit``, ``verdict``, ``sentence``.")
    dissipation = entry(dict[str, float], "Shares of the dissipators in the power, by name.")
    optimal_order = entry(int, "Order at which the terms of the series are smallest at this spin.")
    steady_spins = entry(_copies, "Steady spins with the modes about them.")


def _matrix(rows: list[list[float]]) -> NDArray[np.float64]:
    return np.array(rows, dtype=np.float64)


class EffectiveMasses(Answer):
    """Cantilever modes of the parts on the held carrier, with the masses that they carry.

    >>> import quasirigid
    >>> found = quasirigid.Model(quasirigid.EXAMPLE).effective_masses()
    >>> bool((found.delta_t[0] ** 2 <= found.to_dict()["parts"]["mass"]).all())
    True
    """

    __slots__ = ()

    cantilever = entry(_copies, "Every cantilever mode, with ``name``, ``frequency``, ``damping_ratio`` and effective masses.")
    delta_t = entry(_matrix, "Participation factors in translations (kg^½), ``(n, 3)``.")
    delta_r = entry(_matrix, "Participation factors in rotations (kg^½·m), ``(n, 3)``.")
    residual_mass = entry(_array, "Mass of the parts along each axis that no mode carries (kg), ``(3,)``.")
    residual_inertia = entry(_array, "Inertia of the parts about each axis that no mode carries (kg·m²), ``(3,)``.")
    free = entry(_copies, "Modes of the body at rest, with the motion of the carrier.")

    @property
    def frequencies(self) -> NDArray[np.float64]:
        """Frequencies with the carrier held (rad/s), ascending, ``(n,)``."""
        return _of_each("frequency")(self._parts["json"]["cantilever"])

    @property
    def damping_ratios(self) -> NDArray[np.float64]:
        """Damping ratios of each mode alone, ``(n,)``."""
        return _of_each("damping_ratio")(self._parts["json"]["cantilever"])


class Modes(Answer):
    """Steady spins and the small motions about them.

    >>> import quasirigid
    >>> modes = quasirigid.Model(quasirigid.EXAMPLE).modes(axis="greatest")
    >>> modes.stable, modes.modes[0]["name"]
    (True, 'nutation')
    """

    __slots__ = ()

    steady_spins = entry(
        _copies,
        "Every steady spin, with ``sentence``, ``axis``, ``spin``, ``momentum``, ``energy``, ``stable`` and ``modes``.",
    )

    @property
    def spin(self) -> NDArray[np.float64] | None:
        """Angular velocity of the first steady spin (rad/s), body axes, ``(3,)``; ``None`` if none was found."""
        spin = self._parts["json"]["spin"]
        return None if spin is None else _array(spin)

    stable = entry(bool, "Whether no small motion about the first steady spin grows.")

    def require_stable(self) -> Self:
        """The answer itself, if no small motion about the first steady spin grows: a spin that is unstable has modes all the same.

        Raises:
            Refused: with the sentence, if one grows or no steady spin was found.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).modes(axis="greatest").require_stable().stable
        True
        """
        if not (self.holds and self.stable):
            raise Refused(self.sentence)
        return self

    def __getitem__(self, name: str) -> dict[str, Any]:
        """The mode of this name about the first steady spin.

        Raises:
            KeyError: with the names there are, if there is none, and with the modes, if several have it.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).modes(axis="greatest")["nutation"]["time_constant"] > 0
        True
        """
        found = [(place, mode) for place, mode in enumerate(self.modes) if mode["name"] == name]
        if len(found) == 1:
            return found[0][1]
        if found:
            several = ", ".join(
                f"modes[{place}] (frequency {mode['frequency']:.4g} rad/s, decay rate {mode['decay_rate']:.4g} 1/s)"
                for place, mode in found
            )
            raise KeyError(f"{len(found)} modes have the name {name!r}; take one by its place: {several}")
        names = ", ".join(dict.fromkeys(str(mode["name"]) for mode in self.modes))
        raise KeyError(f"{name!r} is no mode; the modes are {names}")

    modes = entry(
        _copies,
        """Modes about the first steady spin, the nutation first, overdamped ones last: ``name``, ``neutral``, ``overdamped``,
        ``decay_rate`` (1/s), ``frequency`` (rad/s),
        ``time_constant`` (s), ``damping_ratio``, ``seen_from_outside`` (rad/s), shares ``moves`` and ``dissipation``.""",
    )
    decay_rates = entry(_of_each("decay_rate"), "Decay rates of the modes (1/s), negative for one that grows, ``(n,)``.", "modes")
    frequencies = entry(_of_each("frequency"), "Frequencies of the modes in body axes (rad/s), ``(n,)``.", "modes")
    time_constants = entry(
        _of_each("time_constant"),
        "Times in which the modes fall by e (s), negative for one that grows, NaN for a neutral one, ``(n,)``.",
        "modes",
    )

    def plot(self) -> Figure:
        """Decay rates against frequencies of the modes of every steady spin (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.modes(self)


class AboutSpin(Answer):
    """Reduced equations about a steady spin: the spin, the modes that they follow, their range, and the motion along their manifold.

    They do not hold if the nutation of the start is outside the range, or if the equations of motion get the liquids wrong.

    >>> import quasirigid
    >>> about = quasirigid.Model(quasirigid.EXAMPLE).about_spin(degree=5)
    >>> about.degree, bool(about.backbone["nutation"][32] == about.range["nutation"])
    (5, True)
    >>> about.simulate(duration=60, samples=3).system
    'manifold'
    """

    __slots__ = ()

    spin = entry(_array, "Angular velocity of the steady spin (rad/s), body axes, ``(3,)``.")
    angular_momentum = entry(_array, "Angular momentum of the steady spin (N·m·s), body axes, ``(3,)``.")
    axis = entry(str, "``least`` or ``greatest``: the principal axis of the steady spin.")
    degree = entry(int, "Degree in the amplitude.")
    style = entry(str, "``normal-form`` or ``graph``.")
    masters = entry(
        _copies,
        "Modes that the equations follow, the nutation first: ``name``, ``decay_rate`` (1/s), ``time_constant`` (s), "
        "``frequency`` (rad/s).",
    )
    range = entry(
        _copy,
        """Range: ``nutation`` and ``amplitude`` (rad) to which the equations leave less than ``share`` of motion and dissipation;
        ``beyond`` if it reaches as far as was looked.""",
    )

    @property
    def start(self) -> dict[str, Any] | None:
        """Start of the model: ``nutation`` and ``amplitude`` (rad), ``within`` the range, ``defect``, share ``left_out`` of its energy,
        ``coordinates``; ``None`` about an axis that it does not circle."""
        start: dict[str, Any] | None = copy.deepcopy(self._parts["json"]["start"])
        return start

    @property
    def backbone(self) -> Table:
        """Motion by the amplitude of the nutation, to a quarter beyond the range: ``amplitude`` and ``nutation`` (rad), ``decay_rate``
        (1/s), ``frequency`` (rad/s), ``power`` (W), ``defect``, and a ``share of`` the power for each dissipator."""
        assert self._table is not None
        return self._table

    outer = entry(_copies, "Modes left out: ``name``, ``decay_rate`` (1/s), ``frequency`` (rad/s).")
    resonances = entry(
        _copies,
        "Near resonances of monomials with modes left out, nearest first: ``exponents``, ``name``, ``frequency``, ``distance``.",
    )
    variables = entry(
        list[str],
        "Names of the coordinates, to which the exponents belong: ``z1``, its conjugate ``z1*``, and those of the next master.",
    )

    def coefficients(self, master: int = 0) -> tuple[NDArray[np.int64], NDArray[np.complex128]]:
        """Coefficients of the rate of a master: exponents ``(n, variables)`` and complex values ``(n,)``, with
        ``dz/dt = sum(values * prod(z**exponents))``.

        >>> import numpy as np, quasirigid
        >>> about = quasirigid.Model(quasirigid.EXAMPLE).about_spin()
        >>> exponents, values = about.coefficients()
        >>> nutation = about.masters[0]
        >>> bool(np.isclose(values[0], -nutation["decay_rate"] + 1j * nutation["frequency"]))
        True
        """
        terms = [term for term in self._parts["json"]["R"] if term["master"] == master]
        exponents = np.array([term["exponents"] for term in terms], dtype=np.int64)
        values = np.array([complex(*term["value"]) for term in terms], dtype=np.complex128)
        return exponents.reshape(len(terms), len(self.variables)), values

    def simulate(
        self,
        *,
        duration: float | str | None = None,
        samples: int | None = None,
        times: ArrayLike | None = None,
        tolerance: float | None = None,
        coordinates: bool = False,
        displacements: bool = False,
        progress: Progress = False,
    ) -> History:
        """History by these equations from the start of the model, as ``Model.simulate`` has it.

        It does not hold if it leaves the range; its sentence says when.

        Raises:
            InputError: about an axis that the start does not circle, and for settings out of range.
        """
        if self.start is None:
            raise InputError("the start does not circle this axis; leave out axis")
        settings = _settings.run(duration, samples, tolerance, times=times)
        table = _settings.table("spin-manifold", self._parts["settings"], coordinates, displacements, times)
        with observer(progress) as watch:
            model = self._parts["model"]
            return History({**model._core.simulate(settings, table, None, None, watch), "object": model.name})


class _Tabled(Answer, Tabled):
    """Answer with a table."""

    __slots__ = ()

    t = column("Times of the rows (s), ``(rows,)``.")
    energy = column("Energy (J), ``(rows,)``.")

    def __getitem__(self, name: str) -> Any:
        """A column of the table by its name."""
        return self.table[name]

    def __iter__(self) -> NoReturn:
        """Refuses: an answer is no list of its rows."""
        raise TypeError(f"a {type(self).__name__} is not iterable; take columns by name, or its table")


class History(_Tabled, Attitudes):
    """A history of the spin.

    It does not hold if the integration broke off, if the reduced equations fail at the start, or if the equations of motion get
    the liquids wrong; ``notes`` say which.

    >>> import quasirigid
    >>> history = quasirigid.Model(quasirigid.EXAMPLE).simulate(duration="1 min", samples=7)
    >>> history.t.shape, history.angular_velocity.shape
    ((7,), (7, 3))
    """

    __slots__ = ()

    system = entry(str, "``full``, ``reduced``, ``rigid`` or ``manifold``.")
    status = entry(str, "``finished``, ``event``, or why the history ended early.")
    momentum = column("Size of the angular momentum (N·m·s), ``(rows,)``.")
    dissipated = column("Energy dissipated since the start (J), ``(rows,)``.")
    energy_drift = column("Change of energy made by the integrator alone since the start (J), ``(rows,)``.")
    dissipation = entry(dict[str, float], "Shares of the dissipators in the energy dissipated, by name.")
    turns = entry(float, "Revolutions made, ∫|ω|dt / 2π.")

    @property
    def _object(self) -> str:
        return str(self._parts["object"])

    def plot(self) -> Figure:
        """Angular velocity and energy against time (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.history(self)


class LightCurve(Answer, Tabled):
    """Brightness of the rotating body over time, as an observer sees it.

    It is false where the rotation does not hold or the facets are too coarse for the shadows; ``notes`` say which.

    >>> import quasirigid
    >>> model = quasirigid.Model.from_file("examples/toutatis/model.toml")
    >>> curve = model.light_curve(sun=(1, 0, 0), observer=(0.9, 0.4, 0.1), duration="30 d", samples=61)
    >>> curve.magnitude.shape, curve.amplitude > 0.5
    ((61,), True)
    """

    __slots__ = ()

    t = column("Times (s), ``(rows,)``.")
    brightness = column("Area (m²) of the disc that is as bright as a white sphere at opposition; times the albedo, if any, ``(rows,)``.")
    magnitude = column("Magnitude at one astronomical unit from Sun and observer, relative to the mean without an albedo, ``(rows,)``.")
    phase_angle = column("Angle between Sun and observer as seen from the body (rad), ``(rows,)``.")
    amplitude = entry(float, "Greatest less least magnitude.")
    surface = entry(_copy, "Facets: ``kind``, ``facets``, ``convex``, ``error`` (relative), ``cross_section`` (m²).")
    residuals = entry(copy.deepcopy, "Comparison with measured brightness, block by block, or ``None``.")
    periods = entry(copy.deepcopy, "Frequencies found in the curve, or ``None`` if not asked for.")

    def __getitem__(self, name: str) -> Any:
        """A column of the table by its name."""
        return self.table[name]

    def __iter__(self) -> NoReturn:
        """Refuses: an answer is no list of its rows."""
        raise TypeError("a LightCurve is not iterable; take columns by name, or its table")

    def plot(self) -> Figure:
        """Magnitude against time, bright above (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.light_curve(self)


class Evolution(_Tabled):
    """Secular evolution of the rotation, averaged over its nutation.

    Where no method holds, the sentence says so and why, and ``time``, ``turns`` and ``power`` are ``None``. An evolution that
    ended before its target (``status`` is ``held``, ``rest``, ``spun-up``, ...) does not hold either, and has the numbers up to there.

    >>> import quasirigid
    >>> evolution = quasirigid.Model(quasirigid.EXAMPLE).evolve()
    >>> evolution.mode_start, evolution.mode_end
    ('long-axis', 'short-axis')
    >>> round(evolution.require().time / 3600, 2)
    10.72
    """

    __slots__ = ()

    status = entry(str, "``finished``, ``refused``, ``does-not-hold``, or how the evolution ended before its target.")
    message = entry(str, "End of the evolution, in a sentence.")
    time = _number("Time from the start to the end (s); infinite where the end is never reached, ``None`` where no method holds.")
    turns = _number("Revolutions about the angular momentum; infinite or ``None`` as ``time``.")
    power = _number("Mean power dissipated at the start (W); ``None`` where no method holds.")
    damping_time = _number("Time in which a small nutation about the axis of greatest inertia decays by e (s); ``None`` if not known.")
    growth_time = _number("Time in which a small nutation about the axis of least inertia grows by e (s); ``None`` if not known.")

    @property
    def time_error(self) -> float | None:
        """Estimate of the relative error of ``time``; ``None`` if not known."""
        error: float | None = self._parts["json"]["time_error"]
        return error

    @property
    def time_range(self) -> tuple[float, float] | None:
        """Least and greatest ``time`` (s) over the ranges of the materials; ``None`` without ranges."""
        ends = self._parts["json"]["time_range"]
        if ends is None or self.time is None:
            return None
        least, greatest = (math.inf if end is None else float(end) for end in ends)
        return least, greatest

    @property
    def uncertainty(self) -> dict[str, Any] | None:
        """Intervals over the draws of the model's uncertain keys, with the keys that decide; ``None`` where none were drawn."""
        found: dict[str, Any] | None = self._parts["json"].get("uncertainty")
        return found

    @property
    def separatrix_time(self) -> float | None:
        """Time from the start to the separatrix (s); ``None`` if it is not passed."""
        time: float | None = self._parts["json"]["separatrix_time"]
        return None if self.time is None else time

    @property
    def mode_start(self) -> str:
        """``short-axis`` or ``long-axis``, at the start; ``steady-spin`` with momentum wheels."""
        return str(self._parts["json"]["mode"]["start"])

    @property
    def mode_end(self) -> str:
        """The same at the end."""
        return str(self._parts["json"]["mode"]["end"])

    method = entry(str, "Method by which the evolution was followed, in words.")
    dissipation = entry(dict[str, float], "Shares of the dissipators in ``power``, by name.")

    def plot(self) -> Figure:
        """Nutation and energy against time (needs matplotlib).

        Raises:
            Refused: if there is no row to draw.
        """
        from quasirigid import _plot

        return _plot.evolution(self)


class Verification(Answer):
    """The reduced equations against the full system, with the measured order of convergence.

    >>> import quasirigid
    >>> verification = quasirigid.Model(quasirigid.EXAMPLE).verify(orders=[3], revolutions=1, halvings=2)
    >>> verification.reached, verification.orders[0]["p"]
    (True, 3)
    """

    __slots__ = ()

    reached = entry(bool, "Whether every order was reached.")
    orders = entry(_copies, "One entry for each order: ``p``, ``order`` (measured), ``expected``, ``reached``, ``epsilons``, ``errors``.")

    def plot(self) -> Figure:
        """Differences against ε, with their orders (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.verification(self)


class Inferred(Answer):
    """Numbers of a model inferred from measurements.

    >>> import pathlib, tempfile
    >>> import quasirigid
    >>> model = quasirigid.Model(quasirigid.EXAMPLE)
    >>> history = model.simulate(duration="20 s", samples=21)
    >>> rows = [f"{t},{wx}" for t, wx in zip(history.t, history.angular_velocity[:, 0])]
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "measured.csv"
    >>> _ = path.write_text("\\n".join(["t,wx", *rows]))
    >>> found = model.infer(path, ["carrier.inertia.1"])
    >>> round(found.values["carrier.inertia.1"], 6)
    9.0
    """

    __slots__ = ()

    parameters = entry(
        _copies,
        "One entry for each key: ``key``, ``value``, ``sigma``, ``interval_68``, ``interval_95``, ``profiled``, ``at_bound``, "
        "``unit``, ``before``.",
    )
    measured = entry(_copies, "One entry for each measured answer: ``quantity``, ``value``, ``sigma``, ``fitted``, ``residual``, ``unit``.")
    chi2 = entry(float, "Sum of the squares of the residuals over their deviations, of outliers left out under a robust loss.")
    degrees_of_freedom = entry(int, "Number of the values in ``chi2`` less that of keys at no bound.")
    outliers = entry(int, "Number of values more than four deviations off.")
    not_distinguished = entry(_copies, "Combinations of keys that the data do not tell: ``changes``, ``sigma``.")

    @property
    def values(self) -> dict[str, float]:
        """Values that fit best, by key."""
        return {each["key"]: each["value"] for each in self._parts["json"]["parameters"]}

    @property
    def covariance(self) -> NDArray[np.float64]:
        """Covariance of the keys, ``(n, n)``; not a number for those that the data do not tell."""
        return np.array(self._parts["json"]["covariance"], dtype=np.float64)


class Design(Answer):
    """Plans of measurements and what they would tell; false where no plan tells every key.

    >>> import quasirigid
    >>> found = quasirigid.Model(quasirigid.EXAMPLE).design(["carrier.inertia.1"], ["wx +- 1e-3 rad/s"])
    >>> found.plans[0]["manoeuvre"], found.keys[0]["value"]
    ('as it stands', 9.0)
    """

    __slots__ = ()

    keys = entry(_copies, "One entry for each key: ``key``, ``value``, ``unit``.")
    plans = entry(
        _copies,
        "Plans, that which tells most first: ``manoeuvre``, ``sensors``, ``complete``, ``sigma`` (one for each key), ``worst``.",
    )
    not_answered = entry(_copies, "Manoeuvres without an answer: ``manoeuvre``, ``reason``.")


class FillMap(Answer):
    """Time constants of a body over the fill of its tanks and its spin, with the worst fill of each spin.

    It is false where a point is not answered or the worst one may not hold; each point tells its ``status`` and ``reason``.

    >>> import quasirigid
    >>> model = quasirigid.Model.from_file("examples/two-tanks/model.toml")
    >>> found = model.fills(fill=(0.2, 0.8), spin=(2.0, 2.0), points=(3, 1))
    >>> found.time_constants.shape, found.worst[0]["fill"]
    ((1, 3), 0.8)
    """

    __slots__ = ()

    tanks = entry(list, "Names of the tanks that are filled, all alike.")
    points = entry(_copies, "One entry for each point, by spin, then by fill, with the keys of ``fills --json``.")
    worst = entry(_copies, "Worst point of each spin, between the points of the map too.")
    dips = entry(_copies, "Points at which the time constant is least between fills on both sides.")

    @property
    def spins(self) -> NDArray[np.float64]:
        """Spins of the map (rad/s), ``(m,)``."""
        return np.unique([point["spin"] for point in self._parts["json"]["points"]])

    @property
    def fills(self) -> NDArray[np.float64]:
        """Fills of the map, ``(n,)``."""
        return np.unique([point["fill"] for point in self._parts["json"]["points"]])

    @property
    def time_constants(self) -> NDArray[np.float64]:
        """Times in which the nutation falls by e (s), ``(m, n)``, negative where it grows; not a number where there is none."""
        times = [(point["nutation"] or {}).get("time_constant") for point in self._parts["json"]["points"]]
        return _array(times).reshape(self.spins.size, self.fills.size)

    def plot(self) -> Figure:
        """Map of the time constants over fill and spin, with the worst fill of each spin (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.fills(self)


class Sensitivity(Answer):
    """Derivatives of an answer with respect to numbers of the model, the largest effect first.

    >>> import quasirigid
    >>> time_constant = "modes.nutation.time_constant"
    >>> found = quasirigid.Model(quasirigid.EXAMPLE).sensitivity(time_constant, ["spring.1.damping"])
    >>> found.relative["spring.1.damping"] < 0
    True
    """

    __slots__ = ()

    value = entry(float, "Value of the quantity.")
    derivatives = entry(_copies, "One entry for each key: ``key``, ``value``, ``unit``, ``derivative``, ``relative``, ``error``.")
    not_known = entry(_copies, "Keys without a derivative: ``key``, ``reason``.")

    @property
    def relative(self) -> dict[str, float | None]:
        """Derivatives of the logarithm of the quantity with respect to that of each key; ``None`` if the quantity is zero."""
        return {each["key"]: each["relative"] for each in self._parts["json"]["derivatives"]}


class Run(Answer):
    """Record of a run: everything that the model asks for in ``[run]``.

    >>> import quasirigid
    >>> run = quasirigid.Model(quasirigid.EXAMPLE).run(duration="1 min", samples=11)
    >>> run.histories["reduced"].rows
    11
    """

    __slots__ = ("_run",)

    def __init__(self, run: _core.RunAnswer) -> None:
        self._run = run
        parts = {name: getattr(run, name) for name in ("json", "text", "sentence", "holds", "notes")}
        super().__init__({**parts, "columns": run.evolution})

    @property
    def histories(self) -> dict[str, Table]:
        """Tables of the histories by system: ``reduced``, ``rigid``, ``full``."""
        return {system: Table(columns) for system, columns in self._run.histories}

    @property
    def evolution(self) -> Table | None:
        """Table of the secular evolution; ``None`` where the model asks for none."""
        return self._table

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes the record, the reduced equations and the report into a new folder, which appears only when complete.

        Raises:
            FileError: if the folder already exists, or cannot be written.
        """
        self._run.write(_arguments.path(folder, "folder"))

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report, one self-contained HTML page; a file of that name is replaced once the new one is on the disk.

        Raises:
            FileError: if the file cannot be written.
        """
        self._run.report(_arguments.path(path, "path"))

    def plot(self) -> Figure:
        """Angular velocity and energy of every history against time (needs matplotlib)."""
        from quasirigid import _plot

        return _plot.run(self)

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("a Run is not pickled: write its record with write(folder), or send the model")
