"""Arguments: kinds and shapes are checked here, so that a mistake is told by the name of the argument."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quasirigid._errors import InputError

__all__: list[str] = []

# Largest count that the compiled part takes.
_MOST = 2**62


def text(value: str, name: str) -> str:
    """A text that UTF-8 can write; Python's own may hold halves of characters."""
    try:
        value.encode()
    except UnicodeEncodeError as error:
        place = error.start
        message = f"{name} is no text: its character {place} is the surrogate {value[place]!a}, which UTF-8 cannot write"
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


def rows(value: Any, name: str) -> int | None:
    """A number of rows of an evolution."""
    found = count(value, name)
    if found is not None and not 2 <= found <= 1_000_000:
        raise InputError(f"{name} = {found} is out of range; give 2 to 1000000")
    return found


def draws(value: Any, name: str) -> int | None:
    """A number of draws."""
    found = count(value, name)
    if found is not None and not 2 <= found <= 10_000_000:
        raise InputError(f"{name} = {found} is out of range; give 2 to 10000000")
    return found


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


def times(value: ArrayLike | None) -> list[float] | None:
    """Output times."""
    if value is None:
        return None
    found = array(value, "times")
    if found.ndim != 1 or found.size == 0:
        raise InputError(f"times has the shape {found.shape}; give a list of at least one time (s)")
    instants: list[float] = found.tolist()
    return instants


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
