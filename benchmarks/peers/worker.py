"""One run in a process of its own: `python worker.py PEER CASE NUMBER`.

The last line written is the result as JSON, or what went wrong.
"""

import importlib
import json
import sys
from dataclasses import asdict, replace

from measure import Result, Setting
from settings import SETTINGS

REPEATS = 5
ENOUGH_SECONDS = 3.0


def best(peer: str, case: str, setting: Setting) -> Result:
    """The cheapest of a few runs, with the set-up of the first, which compiles."""
    run = importlib.import_module(f"peers.{peer}_").run
    results = [run(case, setting)]
    while len(results) < REPEATS and sum(r.seconds for r in results) < ENOUGH_SECONDS:
        results.append(run(case, setting))
    cheapest = min(results, key=lambda r: r.seconds)
    return replace(cheapest, setup_seconds=results[0].setup_seconds)


def main() -> None:
    """Command line."""
    peer, case, number = sys.argv[1:]
    try:
        outcome = asdict(best(peer, case, SETTINGS[peer][case][int(number)]))
    except Exception as error:
        message = " ".join(str(error).split())
        outcome = {"failure": f"{type(error).__name__}: {message}"}
    print("\n" + json.dumps(outcome), flush=True)


if __name__ == "__main__":
    main()
