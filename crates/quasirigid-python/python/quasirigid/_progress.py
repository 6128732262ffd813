"""Progress of long work: a bar of tqdm where it is installed, or a function of the caller's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

from quasirigid._errors import InputError

__all__: list[str] = []

Progress: TypeAlias = bool | Callable[[str, float], object]

# Steps of a bar: tenths of a per cent.
_STEPS = 1000


@contextmanager
def observer(progress: Progress) -> Iterator[Callable[[str, float], object] | None]:
    """The function that the work calls with its stage and the share of it that is done."""
    if callable(progress):
        yield progress
        return
    if not isinstance(progress, bool):
        raise InputError(f"progress = {progress!r}: give True, False, or a function of a stage and a share")
    bar = _bar() if progress else None
    if bar is None:
        yield None
        return

    def show(stage: str, share: float) -> None:
        if bar.desc != f"{stage}: ":
            bar.reset()
            bar.set_description(stage)
        bar.update(round(share * _STEPS) - bar.n)

    with bar:
        yield show


def _bar() -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm(total=_STEPS, delay=1, leave=False, bar_format="{desc}{percentage:3.0f}%|{bar}| {remaining} left")
