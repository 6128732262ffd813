"""README.md and its figures from results.json: `python benchmarks/audit/page.py`. Standard library alone, so that a test can make them again."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from figure import FIGURES, figures

HERE = Path(__file__).parent
RESULTS = HERE / "results.json"
SAME_ORDER = 0.1
BODIES = ("oblate", "triaxial", "prolate")
INTRO = """# Damping that simulators invent

Three rigid bodies turn freely, without torque, friction or damping. Their energy and angular momentum are constant, and their wobble neither decays
nor grows. What a simulator shows instead, it invents: the table has the time in which the wobble falls e-fold, negative where it grows, by
[`quasirigid audit`](../../docs/guide/22-audit.md). Longer is better; *none* is best.

| body | moments (kg m²) | start (rad/s) |
|---|---|---|
| oblate | 10, 10.1, 17 | 0.15, 0, 1 |
| triaxial | 10, 14, 17 | 0.15, 0, 1 |
| prolate | 5, 16, 17 | 1, 0, 0.03 |

Each was followed for ten minutes (Newton: one), or until its wobble or its angular momentum had changed e-fold. Everything else is the program's
default. *Step* is the default, or that of the program's tutorials or examples, as *of* says; a tolerance or accuracy where the program chooses its steps.
November 2026.

## Time constants

Seconds at a spin of 1 rad/s. *K* is the relative change of the angular momentum of the triaxial body over that time, *order* the power of the step with which the invented rate
falls, *a year* the step with which the triaxial body would keep its wobble for a year, *ratio* the time constant by the audit over that by
[bookkeeping of the energy](bookkeeping.py), the one furthest from 1.

"""
READ = """
**Bold** is what a user gets who asks for nothing else. A first-order method keeps the wobble of a body at 1 rad/s for a year if its step is half a
microsecond. A *~* marks a trend that is not steady: the halves of the history differ from it by more than a fifth. Order, year and ratio are of steady ones; there is no order where fine and coarse steps show different ones, as rounding in single
precision makes them. Where a body is damped by default, its spin falls before a wobble can be told; the page says how fast.

*Other spins.* Euler's equations have no time of their own: a spin of Ω with the step h is one of 1 rad/s with the step Ωh, in a time Ω times as short. For a method of order p the time constant
falls with the power p + 1 of the spin: at 10 rad/s, measured, *10 rad/s* has the triaxial body at the first step.

## Twice as fine
"""
END = """
## Not in the table

- **Project Chrono**: `pychrono` of the Python index is another package; Chrono's own is for conda, which was not at hand.
- **Gyroscopic forces of PhysX** are off by default in PhysX itself; then the rates in the body stay as they are, and there is no wobble to audit.
- **brax, Newton's MuJoCo solver, Rapier, Jolt**: not run.

## Run it

With a Python environment for most programs, and one for MJX and Newton:

```sh
pip install -r benchmarks/audit/requirements.txt
pip install -r benchmarks/audit/requirements-warp.txt
python benchmarks/audit/run.py target/release/quasirigid --only plain,mujoco_,scipy_
```

