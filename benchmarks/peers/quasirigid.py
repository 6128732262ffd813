"""quasirigid itself, through a small program that runs the common problem.

It is called as `PROGRAM --case A --tolerance 1e-09` and prints for each method one line
of JSON with the keys `case`, `tolerance`, `omega`, `momentum_drift`, `seconds`, `steps`
and `method`. `seconds` is the CPU time of the integration alone.
"""

import shlex
from collections.abc import Iterator
from pathlib import Path

from records import Failed, Record, Run, call, finished, unfinished

TITLE = "quasirigid"
MANIFEST = Path(__file__).parents[2] / "Cargo.toml"
DEFAULT = (
    "cargo run --quiet --release --example common_problem "
    f"--manifest-path {shlex.quote(str(MANIFEST))} --"
)
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)

REPEATS = 5
ENOUGH_SECONDS = 1.0


def runs(program: str, case: str, limit: int) -> Iterator[Record]:
    """A record for each tolerance and method."""
    for tolerance in TOLERANCES:
        asked = ["--case", case, "--tolerance", f"{tolerance:.0e}"]
        try:
            yield from cheapest(shlex.split(program) + asked, case, limit)
        except Failed as error:
            setting = f"tolerance {tolerance:.0e}"
            yield unfinished(case, TITLE, setting, error)


def cheapest(command: list[str], case: str, limit: int) -> list[Run]:
    """The cheapest of a few calls, method by method."""
    best: dict[str, Run] = {}
    for _ in range(REPEATS):
        for numbers in call(command, limit):
            setting = f"{numbers['method']}, tolerance {numbers['tolerance']:.0e}"
            record = finished(case, TITLE, setting, numbers)
            known = best.setdefault(setting, record)
            if record.seconds < known.seconds:
                best[setting] = record
        if sum(record.seconds for record in best.values()) > ENOUGH_SECONDS:
            break
    return list(best.values())
