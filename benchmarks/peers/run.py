"""Runs the common problem in quasirigid and in other programs, and compares them.

python run.py
python run.py --case A,over --peer heyoka,scipy --out results.json
"""

import argparse
import json
import os
import platform
from collections.abc import Callable, Iterator
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import programs
import quasirigid
from problem import CASES
from programs import PROGRAMS
from records import Record
from tables import run_table, target_table


def names(known: dict) -> Callable[[str], list[str]]:
    """A reader of lists such as `A,over` that refuses what is not known."""

    def read(text: str) -> list[str]:
        asked = text.split(",")
        unknown = [name for name in asked if name not in known]
        if unknown:
            choices = ", ".join(known)
            raise argparse.ArgumentTypeError(f"{unknown[0]} is none of {choices}")
        return asked

    return read


def arguments() -> argparse.Namespace:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--case", type=names(CASES), default=list(CASES))
    parser.add_argument("--peer", type=names(PROGRAMS), default=list(PROGRAMS))
    parser.add_argument(
        "--quasirigid",
        metavar="PROGRAM",
        default=quasirigid.DEFAULT,
        help="command that runs the common problem in quasirigid; empty for none",
    )
    parser.add_argument("--limit", type=int, default=120, help="CPU seconds for a run")
    parser.add_argument("--out", type=Path, help="file for the results as JSON")
    return parser.parse_args()


def installed(peers: list[str]) -> dict[str, str]:
    """The versions of those programs that are installed."""
    versions = {}
    for peer in peers:
        try:
            versions[peer] = PROGRAMS[peer].version
        except PackageNotFoundError as error:
            print(f"{peer}: {error.name} is not installed, skipped")
    return versions


def all_runs(case: str, peers: list[str], own: str, limit: int) -> Iterator[Record]:
    """quasirigid on a case, then the other programs."""
    if own:
        yield from quasirigid.runs(own, case, limit)
    for peer in peers:
        yield from programs.runs(peer, case, limit)


def main() -> None:
    """Runs, prints the tables, and writes the results."""
    asked = arguments()
    versions = installed(asked.peer)
    print("\n".join(versions.values()))
    records: list[Record] = []
    for case in asked.case:
        found = list(all_runs(case, list(versions), asked.quasirigid, asked.limit))
        print(f"\n## {case}\n\n{run_table(found)}\n\n{target_table(found)}", flush=True)
        records += found
        if asked.out:
            write(asked.out, versions, records)


def write(path: Path, versions: dict[str, str], records: list[Record]) -> None:
    """Writes the runs so far, with the versions and the kind of machine."""
    results = {
        "machine": f"{platform.machine()}, {os.cpu_count()} cores, {platform.system()}",
        "python": platform.python_version(),
        "versions": versions,
        "runs": [asdict(record) for record in records],
    }
    path.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
