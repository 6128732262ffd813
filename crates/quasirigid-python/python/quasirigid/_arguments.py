"""Arguments: kinds and shapes are checked here, so that a mistake is told by the name of the argument."""

from __future__ import annotations

import functools
import operator
import os
import sys
import warnings
from collections.abc import Callable, Iterable
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid import _core
from quasirigid._errors import InputError

__all__: list[str] = []

_P = ParamSpec("_P")
_T = TypeVar("_T")

# Largest count that the compiled part takes.
_MOST = 2**62


def text(value: str, name: str) -> str:
    """A text that UTF-8 can write; Python's own may hold halves of characters."""
    try:
        value.encode()
    except UnicodeEncodeError as error:
        place = error.start
        message = f"{name} is not valid text: its character {place} is the surrogate {value[place]!a}, which UTF-8 cannot write"
        raise InputError(message) from None
    return value


def path(value: str | bytes | os.PathLike[Any], name: str) -> str:
    """A name of a file or a folder."""
    try:
        found = os.fsdecode(value)
        os.fsencode(found)
    except TypeError as error:
        raise InputError(f"{name} = {value!r} is not a path") from error
    except UnicodeEncodeError:
        raise InputError(f"{name} = {value!a} is not a path: no name of a file has such a surrogate") from None
    if not found or "\0" in found:
        raise InputError(f"{name} = {value!r} is not a path")
    return found


def quantity(value: Any, name: str) -> float | str | None:
    """A number in SI units or a text with a unit."""
    if value is None:
        return value
    if isinstance(value, str):
        return text(value, name)
    if masked(value):
        raise InputError(f"{name} is masked; give a number")
    if isinstance(value, (bool, np.bool_)):
        raise InputError(f"{name} = {value!r}: give a number in SI units, or a text with a unit such as '2 h'")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        message = f"{name} = {value!r}: give a number in SI units, or a text with a unit such as '2 h'"
        raise InputError(message) from error


def number(value: Any, name: str) -> float | None:
    """A pure number."""
    if isinstance(value, str):
        raise InputError(f"{name} = {value!r} is a text, not a number")
    found = quantity(value, name)
    return None if found is None else float(found)


def count(value: Any, name: str) -> int | None:
    """A whole number from zero up."""
    if value is None:
        return None
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        whole = operator.index(value)
    except TypeError as error:
        raise InputError(f"{name} = {value!r} is not a whole number") from error
    if not 0 <= whole <= _MOST:
        raise InputError(f"{name} = {whole} is out of range")
    return whole


def word(value: Any, name: str) -> str | None:
    """A name among a few."""
    if value is not None and not isinstance(value, str):
        raise InputError(f"{name} = {value!r} is not a text")
    return None if value is None else text(value, name)


def masked(value: Any) -> bool:
    """Whether a value, or one in a list, is masked."""
    if isinstance(value, (list, tuple)):
        return any(masked(each) for each in value)
    return bool(np.ma.is_masked(value))


def array(value: ArrayLike, name: str) -> NDArray[np.float64]:
    """An array of real numbers. A masked value has no number, and an array forgets the mask of another."""
    if masked(value):
        raise InputError(f"{name} has masked values; leave them out, or give them a number with filled()")
    try:
        found = np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name}: rows of different length are no array") from error
    if found.dtype.kind not in "fiu":
        raise InputError(f"{name} has the type {found.dtype}; give real numbers")
    return np.asarray(found, dtype=np.float64, order="C")


def vectors(value: ArrayLike, name: str) -> NDArray[np.float64]:
    """An array ``(..., 3)``."""
    found = array(value, name)
    if found.ndim == 0 or found.shape[-1] != 3:
        raise InputError(f"{name} has the shape {found.shape}; the last axis must have length 3")
    return found


def vector(value: ArrayLike | None, name: str) -> tuple[float, float, float] | None:
    """A vector of finite numbers."""
    if value is None:
        return None
    found = vectors(value, name)
    if found.shape != (3,) or not np.isfinite(found).all():
        raise InputError(f"{name} = {found.tolist()} is not a vector of three finite numbers")
    x, y, z = found.tolist()
    return x, y, z


def band(value: ArrayLike | None) -> tuple[float, float] | None:
    """First and last frequency (rad/s)."""
    if value is None:
        return None
    found = array(value, "band")
    if found.shape != (2,):
        raise InputError(f"band = {found.tolist()} is not a first and a last frequency (rad/s)")
    low, high = found.tolist()
    return low, high


def times(value: ArrayLike | None) -> list[float] | None:
    """Output times."""
    if value is None:
        return None
    found = array(value, "times")
    if found.ndim != 1 or found.size == 0:
        raise InputError(f"times has the shape {found.shape}; give a list of at least one time (s)")
    instants: list[float] = found.tolist()
    return instants


def places(value: ArrayLike | None, name: str, instants: list[float] | None) -> list[tuple[float, float, float]]:
    """A vector, or one at each time."""
    if value is None:
        return []
    found = vectors(value, name)
    if found.ndim == 2 and (instants is None or found.shape[0] != len(instants)):
        count = 0 if instants is None else len(instants)
        raise InputError(f"{name} has {found.shape[0]} rows for {count} times; give times, one for each row")
    if found.ndim > 2 or not np.isfinite(found).all():
        raise InputError(f"{name} is neither a vector nor rows of three finite numbers")
    return [(x, y, z) for x, y, z in found.reshape(-1, 3).tolist()]


def counts(value: Iterable[Any] | None, name: str) -> list[int] | None:
    """A list of whole numbers."""
    if value is None:
        return None
    try:
        found = [count(each, name) for each in value]
    except TypeError as error:
        raise InputError(f"{name} = {value!r} is not a list of whole numbers") from error
    return [each for each in found if each is not None]


def duration(value: Any) -> float | str | None:
    """A time above zero (s), or a text with a unit."""
    found = quantity(value, "duration")
    if isinstance(found, float) and not 0.0 < found < float("inf"):
        raise InputError(f"duration = {found} s is not a duration; give one above zero, such as '2 h'")
    return found


def renamed(*names: str) -> Callable[[Callable[_P, _T]], Callable[_P, _T]]:
    """Takes arguments by their former names too, for one version, with a warning that says the names of today."""
    former = {_core.former_argument(name): name for name in names}

    def decorated(function: Callable[_P, _T]) -> Callable[_P, _T]:
        @functools.wraps(function)
        def taken(*args: _P.args, **kwargs: _P.kwargs) -> _T:
            for old in former.keys() & kwargs.keys():
                if former[old] in kwargs:
                    raise InputError(f"{old} is the former name of {former[old]}; give the one or the other")
                deprecated(f"{old} is now called {former[old]}; this version takes the former name for the last time")
                kwargs[former[old]] = kwargs.pop(old)
            return function(*args, **kwargs)

        return taken

    return decorated


def deprecated(note: str) -> None:
    """Warns at the line outside the package that used a former name."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "quasirigid":
        level, frame = level + 1, frame.f_back
    warnings.warn(note, DeprecationWarning, stacklevel=level)
