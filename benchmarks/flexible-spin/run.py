"""Scores the answers of any program against the flexible spin benchmark, and makes its two solutions again.

    python benchmarks/flexible-spin/run.py --answers answers.json
    python benchmarks/flexible-spin/run.py --program target/release/quasirigid

The first scores a file `{problem: {quantity: values}}`; the second makes both solutions of every problem and compares them with the
references and with each other. Exit code 0 if all pass, 1 if one does not, 2 if nothing could be scored.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import solvers

DIGITS = 13


@dataclass(frozen=True)
class Score:
    """A quantity's largest error in parts of its largest reference value; `solution` that it is of, `why` where no number can be told."""

    problem: str
    quantity: str
    error: float
    tolerance: float
    why: str = ""
    solution: str = "answers"

    @property
    def passed(self) -> bool:
        return not self.why and self.error <= self.tolerance


def scored(problem: dict[str, Any], answers: Any, against: Any = None) -> list[Score]:
    """Scores of every quantity of a problem, against its references or other answers."""
    scores = []
    for name, quantity in problem["quantities"].items():
        right = np.array(quantity["values"] if against is None else against[name], float)
        tolerance = float(quantity["tolerance"])
        try:
            given = np.array(answers[name], float)
        except (KeyError, TypeError):
            scores.append(Score(problem["name"], name, np.nan, tolerance, "no answer"))
            continue
        except ValueError:
            scores.append(Score(problem["name"], name, np.nan, tolerance, "not a list of numbers"))
            continue
        if given.shape != right.shape:
            why = f"shape {list(given.shape)}, asked {list(right.shape)}"
            scores.append(Score(problem["name"], name, np.nan, tolerance, why))
        elif not np.isfinite(given).all():
            scores.append(Score(problem["name"], name, np.nan, tolerance, "not finite"))
        else:
            error = float(np.abs(given - right).max() / np.abs(right).max())
            scores.append(Score(problem["name"], name, error, tolerance))
    return scores


def table(scores: list[Score]) -> str:
    lines = [f"{'problem':<20} {'quantity':<16} {'of':<12} {'error':>9} {'tolerance':>9} {'ratio':>9}"]
    for score in scores:
        number = score.why or f"{score.error:9.1e} {score.tolerance:9.0e} {score.error / score.tolerance:9.2g}"
        lines.append(f"{score.problem:<20} {score.quantity:<16} {score.solution:<12} {number}  {'pass' if score.passed else 'FAIL'}")
    passed = sum(score.passed for score in scores)
    return "\n".join([*lines, f"{passed} of {len(scores)} quantities pass"])


def made_again(chosen: dict[str, dict[str, Any]], program: Path) -> list[Score]:
    """Both solutions of the problems against the references, and against each other."""
    scores = []
    for name, problem in chosen.items():
        begun = time.perf_counter()
        answers = {"independent": solvers.independent(problem), "program": solvers.full_solver(problem, program)}
        found = {solution: scored(problem, given) for solution, given in answers.items()}
        found["apart"] = scored(problem, answers["program"], answers["independent"])
        for solution, rows in found.items():
            scores += [replace(row, solution=solution) for row in rows]
        print(f"{name}: {time.perf_counter() - begun:.1f} s", file=sys.stderr)
    return scores


def written(chosen: dict[str, dict[str, Any]]) -> None:
    """References anew, by the independent solution."""
    for file in sorted((solvers.FOLDER / "problems").glob("*.json")):
        problem = json.loads(file.read_text())
        if problem["name"] in chosen:
            answers = solvers.independent(problem)
            for name, quantity in problem["quantities"].items():
                quantity["values"] = rounded(answers[name])
            file.write_text(json.dumps(problem, indent=2, ensure_ascii=False) + "\n")


def rounded(values: Any) -> Any:
    return [rounded(value) for value in values] if isinstance(values, list) else float(f"{values:.{DIGITS}g}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--answers", type=Path, help="file of answers to score")
    parser.add_argument("--program", type=Path, help="makes both solutions again, one with this program")
    parser.add_argument("--only", help="names of problems, separated by commas")
    parser.add_argument("--write", action="store_true", help="writes the references anew, by the independent solution")
    given = parser.parse_args()
    known = solvers.problems()
    names = given.only.split(",") if given.only else list(known)
    if unknown := [name for name in names if name not in known]:
        print(f"run.py: no problem {', '.join(unknown)}; there are {', '.join(known)}", file=sys.stderr)
        return 2
    chosen = {name: known[name] for name in names}
    if given.write:
        written(chosen)
        return 0
    try:
        if given.answers and given.program:
            parser.error("give --answers or --program, not both")
        if given.answers:
            answers = json.loads(given.answers.read_text())
            if not isinstance(answers, dict):
                raise ValueError(f"{given.answers}: not an object of problems; write {{problem: {{quantity: values}}}}")
            scores = [score for name, problem in chosen.items() for score in scored(problem, answers.get(name))]
        elif given.program:
            scores = made_again(chosen, given.program)
        else:
            parser.error("give --answers FILE or --program PATH")
    except (OSError, ValueError, RuntimeError) as error:
        print(f"run.py: {error}", file=sys.stderr)
        return 2
    print(table(scores))
    return 0 if all(score.passed for score in scores) else 1


if __name__ == "__main__":
    sys.exit(main())