A program that is not installed is skipped with a message, and its rows stay as they were. `simulators/` has one module a program; each writes rows of time,
rates and attitude. The results are in [results.json](results.json), this page is [page.py](page.py) of them.
"""


def constant(run: dict[str, Any]) -> str:
    """A time constant (s) in words."""
    found = run["time_constant"]
    if found is not None:
        return number(found) if run["steady"] else f"~{number(found)}"
    return "–" if run["longest"] is None else f"none below {number(run['longest'])}"


def number(value: float) -> str:
    """Three digits; powers of ten from a million on and below a thousandth."""
    if value == 0.0:
        return "0"
    if 1e-3 <= abs(value) < 1e6:
        rounded = float(f"{value:.3g}")
        return (f"{rounded:g}" if abs(value) < 1e5 else f"{rounded:.0f}").replace("-", "−")
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}".replace("-", "−")


def is_sharp(run: dict[str, Any]) -> bool:
    """Whether the trend is steady, and ten times above what the file can show."""
    found = run["time_constant"]
    return found is not None and run["steady"] and abs(found) < 0.1 * run["longest"]


def at(row: dict[str, Any], body: str, index: int = 0) -> dict[str, Any]:
    step = row["steps"][index]
    return next(run for run in row["runs"] if run["body"] == body and run["step"] == step)


def step_words(row: dict[str, Any], step: float) -> str:
    if row["tolerance"]:
        return f"{number(step)}"
    return f"{number(1e3 * step)} ms" if step < 0.1 else f"{number(step)} s"


def spin_fall(row: dict[str, Any]) -> float:
    """Time (s) in which a damped spin falls e-fold, of the history that was cut there."""
    run = at(row, "triaxial")
    return -run["duration"] / math.log1p(run["momentum_change"])


def ratio(row: dict[str, Any]) -> float | None:
    """The ratio of the two roads furthest from 1, of sharp runs."""
    ratios = [run["time_constant"] / run["bookkeeping"] for run in row["runs"] if is_sharp(run)]
    return max(ratios, key=lambda ratio: abs(math.log(ratio)), default=None)


def has_order(row: dict[str, Any]) -> bool:
    """Whether the finest and the coarsest two steps of the triaxial body have about one order: not where rounding decides at fine steps."""
    runs = [run for run in row["runs"] if run["body"] == "triaxial" and is_sharp(run)]
    points = sorted((math.log(run["step"]), -math.log(abs(run["time_constant"]))) for run in runs)
    if row["order"] is None or len(points) < 2:
        return False
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in (points[:2], points[-2:])]
    return abs(slopes[0] - slopes[1]) < SAME_ORDER


def names(row: dict[str, Any]) -> str:
    mark = "**" if row["default"] else ""
    return f"{row['program']} {row['version']} | {mark}{row['name']}{mark}"


def line(row: dict[str, Any]) -> str:
    first = at(row, "triaxial")
    shown, own = (row["order"] if has_order(row) else None) or {}, ratio(row)
    order = f"{shown['order']:.2f}" if shown.get("order") else "–"
    year = f"{number(shown['year_step'])} s" if shown.get("year_step") else "–"
    if row["damping"]:
        told = f"damped: the spin falls e-fold in {number(spin_fall(row))} s | – | –"
        order = year = "–"
        own = None
    else:
        told = " | ".join(constant(at(row, body)) for body in BODIES)
    cells = [names(row), step_words(row, first["step"]), row["of"], told, number(first["momentum_change"]), order, year]
    return f"| {' | '.join(cells)} | {'–' if own is None else f'{own:.3f}'} |"


def finer(row: dict[str, Any]) -> str:
    if row["damping"]:
        return ""
    told = " | ".join(constant(at(row, body, 1)) for body in BODIES)
    fast = row["fast"]
    return f"| {names(row)} | {step_words(row, row['steps'][1])} | {told} | {'–' if fast is None else constant(fast)} |"


def table(rows: list[dict[str, Any]]) -> str:
    heading = "| program | integrator | step | of | oblate | triaxial | prolate | K | order | a year | ratio |\n|" + "---|" * 11
    return "\n".join([heading, *map(line, rows)])


def second_table(rows: list[dict[str, Any]]) -> str:
    heading = "| program | integrator | step | oblate | triaxial | prolate | 10 rad/s |\n|" + "---|" * 7
    return "\n".join([heading, *filter(None, map(finer, rows))])


def reasons(rows: list[dict[str, Any]]) -> str:
    told = []
    for row in rows:
        damping = f" Default: {row['damping']}." if row["damping"] else ""
        told.append(f"- **{row['program']}, {row['name']}.** {row['why']}{damping}")
    return "\n".join(told)


def pictures() -> str:
    told = ["## Figures"]
    for name, (title, _) in FIGURES.items():
        told.append(f"![{title}]({name}.svg)")
    told.append("In the first figure a line has the slope of its order. In the second the energy of the triaxial body runs away by itself: nothing acts on it, and default damping is off.")
    return "\n\n".join(told)


def page(results: dict[str, Any]) -> str:
    rows = results["rows"]
    parts = [INTRO + table(rows), READ, second_table(rows), "\n## Why\n", reasons(rows), "", pictures(), END]
    return "\n".join(parts)


def write(file: Path = HERE / "README.md") -> None:
    results = json.loads(RESULTS.read_text())
    file.write_text(page(results))
    for name, text in figures(results).items():
        (HERE / f"{name}.svg").write_text(text)


if __name__ == "__main__":
    write()
