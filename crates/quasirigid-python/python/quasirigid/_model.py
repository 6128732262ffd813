"""Models: immutable values that answer every question."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn, overload

from numpy.typing import ArrayLike

from quasirigid import _arguments, _core, _progress, _settings
from quasirigid._answers import (
    AboutSpin,
    Answer,
    Check,
    Design,
    EffectiveMasses,
    Evolution,
    FillMap,
    History,
    Inferred,
    LightCurve,
    Modes,
    Run,
    Sensitivity,
    Verification,
)
from quasirigid._ensemble import Evolutions, Histories, SpinPaths
from quasirigid._errors import InputError, ModelError
from quasirigid._linear import Linear
from quasirigid._progress import Progress, observer
from quasirigid._reduced import Reduced
from quasirigid._stepper import Stepper

__all__ = ["Model", "cite"]

# Name of a model without a file, in messages.
_NAMELESS = "model"


class Model:
    """Model of an almost rigid body: the text of a model file, read and checked.

    A model is an immutable value: equal to another with the same text and file, hashable, and pickled as its text. Its body is
    assembled at the first question.

    Every question takes ``order``, the order of the reduced equations (0 to 12; the model's own by default), and ``progress``:
    ``True`` for a bar of tqdm, or a function of the stage and the share done, which ends the work by returning ``False``.
    Ctrl-C ends any question within about a second. Durations are seconds, or texts such as ``"2 h"``.

    Args:
        text: Text of a model file (TOML).
        file: Name that stands for the file in messages; paths in the text are relative to its folder.

    Raises:
        ModelError: with the place and the reason of every mistake.

    >>> import quasirigid
    >>> model = quasirigid.Model(quasirigid.EXAMPLE)
    >>> model.name
    'boom satellite'
    >>> model == quasirigid.Model(quasirigid.EXAMPLE)
    True
    """

    __slots__ = ("_core",)
    _core: _core.Model

    def __init__(self, text: str, *, file: str | os.PathLike[str] = _NAMELESS) -> None:
        if not isinstance(text, str):
            raise InputError(f"the text of a model is a str, not {type(text).__name__}; for a file: Model.from_file")
        _set(self, _core.Model(_arguments.text(text, "the text of the model"), _arguments.path(file, "file")))

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Model:
        """Model of a file.

        Raises:
            MissingFileError, FileError: for a file that cannot be read.
            ModelError: with the place and the reason of every mistake.

        >>> import quasirigid, pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "boom.toml")
        >>> _ = path.write_text(quasirigid.EXAMPLE)
        >>> quasirigid.Model.from_file(path).name
        'boom satellite'
        """
        model = cls.__new__(cls)
        _set(model, _core.Model.read(os.path.abspath(_arguments.path(path, "path"))))
        return model

    @classmethod
    def from_dict(cls, model: Mapping[str, Any], *, file: str | os.PathLike[str] = _NAMELESS) -> Model:
        """Model of a dictionary in the vocabulary of the model file.

        Raises:
            InputError: for a value that a model file cannot hold.
            ModelError: as for a text.

        >>> import quasirigid
        >>> model = quasirigid.Model.from_dict({
        ...     "carrier": {"mass": 40.0, "center_of_mass": [0, 0.1, 0], "inertia": [9, 13, 16]},
        ...     "initial": {"angular_velocity": ["12 rpm", 0.35, 0.2]},
        ... })
        >>> model.check().valid
        True
        """
        if not isinstance(model, Mapping):
            raise InputError(f"a model is a dictionary, not {type(model).__name__}")
        return cls(_core.to_toml(dict(model)), file=file)

    def with_(self, changes: Mapping[str, Any]) -> Model:
        """Changed copy of the model, values replaced by path: ``{"spring.boom.stiffness": "600 N/m"}``.

        A path is a table, the name or the number (from 1) of an entry where the table is a list, and a key; further segments are
        keys of inner tables and numbers (from 1) of components. Names with blanks or dots stand in quotes, as in TOML. The last
        segment may be a new key.

        Raises:
            InputError: for a path that leads nowhere.
            ModelError: for an invalid model.

        >>> import quasirigid
        >>> model = quasirigid.Model(quasirigid.EXAMPLE)
        >>> stiffer = model.with_({"spring.1.stiffness": "600 N/m", 'point."tip 1".mass': 4.0, "run.order": 5})
        >>> stiffer.order, model.order
        (5, 3)
        """
        if not isinstance(changes, Mapping):
            raise InputError(f"changes are a dictionary of paths and values, not {type(changes).__name__}")
        try:
            return type(self)(_core.with_changes(self.text, dict(changes)), file=self.file)
        except ModelError as error:
            # the lines are those of the changed text, which stands in no file
            raise ModelError(f"in the changed copy: {error}", error.file, error.diagnostics) from None

    @property
    def text(self) -> str:
        """Text of the model file."""
        return self._core.text

    @property
    def file(self) -> Path:
        """File of the model, or the name that stands for it."""
        return self._core.file

    @property
    def name(self) -> str:
        """Name of the body."""
        return self._core.name

    @property
    def sha256(self) -> str:
        """SHA-256 of the text, in hexadecimal."""
        return self._core.sha256

    @property
    def order(self) -> int:
        """Order of the reduced equations that the model chooses."""
        return self._core.order

    def check(self, *, order: int | None = None, progress: Progress = False) -> Check:
        """Judges the reduced equations at the spin of the start.

        Raises:
            StartError: for an invalid start.
            ReductionError: where the reduction fails.

        >>> import quasirigid
        >>> print(quasirigid.Model(quasirigid.EXAMPLE).check())  # doctest: +ELLIPSIS
        boom satellite: The reduced equations hold at this spin.
        ...
        """
        with observer(progress) as watch:
            return Check(self._core.check(_arguments.count(order, "order"), watch))

    def modes(
        self,
        spin: ArrayLike | None = None,
        *,
        axis: str | None = None,
        certificate: str | os.PathLike[str] | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> Modes:
        """Finds steady spins and the small motions about them.

        Args:
            spin: Angular velocity (rad/s), ``(3,)``: the steady spin nearest to its direction, with its size. By default both
                poles, with the angular momentum of the start.
            axis: Principal axis to spin about: ``least``, ``middle`` or ``greatest``.
            certificate: New file for a certificate, with which ``tools/check_certificate.py`` checks the modes without this package.

        Raises:
            StartError: for an invalid start.
            InputError: for an axis of a body that moments act on.
            UnsupportedError: for a certificate that the answer cannot have.
            FileError: for a certificate that cannot be written.

        >>> import quasirigid
        >>> modes = quasirigid.Model(quasirigid.EXAMPLE).modes(axis="greatest")
        >>> bool(modes.time_constants[0] > 0)
        True
        """
        if isinstance(spin, str):
            raise InputError(f"spin = {spin!r} is a text; a principal axis is named by axis={spin!r}")
        vector = _arguments.vector(spin, "spin")
        name = _arguments.word(axis, "axis")
        with observer(progress) as watch:
            place = None if certificate is None else _arguments.path(certificate, "certificate")
            return Modes(self._core.modes(vector, name, place, _arguments.count(order, "order"), watch))

    def effective_masses(self, about: ArrayLike | None = None, *, progress: Progress = False) -> EffectiveMasses:
        """Gives the cantilever modes of the parts on the held carrier, with participation factors and effective masses.

        Args:
            about: Point that participation in rotations is about (m), ``(3,)``, in the file's frame; the centre of mass of the
                body, or the point of its support, by default.

        Raises:
            UnsupportedError: for a body without a carrier, or with parts that no spring holds.

        >>> import quasirigid
        >>> found = quasirigid.Model(quasirigid.EXAMPLE).effective_masses()
        >>> found.frequencies.shape, found.delta_t.shape
        ((6,), (6, 3))
        """
        vector = _arguments.vector(about, "about")
        with observer(progress) as watch:
            return EffectiveMasses(self._core.effective_masses(vector, watch))

    def fills(
        self,
        tanks: Sequence[str] = (),
        *,
        fill: tuple[float, float] = (0.05, 0.95),
        spin: tuple[float, float] | None = None,
        points: tuple[int, int] = (20, 20),
        order: int | None = None,
        progress: Progress = False,
    ) -> FillMap:
        """Maps the time constants over the fill of the tanks and the spin, and names the worst fill.

        Args:
            tanks: Names of the tanks that are filled, all alike; every tank of revolution by default.
            fill: First and last fill, more than 0 and less than 1.
            spin: First and last spin (rad/s), the same for one alone; half to twice that of the start by default.
            points: Number of fills and of spins.

        Raises:
            InputError: for tanks that do not exist, and for fills and spins that are none.
        """
        if isinstance(tanks, str):
            raise InputError(f"tanks = {tanks!r}; give a list of names")
        with observer(progress) as watch:
            asked = (fill, spin, points)
            return FillMap(self._core.fills(list(tanks), asked, _arguments.count(order, "order"), watch))

    def light_curve(
        self,
        *,
        sun: ArrayLike | None = None,
        observer: ArrayLike | None = None,
        view: str | os.PathLike[str] | None = None,
        times: ArrayLike | None = None,
        duration: float | str | None = None,
        samples: int | None = None,
        law: str = "lommel-seeliger",
        phase: str = "flat",
        albedo: float | None = None,
        absolute_magnitude: float | None = None,
        epoch: float | None = None,
        periods: bool = False,
        system: str = "reduced",
        tolerance: float | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> LightCurve:
        """Gives the brightness of the rotating body as an observer sees it.

        Args:
            sun, observer: Directions from the body to the Sun and to the observer, inertial axes, ``(3,)``; or with ``times``
                places (au) at each of them, ``(n, 3)``.
            view: File with times and places, and perhaps measured brightness, in their place.
            times: Times (s), ascending, in place of ``duration`` and ``samples``.
            duration, samples: As in ``simulate``.
            law: Law of scattering: ``lommel-seeliger``, ``lambert``, ``mixed:C`` or ``hapke:W,G,B0,H,DEGREES``.
            phase: Phase function beside it: ``flat``, ``hg:G`` or ``surge:A,D,K``.
            albedo: Geometric albedo, for magnitudes in V.
            absolute_magnitude: Absolute magnitude in V, in place of the albedo.
            epoch: Julian date of the start of the model, for files with Julian dates.
            periods: Finds the frequencies of the curve, too.
            system, tolerance: As in ``simulate``.

        Raises:
            InputError: for places, times and laws that give no brightness, and a model without an outer surface.
        """
        if (view is None) == (sun is None or observer is None):
            raise InputError("give the places of both sun and observer, or a file as view")
        if view is not None and (times is not None or duration is not None or samples is not None):
            raise InputError("view has times of its own; leave out times, duration and samples")
        if albedo is not None and absolute_magnitude is not None:
            raise InputError("albedo and absolute_magnitude say the same; give one of them")
        instants = _arguments.times(times)
        asked = {
            "system": _arguments.word(system, "system"),
            "view": None if view is None else _arguments.path(view, "view"),
            "sun": _arguments.places(sun, "sun", instants),
            "observer": _arguments.places(observer, "observer", instants),
            "times": instants,
            "epoch": _arguments.number(epoch, "epoch"),
            "law": _arguments.word(law, "law"),
            "phase": _arguments.word(phase, "phase"),
            "albedo": _arguments.number(albedo, "albedo"),
            "absolute_magnitude": _arguments.number(absolute_magnitude, "absolute_magnitude"),
            "periods": bool(periods),
        }
        settings = _settings.run(duration, samples, tolerance, times=times)
        with _progress.observer(progress) as watch:
            return LightCurve(self._core.light_curve(settings, asked, _arguments.count(order, "order"), watch))

    def sensitivity(
        self, of: str, keys: Sequence[str] = (), *, order: int | None = None, progress: Progress = False
    ) -> Sensitivity:
        """Gives the derivatives of an answer with respect to numbers of the model.

        Args:
            of: Path into the answer of a command, as in studies: ``"modes.nutation.time_constant"``.
            keys: Paths of keys, such as ``"spring.boom.stiffness"``; every number outside ``[run]`` by default.

        Raises:
            InputError: for a quantity or a key that does not exist.

        >>> import quasirigid
        >>> time_constant = "modes.nutation.time_constant"
        >>> found = quasirigid.Model(quasirigid.EXAMPLE).sensitivity(time_constant, ["spring.1.damping"])
        >>> found.derivatives[0]["key"]
        'spring.1.damping'
        """
        if isinstance(keys, str):
            raise InputError(f"keys = {keys!r}; give a list of paths")
        with observer(progress) as watch:
            return Sensitivity(self._core.sensitivity(of, list(keys), _arguments.count(order, "order"), watch))

    def infer(
        self,
        data: str | os.PathLike[str] | None = None,
        vary: Sequence[str] = (),
        *,
        measured: Mapping[str, str] | None = None,
        sigma: float | None = None,
        prior: Mapping[str, str] | None = None,
        range: Mapping[str, str] | None = None,
        loss: str = "squares",
        loss_scale: float | None = None,
        starts: int = 2,
        profile: str = "auto",
        system: str = "reduced",
        order: int | None = None,
        progress: Progress = False,
    ) -> Inferred:
        """Infers numbers of the model from a measured history, from measured answers, or from both.

        Args:
            data: File with a table of ``t`` and columns as ``simulate`` names them, each perhaps with ``sigma_`` and its name.
            vary: Paths of keys, such as ``["spring.boom.damping"]``.
            measured: Answers of commands by their paths: ``{"evolve.time": "12 h +- 1 h"}``.
            sigma: Standard deviation of columns that have none in the file, in their units.
            prior: Mean and standard deviation of keys that are known beforehand: ``{"spring.1.stiffness": "40 N/m +- 5 %"}``.
            range: Ranges of keys: ``{"spring.1.damping": "0.02..0.2"}``; either end may be left out.
            loss: ``squares``, or ``huber`` or ``soft-l1`` that leave outliers little weight.
            loss_scale: Deviations beyond which a robust loss is no square; by default 1.345 of ``huber``, 1.287 of ``soft-l1``.
            starts: Starts of the search beside that of the model, within the ranges of the keys or 20 % of the model.
            profile: Keys whose intervals are those of the profile likelihood: ``auto`` where the squares are no parabola,
                ``all`` or ``none``.
            system: ``full``, ``reduced`` or ``rigid``.

        Raises:
            InputError: for a key that does not exist.
            FileError: for a file that is no measured history.

        >>> import quasirigid
        >>> time_constant = "modes.nutation.time_constant"
        >>> model = quasirigid.Model(quasirigid.EXAMPLE)
        >>> found = model.infer(vary=["spring.1.damping"], measured={time_constant: "-80 min +- 5 min"})
        >>> found.holds, found.degrees_of_freedom
        (True, 0)
        """
        if isinstance(vary, str):
            raise InputError(f"vary = {vary!r}; give a list of paths")
        deviation = None if sigma is None else float(sigma)
        path = None if data is None else _arguments.path(data, "data")
        asked = {
            "vary": list(vary),
            "system": system,
            "measured": [f"{name} = {value}" for name, value in (measured or {}).items()],
            "prior": [f"{name} = {value}" for name, value in (prior or {}).items()],
            "range": [f"{name} = {value}" for name, value in (range or {}).items()],
            "loss": loss,
            "loss_scale": _arguments.number(loss_scale, "loss_scale"),
            "starts": _arguments.count(starts, "starts"),
            "profile": profile,
        }
        with observer(progress) as watch:
            return Inferred(self._core.infer((path, deviation), asked, _arguments.count(order, "order"), watch))

    def design(
        self,
        vary: Sequence[str],
        sensors: Sequence[str],
        manoeuvres: Sequence[str] = (),
        *,
        prior: Mapping[str, str] | None = None,
        duration: float | str | None = None,
        samples: int = 101,
        system: str = "reduced",
        order: int | None = None,
        progress: Progress = False,
    ) -> Design:
        """Says which of planned sensors and manoeuvres would tell numbers of the model best.

        Args:
            vary: Paths of keys, such as ``["spring.boom.damping"]``.
            sensors: Columns or answers with the deviation of their values: ``["wx,wy +- 0.5 mrad/s"]``.
            manoeuvres: Changes of the model that make other motions: ``["initial.wobble.angle = 5 deg"]``.
            prior: Mean and standard deviation of keys that are known beforehand.
            duration: Time for which columns are measured; that of the model by default.
            samples: Number of times at which columns are measured.
            system: ``full``, ``reduced`` or ``rigid``.

        Raises:
            InputError: for a key that does not exist.

        >>> import quasirigid
        >>> found = quasirigid.Model(quasirigid.EXAMPLE).design(["spring.1.damping"], ["wx +- 1e-3 rad/s", "wy +- 1e-3 rad/s"])
        >>> found.plans[0]["sensors"], found.holds
        (['wx', 'wy'], True)
        """
        for name, texts in {"vary": vary, "sensors": sensors, "manoeuvres": manoeuvres}.items():
            if isinstance(texts, str):
                raise InputError(f"{name} = {texts!r}; give a list")
        asked = {
            "vary": list(vary),
            "system": system,
            "sensors": list(sensors),
            "manoeuvres": list(manoeuvres),
            "prior": [f"{name} = {value}" for name, value in (prior or {}).items()],
            "duration": _arguments.duration(duration),
            "samples": _arguments.count(samples, "samples"),
        }
        with observer(progress) as watch:
            return Design(self._core.design(asked, _arguments.count(order, "order"), watch))

    def linear(
        self,
        at: str | ArrayLike | None = None,
        *,
        inputs: Sequence[str] = (),
        outputs: Sequence[str] = (),
        band: ArrayLike | None = None,
        progress: Progress = False,
    ) -> Linear:
        """Gives the linear model of the small motions about a steady state, between inputs and outputs.

        Args:
            at: ``rest``, ``spin`` (next to the start), or an angular velocity (rad/s), ``(3,)``. By default the spin of the
                start, if there is one.
            inputs: Names such as ``torque.x``, ``force.x``, ``force.NODE.x``, ``wheel.NAME.torque``, ``hinge.NAME.torque``,
                ``acceleration.x`` of a support; the torques by default.
            outputs: Names such as ``rate.x``, ``attitude.x``, ``momentum.x``, ``acceleration.NODE.x``,
                ``displacement.NODE.x``, ``wheel.NAME.speed``, ``wheel.NAME.momentum``, ``hinge.NAME.angle``,
                ``hinge.NAME.rate``, ``cavity.NAME.momentum.x``, ``coordinate.NAME``; the rates by default.
            band: Frequencies (rad/s) between which materials and liquids are met, ``(2,)``; those of the body's own rates by
                default.

        Raises:
            InputError: for a name that is none.
            UnsupportedError: for states that are not steady.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).linear(at=[0, 1.2, 0]).A.shape
        (18, 18)
        """
        if isinstance(at, str) and at not in ("rest", "spin"):
            raise InputError(f"at = {at!r}; give 'rest', 'spin' or an angular velocity (rad/s)")
        name = at if isinstance(at, str) else None
        vector = None if isinstance(at, str) else _arguments.vector(at, "at")
        with observer(progress) as watch:
            between = _arguments.band(band)
            return Linear(self._core.linear(name, vector, (list(inputs), list(outputs)), between, watch))

    def export(
        self,
        to: str,
        path: str | os.PathLike[str],
        *,
        order: int | None = None,
        overwrite: bool = False,
        progress: Progress = False,
    ) -> Answer:
        """Writes the reduced equations of a free body, in the form that cannot gain energy, as source of another language.

        Args:
            to: ``c``, ``python``, ``matlab``, ``rust``, ``sympy``, ``latex``, ``heyoka``, ``modelica``, ``fmu2`` or ``fmu3``.
            path: New file, or new folder for C; names in the source are its name.
            overwrite: Whether to replace a file that is there.

        Raises:
            UnsupportedError: for forces, supports, and wheels whose speed changes.
            FileError: for a path that is there or cannot be written.
            InputError: for an unknown target, and a name that the language does not take.

        >>> import quasirigid, tempfile
        >>> folder = tempfile.mkdtemp()
        >>> written = quasirigid.Model(quasirigid.EXAMPLE).export("python", f"{folder}/boom.py")
        >>> written.holds, written.sentence
        (True, 'Order 3; the equations hold below 1.50 rad/s and fail from 4.65 rad/s on.')
        """
        target, file = _arguments.text(to, "to"), _arguments.path(path, "path")
        with observer(progress) as watch:
            return Answer(self._core.export(target, file, _arguments.count(order, "order"), bool(overwrite), watch))

    def about_spin(
        self,
        *,
        degree: int | None = None,
        axis: str | None = None,
        masters: str | Sequence[float] | None = None,
        style: str | None = None,
        progress: Progress = False,
    ) -> AboutSpin:
        """Derives the reduced equations about the steady spin with the angular momentum of the start, at any ratio of spin to vibrations.

        Args:
            degree: Degree in the amplitude of the nutation, 1 to 11; the model's own, or 5.
            axis: Principal axis of the steady spin, ``least`` or ``greatest``; by default the one that the start circles.
            masters: Modes that the equations follow: ``automatic``, ``nutation``, or frequencies (rad/s) beside the nutation.
            style: ``normal-form`` or ``graph``.

        Raises:
            StartError: for an invalid start.
            UnsupportedError: for forces, driven supports, materials without an equation of motion, and spins without a nutation.
            InputError: for settings out of range and masters that are not there.

        >>> import quasirigid
        >>> about = quasirigid.Model(quasirigid.EXAMPLE).about_spin()
        >>> about.holds, about.masters[0]["name"]
        (True, 'nutation')
        """
        settings = _settings.spin_manifold(degree, masters, style)
        word = _arguments.word(axis, "axis")
        with observer(progress) as watch:
            return AboutSpin({**self._core.about_spin(settings, word, watch), "model": self, "settings": settings})

    def reduce(self, order: int | None = None, *, progress: Progress = False) -> Reduced:
        """Derives the reduced equations.

        Raises:
            ReductionError: for an order above 12, and a body that no spring holds.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).reduce(5)
        quasirigid.Reduced: boom satellite, order 5
        """
        whole = _arguments.count(order, "order")
        with observer(progress) as watch:
            return Reduced(self, whole, self._core.reduce(whole, watch))

    def stepper(
        self,
        system: str = "reduced",
        *,
        tolerance: float = 1e-10,
        order: int | None = None,
        progress: Progress = False,
    ) -> Stepper:
        """The body at its start, for steps under a torque that is held over each.

        Args:
            system: ``reduced`` or ``full``.
            tolerance: Error allowed in a step, 1e-15 to 1e-2.

        Raises:
            UnsupportedError: for reduced equations of a body with forces, a support or wheels of changing speed, and for forces
                that change at given times.

        >>> import quasirigid
        >>> body = quasirigid.Model(quasirigid.EXAMPLE).stepper("full")
        >>> body.step([0, 0.1, 0], 0.02)
        'holds'
        """
        if system not in ("reduced", "full"):
            raise InputError(f"system = {system!r}; give 'reduced' or 'full'")
        whole, allowed = _arguments.count(order, "order"), _arguments.number(tolerance, "tolerance")
        with observer(progress) as watch:
            return Stepper(self._core.stepper(system == "full", allowed or 0.0, whole, watch))

    @overload
    def simulate(
        self,
        system: str | None = None,
        *,
        initial: None = None,
        duration: float | str | None = None,
        samples: int | None = None,
        times: ArrayLike | None = None,
        tolerance: float | None = None,
        form: str | None = None,
        integrator: str | None = None,
        coordinates: bool = False,
        displacements: bool = False,
        degree: int | None = None,
        masters: str | Sequence[float] | None = None,
        style: str | None = None,
        certificate: str | os.PathLike[str] | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> History: ...

    @overload
    def simulate(
        self,
        system: str | None = None,
        *,
        initial: ArrayLike,
        duration: float | str | None = None,
        samples: int | None = None,
        times: ArrayLike | None = None,
        tolerance: float | None = None,
        form: str | None = None,
        integrator: str | None = None,
        coordinates: bool = False,
        displacements: bool = False,
        order: int | None = None,
        progress: Progress = False,
    ) -> Histories: ...

    @_arguments.renamed("integrator")
    def simulate(
        self,
        system: str | None = None,
        *,
        initial: ArrayLike | None = None,
        duration: float | str | None = None,
        samples: int | None = None,
        times: ArrayLike | None = None,
        tolerance: float | None = None,
        form: str | None = None,
        integrator: str | None = None,
        coordinates: bool = False,
        displacements: bool = False,
        degree: int | None = None,
        masters: str | Sequence[float] | None = None,
        style: str | None = None,
        certificate: str | os.PathLike[str] | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> History | Histories:
        """Follows the spin in time.

        Args:
            system: ``reduced``, ``full``, ``rigid``, or ``spin-manifold`` for the reduced equations about the
                spin; by default ``reduced``, and ``full`` for a body with driven parts.
            initial: Angular velocities at the start (rad/s), body axes, ``(n, 3)``: one history each, on every core, in
                place of the model's own start. A row that fails has its reason.
            duration: Duration (s); the model's own, or a hundred revolutions.
            samples: Number of rows, spread evenly; the model's own, or 1001.
            times: Output times (s), ascending, in place of ``duration`` and ``samples``.
            tolerance: Error allowed per step, relative, 1e-15 to 1e-2.
            form: Variable that is integrated: ``angular-momentum``, or ``angular-velocity`` as in the paper.
            integrator: Integrator of the full system: ``automatic``, ``explicit`` or ``implicit``.
            coordinates: Internal coordinates and their rates in the table, too.
            displacements: Displacements of points, appendages and nodes, too.
            degree, masters, style: Settings of the reduced equations about the spin, as in ``about_spin``.
            certificate: New file for a certificate, with which ``tools/check_certificate.py`` checks the rows without this package.

        Raises:
            StartError, PropagationError: for an invalid start, unless it is a row of ``initial``.
            InputError: for settings out of range.
            TooLargeError: for histories too large for memory.
            UnsupportedError: for a certificate that the history cannot have.
            FileError: for a certificate that cannot be written.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).simulate("rigid", times=[0, 10, 20]).energy.shape
        (3,)
        """
        settings = _settings.run(duration, samples, tolerance, form, integrator, times)
        about_spin = {"degree": degree, "masters": masters, "style": style}
        given = [name for name, value in about_spin.items() if value is not None]
        if given and system not in ("spin-manifold", "manifold"):
            raise InputError(f'{given[0]} belongs to the reduced equations about the spin; take system="spin-manifold"')
        about = _settings.spin_manifold(degree, masters, style)
        table = _settings.table(system, about, coordinates, displacements, times)
        whole = _arguments.count(order, "order")
        place = None if certificate is None else _arguments.path(certificate, "certificate")
        if place is not None and initial is not None:
            raise InputError("a certificate is of one history; leave out initial, which asks for many")
        with observer(progress) as watch:
            if initial is None:
                return History({**self._core.simulate(settings, table, place, whole, watch), "object": self.name})
            return Histories(self._core.simulate_all(_starts(initial), settings, table, whole, watch))

    def spins(
        self,
        initial: ArrayLike,
        times: ArrayLike,
        *,
        tolerance: float | None = None,
        form: str | None = None,
        reproducible: bool = False,
        order: int | None = None,
        progress: Progress = False,
    ) -> SpinPaths:
        """Follows the angular velocity alone by the reduced equations from many starts: eight at a time on every core, each with its own
        step.

        Args:
            initial: Angular velocities at the start (rad/s), body axes, ``(n, 3)``. A row that fails has its reason.
            times: Output times (s), ascending.
            tolerance: Error allowed per step, relative, 1e-15 to 1e-2.
            form: Variable that is integrated: ``angular-momentum``, or ``angular-velocity`` as in the paper.
            reproducible: The same bits on every processor, without fused multiply-add.

        Raises:
            UnsupportedError: for a body under forces, and a model whose histories end at an event.
            InputError: for settings out of range.
            TooLargeError: for paths too large for memory.

        >>> import quasirigid
        >>> quasirigid.Model(quasirigid.EXAMPLE).spins([[0.1, 1.2, 0.0]], [600]).angular_velocity.shape
        (1, 1, 3)
        """
        instants = _arguments.times(times)
        if instants is None:
            raise InputError("times is None; give a list of at least one time (s)")
        asked = {
            "times": instants,
            "tolerance": _arguments.number(tolerance, "tolerance"),
            "form": _arguments.word(form, "form"),
            "reproducible": bool(reproducible),
        }
        whole = _arguments.count(order, "order")
        with observer(progress) as watch:
            return SpinPaths(self._core.spins(_starts(initial), asked, whole, watch), instants)

    @overload
    def evolve(
        self,
        *,
        initial: None = None,
        start: float | str | None = None,
        until: float | str | None = None,
        duration: float | str | None = None,
        samples: int | None = None,
        power: str | None = None,
        method: str | None = None,
        uncertainty_samples: int | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> Evolution: ...

    @overload
    def evolve(
        self,
        *,
        initial: ArrayLike,
        start: float | str | None = None,
        until: float | str | None = None,
        duration: float | str | None = None,
        samples: int | None = None,
        power: str | None = None,
        method: str | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> Evolutions: ...

    @_arguments.renamed("uncertainty_samples")
    def evolve(
        self,
        *,
        initial: ArrayLike | None = None,
        start: float | str | None = None,
        until: float | str | None = None,
        duration: float | str | None = None,
        samples: int | None = None,
        power: str | None = None,
        method: str | None = None,
        uncertainty_samples: int | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> Evolution | Evolutions:
        """Follows the averaged rotation over any number of revolutions.

        Args:
            initial: Angular velocities at the start (rad/s), body axes, ``(n, 3)``: one evolution each, on every core, in
                place of the model's own start. A row that fails has its reason.
            start: Where to start: the ratio ``D/I₃`` as ``0.9`` or ``"90% of I3"``, or the greatest nutation about the axis of
                greatest inertia as ``"20 deg"``. By default the model's start.
            until: Where to end, in the same form. By default the model's own, or 1 % of the energy of the nutation left.
            duration: Longest time (s).
            samples: Number of rows, 2 to 10000000; the model's own, or 201.
            power: Source of the mean power: ``polynomial`` or ``harmonics``.
            method: ``average``, ``levels``, ``periodic-motions``, ``micro-runs``, ``full``,
                ``modal-rates`` or ``spin-manifold``; by default the one that holds.
            uncertainty_samples: Draws of the keys in the model's ``[uncertainty]``, 2 to 10000000; their intervals are in
                ``uncertainty``. Without it, and for ``initial``, these keys have their stated values.

        Raises:
            StartError: for a start that is invalid or does not evolve, unless it is a row of ``initial``.
            InputError: for a target that is not ahead.
            UnsupportedError: for momentum wheels, a driven pole, and torques without an average.

        >>> import quasirigid
        >>> evolution = quasirigid.Model(quasirigid.EXAMPLE).evolve(until="10 deg")
        >>> evolution.holds, evolution.time > 0
        (True, True)
        """
        settings = {
            "start": _arguments.quantity(start, "start"),
            "until": _arguments.quantity(until, "until"),
            "duration": _arguments.duration(duration),
            "samples": _arguments.count(samples, "samples"),
            "power": _arguments.word(power, "power"),
            "method": _arguments.word(method, "method"),
            "uncertainty_samples": _arguments.count(uncertainty_samples, "uncertainty_samples"),
        }
        if initial is not None and uncertainty_samples is not None:
            raise InputError("uncertainty_samples draws the model's own keys; leave initial out, or vary both in a study")
        whole = _arguments.count(order, "order")
        with observer(progress) as watch:
            if initial is None:
                return Evolution(self._core.evolve(settings, whole, watch))
            return Evolutions(self._core.evolve_all(_starts(initial), settings, whole, watch))

    @_arguments.renamed("revolutions")
    def verify(
        self,
        *,
        orders: Iterable[int] | None = None,
        revolutions: float | None = None,
        halvings: int | None = None,
        order: int | None = None,
        progress: Progress = False,
    ) -> Verification:
        """Compares the full system with the reduced equations, with the measured order of convergence.

        Args:
            orders: Orders to verify; every one up to the model's by default.
            revolutions: Revolutions of each history; 5 by default.
            halvings: How often ε is halved; 4 by default.

        Raises:
            StartError: for an invalid start.
            VerificationError: for an invalid plan.
        """
        with observer(progress) as watch:
            return Verification(
                self._core.verify(
                    _arguments.counts(orders, "orders"),
                    _arguments.number(revolutions, "revolutions"),
                    _arguments.count(halvings, "halvings"),
                    _arguments.count(order, "order"),
                    watch,
                )
            )

    @_arguments.renamed("out", "integrator")
    def run(
        self,
        out: str | os.PathLike[str] | None = None,
        *,
        duration: float | str | None = None,
        samples: int | None = None,
        tolerance: float | None = None,
        form: str | None = None,
        integrator: str | None = None,
        order: int | None = None,
        tables: str | Sequence[str] | None = None,
        resume: bool = False,
        progress: Progress = False,
    ) -> Run:
        """Does everything that the model asks for in ``[run]``: check, reduce, propagate, follow, verify.

        Args:
            out: New folder for the record and its report; it appears only when the record is complete. Without one nothing
                is written. From the first second of work on the run is kept beside it, in ``<out>-unfinished``, and histories
                of any number of rows take little memory.
            tables: Formats of the tables: ``csv``, ``parquet``, ``npz``, or several of them; CSV by default, Parquet where a history
                has more than 100 000 rows.
            resume: Whether to go on from ``<out>-unfinished``, where a run was cut off, with the bits of a run that nothing
                stopped.

        Raises:
            FileError: for a folder that already exists, before any work.
            InputError: for ``tables`` or ``resume`` without a folder, and for a run that is not there to continue, or is another.
            StartError: for an invalid start.
        """
        if out is None and (tables is not None or resume):
            raise InputError("tables and resume need the folder of the record")
        formats = tables.split(",") if isinstance(tables, str) else None if tables is None else list(tables)
        place = None if out is None else {"folder": _arguments.path(out, "out"), "tables": formats, "resume": bool(resume)}
        settings = _settings.run(duration, samples, tolerance, form, integrator)
        with observer(progress) as watch:
            return Run(self._core.run(place, settings, _arguments.count(order, "order"), watch))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return NotImplemented
        return (self.text, self.file) == (other.text, other.file)

    def __hash__(self) -> int:
        return hash((self.text, self.file))

    def __repr__(self) -> str:
        return f"quasirigid.Model: {self.name} ({self.file}, sha256 {self.sha256[:12]})"

    def _repr_html_(self) -> str:
        import html

        return f"<details><summary>{html.escape(repr(self))}</summary><pre>{html.escape(self.text)}</pre></details>"

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a model never changes; {name} cannot be set")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a model never changes; {name} cannot be deleted")

    def __reduce__(self) -> tuple[object, ...]:
        return _model, (type(self), self.text, os.fspath(self.file))


def cite(model: Model) -> str:
    """BibTeX entries of what a model uses: its elements, materials, liquids, forces and the questions of its ``[run]``.

    Chernousko (1978), whose reduction everything rests on, is always the first.

    >>> import quasirigid
    >>> quasirigid.cite(quasirigid.Model(quasirigid.EXAMPLE)).splitlines()[0]
    '@article{chernousko1978,'
    """
    if not isinstance(model, Model):
        raise InputError(f"cite takes a Model, not {type(model).__name__}")
    return model._core.cite()


def _set(model: Model, core: _core.Model) -> None:
    object.__setattr__(model, "_core", core)


def _model(kind: type[Model], text: str, file: str) -> Model:
    return kind(text, file=file)


def _starts(initial: ArrayLike) -> Any:
    starts = _arguments.vectors(initial, "initial")
    if starts.ndim != 2:
        raise InputError(f"initial has the shape {starts.shape}; give one angular velocity a row, (n, 3)")
    return starts
