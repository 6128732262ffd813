"""Exceptions: one class for each kind of failure, so that a program can catch the one it can mend."""

from __future__ import annotations

from typing import NamedTuple

__all__ = [
    "Diagnostic",
    "Error",
    "FileError",
    "InputError",
    "InternalError",
    "Interrupted",
    "MissingFileError",
    "ModelError",
    "PropagationError",
    "ReductionError",
    "Refused",
    "StartError",
    "TooLargeError",
    "UnsupportedError",
    "VerificationError",
]


class Diagnostic(NamedTuple):
    """A mistake in a model file, and its place.

    >>> import quasirigid
    >>> try:
    ...     quasirigid.Model("[carrier]\\nmas = 40.0")
    ... except quasirigid.ModelError as error:
    ...     error.diagnostics[-1].line, error.diagnostics[-1].help[:20]
    (2, 'did you mean `mass`?')
    """

    line: int
    """Line, from 1."""
    column: int
    """Column in characters, from 1."""
    message: str
    """Message, with the offending value."""
    label: str
    """A few words to stand beside the place."""
    help: str | None
    """Advice, where there is any."""


class Error(Exception):
    """Base of every exception of this package; the text is the program's.

    >>> import quasirigid
    >>> issubclass(quasirigid.ModelError, quasirigid.Error)
    True
    """


class ModelError(Error, ValueError):
    """A model that cannot be used: keys, units, names, laws of mechanics.

    ``line``, ``column``, ``message`` and ``help`` are those of the first mistake; ``diagnostics`` lists all.

    >>> import quasirigid
    >>> try:
    ...     quasirigid.Model("[carrier]\\nmas = 40.0")
    ... except quasirigid.ModelError as error:
    ...     print(error.message)
    [carrier] has no `center_of_mass`
    """

    def __init__(self, text: str, file: str = "", diagnostics: list[Diagnostic] | None = None) -> None:
        super().__init__(text)
        self.file = file
        """Name of the file in messages."""
        self.diagnostics = list(diagnostics or [])
        """Every mistake, in the order of the file."""

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.file, self.diagnostics)

    @property
    def line(self) -> int | None:
        """Line of the first mistake, from 1."""
        return self.diagnostics[0].line if self.diagnostics else None

    @property
    def column(self) -> int | None:
        """Column of the first mistake in characters, from 1."""
        return self.diagnostics[0].column if self.diagnostics else None

    @property
    def message(self) -> str:
        """Message of the first mistake."""
        return self.diagnostics[0].message if self.diagnostics else str(self)

    @property
    def help(self) -> str | None:
        """Advice on the first mistake."""
        return self.diagnostics[0].help if self.diagnostics else None


class InputError(Error, ValueError):
    """An invalid argument: a wrong shape, a negative duration, an unknown name.

    >>> import quasirigid
    >>> issubclass(quasirigid.InputError, ValueError)
    True
    """


class StartError(Error):
    """An invalid start: no initial rotation, or one that the body cannot have, or one that does not evolve."""


class ReductionError(Error):
    """A body that is not reduced: its order, a mechanism, vibrations that do not converge."""


class PropagationError(Error):
    """A history that cannot begin."""


class VerificationError(Error):
    """A verification with an invalid plan."""


class UnsupportedError(Error):
    """A body or a torque that the question does not cover."""


class FileError(Error, OSError):
    """A file or folder that cannot be read or written, or that already exists."""


class MissingFileError(FileError, FileNotFoundError):
    """A model file that is not there."""


class TooLargeError(Error, MemoryError):
    """A result that has no room in memory."""


class Refused(Error):
    """An answer that does not hold, where one that holds was required with ``require()``."""


class Interrupted(Error):
    """Work that its observer told to end. (Ctrl-C raises ``KeyboardInterrupt``.)"""


class InternalError(Error):
    """An error of quasirigid itself; please report it with the model."""
