"""The two solutions of every problem: the full solver of this program, and a script that shares no code with it."""

from __future__ import annotations

import csv
import importlib.util
import io
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

FOLDER = Path(__file__).resolve().parent
Answers = dict[str, Any]


def problems() -> dict[str, dict[str, Any]]:
    """The problems by name, in their order."""
    files = sorted((FOLDER / "problems").glob("*.json"))
    return {told["name"]: told for told in (json.loads(file.read_text()) for file in files)}


def independent(problem: dict[str, Any]) -> Answers:
    """Answers of the script in `solutions`, from the numbers in the problem's JSON alone."""
    script = FOLDER / problem["solutions"]["independent"]["script"]
    if str(script.parent) not in sys.path:
        sys.path.insert(0, str(script.parent))
    spec = importlib.util.spec_from_file_location(f"solution_{script.stem}", script)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    answers: Answers = module.solve(problem["data"], problem["times"])
    return answers


def asked(call: list[str]) -> str:
    """Standard output of the program; its own words where it refuses."""
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(call)}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def commands(problem: dict[str, Any], program: str = "quasirigid") -> dict[str, list[str]]:
    """The command lines of the program's solution: history, and modes or the end of a run where they are asked."""
    told = problem["solutions"]["program"]
    model = str(FOLDER / told["model"])
    origins = {origin for quantity in problem["quantities"].values() for origin in quantity["program"]}
    times = ",".join(str(t) for t in problem["times"])
    calls = {"columns": [program, "simulate", model, "--quiet", *told["simulate"], "--times", times]}
    if "modes" in origins:
        calls["modes"] = [program, "modes", model, "--json", "--quiet", *told["modes"]]
    if "result" in origins:
        calls["result"] = [program, "simulate", model, "--json", "--quiet", *told["simulate"]]
    return calls


def full_solver(problem: dict[str, Any], program: Path) -> Answers:
    """Answers of this program's full equations, from the model file beside the problem's JSON."""
    told = {origin: asked(call) for origin, call in commands(problem, str(program)).items()}
    rows = list(csv.DictReader(io.StringIO(told["columns"])))
    answers: Answers = {}
    for name, quantity in problem["quantities"].items():
        (origin, key), *_ = quantity["program"].items()
        if origin == "columns":
            answers[name] = [column(rows, title) for title in key]
            answers[name] = answers[name][0] if len(key) == 1 else np.transpose(answers[name]).tolist()
            answers[name] = answers[name] if quantity["at_times"] else answers[name][-1:]
        elif origin == "modes":
            modes = sorted((mode for mode in json.loads(told["modes"])["modes"] if mode["frequency"] > 0), key=lambda m: m["frequency"])
            answers[name] = [mode[key] for mode in modes]
        else:
            answers[name] = [json.loads(told["result"])[key]]
    return answers


def column(rows: list[dict[str, str]], title: str) -> list[float]:
    """A column of the table, or the length of two, `hypot A B`."""
    if title.startswith("hypot "):
        _, first, second = title.split()
        return [float(np.hypot(float(row[first]), float(row[second]))) for row in rows]
    return [float(row[title]) for row in rows]
