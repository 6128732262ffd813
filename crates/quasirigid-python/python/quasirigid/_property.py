"""Properties whose value is found by their name, in an answer's parts or among the columns of its table."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, Never, NoReturn, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__: list[str] = []

T = TypeVar("T")


class Named(property, Generic[T]):
    """Property with a docstring whose value is found by its name."""

    def __init__(self, find: Callable[[Any, str], T], doc: str) -> None:
        super().__init__(lambda owner: find(owner, self.name), self._refuse)
        self.name = ""
        self.__doc__ = doc

    def __set_name__(self, _: type, name: str) -> None:
        self.name = name

    def _refuse(self, owner: object, _: object) -> NoReturn:
        raise AttributeError(f"property {self.name!r} of {type(owner).__name__!r} object has no setter")

    if TYPE_CHECKING:

        def __get__(self, instance: Any, owner: type | None = None, /) -> T: ...  # type: ignore[override]
        def __set__(self, instance: Any, value: Never, /) -> None: ...


def part(convert: Callable[[Any], T], doc: str, key: str | None = None) -> Named[T]:
    """Part of an answer under the name of the property or another key, converted."""
    return Named(lambda owner, name: convert(owner._parts[key or name]), doc)


def entry(convert: Callable[[Any], T], doc: str, key: str | None = None) -> Named[T]:
    """Entry of an answer's JSON object under the name of the property or another key, converted."""
    return Named(lambda owner, name: convert(owner._parts["json"][key or name]), doc)


def texts(doc: str) -> Named[list[str]]:
    """Column of texts of a table under the name of the property."""
    return Named(lambda owner, name: list(owner.table[name]), doc)


def column(doc: str, *names: str) -> Named[NDArray[np.float64]]:
    """Column of numbers under the name of the property, or several side by side."""
    return Named(lambda owner, name: owner._stack(*names) if names else owner._column(name), doc)
