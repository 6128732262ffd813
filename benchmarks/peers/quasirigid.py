"""quasirigid itself, through a small program that runs the common problem.

It is called as `PROGRAM --case A --tolerance 1e-09` and prints for each method one line
of JSON with the keys `case`, `tolerance`, `omega`, `momentum_drift`, `seconds`, `steps`
and `method`. `seconds` is the time of the integration alone, the least of a few runs.
"""

import shlex
from collections.abc import Iterator
from pathlib import Path

from records import Failed, Record, call, finished, unfinished

TITLE = "quasirigid"
MANIFEST = Path(__file__).parents[2] / "Cargo.toml"
DEFAULT = (
    "cargo run --quiet --profile dist --example common_problem "
    f"--manifest-path {shlex.quote(str(MANIFEST))} --"
)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11)


def runs(program: str, case: str, limit: int) -> Iterator[Record]:
    """A record for each tolerance and method."""
    for tolerance in TOLERANCES:
        asked = ["--case", case, "--tolerance", f"{tolerance:.0e}"]
        try:
            for numbers in call(shlex.split(program) + asked, limit):
                setting = f"{numbers['method']}, tolerance {numbers['tolerance']:.0e}"
                yield finished(case, TITLE, setting, numbers)
        except Failed as error:
            setting = f"tolerance {tolerance:.0e}"
            yield unfinished(case, TITLE, setting, error)
