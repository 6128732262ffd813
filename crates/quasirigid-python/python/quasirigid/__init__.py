"""How internal dissipation changes the rotation of almost rigid bodies.

A model (TOML, or a dictionary) answers questions: whether the reduced equations of Chernousko (1978) hold, its modes, its spin
history, its secular evolution over millions of revolutions.

>>> import quasirigid
>>> model = quasirigid.Model(quasirigid.EXAMPLE)
>>> evolution = model.evolve()
>>> evolution.holds, round(evolution.time / 3600, 2)
(True, 10.72)

Units are SI throughout. An answer that does not hold is false, begins with the reason, and has ``None`` for its numbers.
"""

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
from quasirigid._attitude import Attitude, read_attitude
from quasirigid._audit import Audit, audit
from quasirigid._core import EXAMPLE
from quasirigid._core import VERSION as __version__
from quasirigid._ellipsoids import EllipsoidEvolutions, evolve_ellipsoids
from quasirigid._ensemble import Evolutions, Histories, SpinPaths
from quasirigid._errors import (
    Diagnostic,
    Error,
    FileError,
    InputError,
    InternalError,
    Interrupted,
    MissingFileError,
    ModelError,
    PropagationError,
    ReductionError,
    Refused,
    StartError,
    TooLargeError,
    UnsupportedError,
    VerificationError,
)
from quasirigid._linear import Linear
from quasirigid._model import Model, cite
from quasirigid._population import Population, evolve_population
from quasirigid._reduced import Part, Reduced, SympyEquations
from quasirigid._stepper import Stepper
from quasirigid._sweep import Sweep, read_sweep, sweep
from quasirigid._table import Table

__all__ = [
    "EXAMPLE",
    "AboutSpin",
    "Answer",
    "Attitude",
    "Audit",
    "Check",
    "Diagnostic",
    "Design",
    "EffectiveMasses",
    "EllipsoidEvolutions",
    "Error",
    "Evolution",
    "Evolutions",
    "FileError",
    "FillMap",
    "Histories",
    "History",
    "Inferred",
    "InputError",
    "InternalError",
    "Interrupted",
    "MissingFileError",
    "Model",
    "ModelError",
    "LightCurve",
    "Linear",
    "Modes",
    "Part",
    "Population",
    "PropagationError",
    "Reduced",
    "ReductionError",
    "Refused",
    "Run",
    "Sensitivity",
    "SpinPaths",
    "StartError",
    "Stepper",
    "Sweep",
    "SympyEquations",
    "Table",
    "TooLargeError",
    "UnsupportedError",
    "Verification",
    "VerificationError",
    "__version__",
    "audit",
    "cite",
    "evolve_ellipsoids",
    "evolve_population",
    "read_attitude",
    "read_sweep",
    "sweep",
]

# Classes are shown and pickled by the names that users import.
for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = "quasirigid"
for _function in (audit, cite, evolve_ellipsoids, evolve_population, read_attitude, read_sweep, sweep):
    _function.__module__ = "quasirigid"
del _function, _name
