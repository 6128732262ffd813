"""Which damping do simulators invent? Runs those that are installed on three free rigid bodies and audits what they write.

python benchmarks/audit/run.py target/release/quasirigid [--only mujoco_,drake_]; the rows of other programs stay as results.json has them.
"""

from __future__ import annotations

import argparse
import importlib
import json
import subprocess
import tempfile
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from bodies import BODIES, FAST, TRIAXIAL, Body, Rows
from bookkeeping import accounts, changes, is_steady, time_constant, told
from page import HERE, RESULTS, is_sharp, write
from simulators import NAMES, Method

LARGEST_STEP_OF_FAST = 0.02
POINTS = 60


def answer(program: str, files: list[Path], body: Body, *more: str) -> dict[str, Any]:
    moments = ",".join(map(repr, body.moments))
    line = [program, "audit", *map(str, files), "--inertia", moments, "--json", *more]
    run = subprocess.run(line, capture_output=True, check=False, text=True)
    if run.returncode not in (0, 1) or not run.stdout.strip():
        return {"refused": " ".join(run.stderr.replace(f"{files[0].parent}/", "").split())}
    return json.loads(run.stdout)


def written(file: Path, rows: Rows) -> Path:
    np.savetxt(file, rows, fmt="%.17g", delimiter=",", header="t,wx,wy,wz,qw,qx,qy,qz", comments="")
    return file


def measured(program: str, whole: Rows, body: Body, step: float) -> dict[str, Any]:
    """One history: what the audit says, and what bookkeeping says."""
    rows = told(whole, body)
    with tempfile.TemporaryDirectory() as folder:
        found = answer(program, [written(Path(folder, "spin.csv"), rows)], body)
    energy, momentum = changes(rows, body)
    return {
        "body": body.name,
        "step": step,
        "duration": float(rows[-1, 0]),
        "time_constant": found.get("invented_time_constant"),
        "longest": found.get("longest_time_constant"),
        "bookkeeping": time_constant(rows, body),
        "steady": is_steady(rows, body),
        "energy_change": energy,
        "momentum_change": momentum,
        "refused": found.get("refused"),
    }


def traced(rows: Rows) -> dict[str, list[float]]:
    """Energy and angular momentum over those of the start at some rows, for figures."""
    energy, momentum = accounts(rows, TRIAXIAL)
    at = np.linspace(0, len(rows) - 1, POINTS + 1).round().astype(int)
    columns = {"t": rows[at, 0], "energy": energy[at] / energy[0] - 1.0, "momentum": momentum[at] / momentum[0] - 1.0}
    return {name: [float(f"{value:.6g}") for value in values] for name, values in columns.items()}


def order(program: str, pair: list[tuple[float, Rows]], body: Body) -> dict[str, Any]:
    """Order by two steps, and the step with which the wobble would keep for a year."""
    shortest = min(len(told(rows, body)) * rows[1, 0] for _, rows in pair)
    with tempfile.TemporaryDirectory() as folder:
        files = [
            written(Path(folder, f"{k}.csv"), rows[rows[:, 0] <= shortest]) for k, (_, rows) in enumerate(pair)
        ]
        steps = ",".join(repr(step) for step, _ in pair)
        found = answer(program, files, body, "--steps", steps, "--min-time-constant", "1 yr")
    told_order = found.get("order") or {}
    return {"order": told_order.get("order"), "year_step": told_order.get("enough_step"), "pair": [s for s, _ in pair]}


def record(program: str, module: ModuleType, method: Method) -> dict[str, Any]:
    runs, histories, trace = [], {}, None
    for step in method.steps + method.scan:
        for body in BODIES if step in method.steps else (TRIAXIAL,):
            rows = module.history(method, body, step)
            runs.append(measured(program, rows, body, step))
            if body is TRIAXIAL:
                histories[step] = rows
                trace = trace or traced(rows)
    fast = None
    if not method.tolerance and method.steps[0] <= LARGEST_STEP_OF_FAST:
        body = TRIAXIAL.faster(FAST)
        fast = measured(program, module.history(method, body, method.steps[0]), body, method.steps[0])
    seen = [run["step"] for run in runs if run["body"] == TRIAXIAL.name and is_sharp(run)]
    pair = sorted(seen)[:2] if len(seen) >= 2 and not method.tolerance else []
    shown = order(program, [(step, histories[step]) for step in reversed(pair)], TRIAXIAL) if pair else None
    kept = {key: getattr(method, key) for key in ("name", "of", "default", "tolerance", "damping", "why", "steps", "scan")}
    return {"program": module.TITLE, "version": module.version(), **kept, "runs": runs, "trace": trace, "fast": fast, "order": shown}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--only", default=",".join(NAMES))
    asked = parser.parse_args()
    rows = json.loads(RESULTS.read_text())["rows"] if RESULTS.exists() else []
    for name in asked.only.split(","):
        try:
            module = importlib.import_module(f"simulators.{name}")
        except ImportError as error:
            print(f"{name}: not installed ({error})")
            continue
        rows = [row for row in rows if row["module"] != name]
        for method in module.METHODS:
            print(f"{module.TITLE} {module.version()}: {method.name}", flush=True)
            rows.append({"module": name, **record(asked.program, module, method)})
    rows.sort(key=lambda row: NAMES.index(row["module"]))
    RESULTS.write_text(json.dumps({"rows": rows}, indent=1, allow_nan=False) + "\n")
    write(HERE / "README.md")


if __name__ == "__main__":
    main()
