"""Figures of results.json as SVG, in the style of the program's own charts."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

WIDTH, HEIGHT = 760, 460
LEFT, TOP, RIGHT, BOTTOM = 78, 44, 256, 56
COLORS = ("#1f6fb2", "#c8501e", "#2a8a4a", "#8a4fae", "#b08a00", "#0f8f9a", "#a03060", "#60666e", "#6b8e23", "#d06090")
FIGURES = {
    "time-constant": ("Invented time constant against the step", "s"),
    "energy": ("Energy of the triaxial body against time", "s"),
}
OF_STEP = (
    ("NumPy", "explicit Euler"),
    ("NumPy", "semi-implicit Euler on the angular momentum"),
    ("MuJoCo", "Euler"),
    ("MuJoCo", "implicit"),
    ("DART", "semi-implicit Euler"),
    ("PyBullet", "maximal coordinates"),
    ("Basilisk", "RK2"),
    ("Exudyn", "GeneralizedAlpha, rotation vector"),
    ("MuJoCo", "RK4"),
    ("Basilisk", "RK4"),
)
OF_TIME = (
    ("NumPy", "semi-implicit Euler on the angular momentum"),
    ("MuJoCo", "Euler"),
    ("MuJoCo", "implicit"),
    ("MuJoCo", "RK4"),
    ("Drake", "discrete plant"),
    ("Drake", "implicit_euler"),
    ("PyBullet", "multibody, damping 0"),
    ("PhysX (SAPIEN)", "dynamic body, damping 0"),
    ("Basilisk", "RK4"),
)
SHORT = {
    "semi-implicit Euler on the angular momentum": "Euler, K kept",
    "GeneralizedAlpha, rotation vector": "generalized-α",
    "maximal coordinates": "maximal",
    " (SAPIEN) dynamic body": "",
    ", damping 0": "",
}


@dataclass
class Axis:
    """From numbers to pixels."""

    ends: tuple[float, float]
    pixels: tuple[float, float]
    ticks: list[tuple[float, str]] = field(default_factory=list)

    def at(self, value: float) -> float:
        share = (value - self.ends[0]) / (self.ends[1] - self.ends[0])
        return self.pixels[0] + share * (self.pixels[1] - self.pixels[0])


def power(exponent: int) -> str:
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def decades(values: list[float], pixels: tuple[float, float]) -> Axis:
    low, high = math.floor(min(values)), math.ceil(max(values))
    every = 1 if high - low <= 8 else 2
    return Axis((low, high), pixels, [(k, power(k)) for k in range(low, high + 1, every)])


def even(low: float, high: float, count: int, pixels: tuple[float, float]) -> Axis:
    ticks = [low + (high - low) * k / count for k in range(count + 1)]
    return Axis((low, high), pixels, [(tick, f"{round(tick, 10):g}".replace("-", "−")) for tick in ticks])


def chart(title: str, words: tuple[str, str], axes: tuple[Axis, Axis], curves: list[tuple[str, list[tuple[float, float]]]], dots: bool) -> str:
    across, up = axes
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'font-family="Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif" font-size="13"><title>{title}</title>',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/><text x="{LEFT}" y="24" font-weight="bold">{title}</text>',
    ]
    for tick, label in up.ticks:
        y = f"{up.at(tick):.1f}"
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y}" y2="{y}" stroke="#d9dde2"/>')
        parts.append(f'<text x="{LEFT - 8}" y="{up.at(tick) + 4:.1f}" text-anchor="end" fill="#59626d">{label}</text>')
    for tick, label in across.ticks:
        x = f"{across.at(tick):.1f}"
        parts.append(f'<line x1="{x}" x2="{x}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#d9dde2"/>')
        parts.append(f'<text x="{x}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle" fill="#59626d">{label}</text>')
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" text-anchor="middle">{words[0]}</text>')
    parts.append(f'<text transform="translate(18 {middle}) rotate(-90)" text-anchor="middle">{words[1]}</text>')
    for k, (name, points) in enumerate(curves):
        color, y = COLORS[k % len(COLORS)], TOP + 10 + 20 * k
        inside = [(x, value) for x, value in points if up.ends[0] <= value <= up.ends[1]]
        places = [(across.at(x), up.at(value)) for x, value in inside]
        path = " ".join(f"{x:.1f},{v:.1f}" for x, v in places)
        dash = ' stroke-dasharray="6 4"' if k % 2 else ""
        parts.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="1.8"{dash}/>')
        if dots:
            parts += [f'<circle cx="{x:.1f}" cy="{v:.1f}" r="3" fill="{color}"/>' for x, v in places]
        x = WIDTH - RIGHT + 12
        parts.append(f'<line x1="{x}" x2="{x + 22}" y1="{y}" y2="{y}" stroke="{color}" stroke-width="1.8"{dash}/>')
        parts.append(f'<text x="{x + 28}" y="{y + 4}" font-size="11">{name}</text>')
    return "\n".join([*parts, "</svg>\n"])


def chosen(results: dict[str, Any], wanted: tuple[tuple[str, str], ...]) -> list[dict[str, Any]]:
    by_name = {(row["program"], row["name"]): row for row in results["rows"]}
    return [by_name[key] for key in wanted if key in by_name]


def label(row: dict[str, Any]) -> str:
    name = f"{row['program']} {row['name']}"
    for long, short in SHORT.items():
        name = name.replace(long, short)
    return name


def spans() -> tuple[tuple[float, float], tuple[float, float]]:
    return (LEFT, WIDTH - RIGHT), (HEIGHT - BOTTOM, TOP)


def of_step(results: dict[str, Any]) -> str:
    curves = []
    for row in chosen(results, OF_STEP):
        runs = [run for run in row["runs"] if run["body"] == "triaxial" and run["time_constant"] is not None]
        points = sorted((math.log10(run["step"]), math.log10(abs(run["time_constant"]))) for run in runs)
        curves.append((label(row), points))
    every = [point for _, points in curves for point in points]
    across = decades([x for x, _ in every], spans()[0])
    up = decades([y for _, y in every], spans()[1])
    return chart(FIGURES["time-constant"][0], ("step (s)", "|time constant| of the triaxial body (s)"), (across, up), curves, dots=True)


def of_time(results: dict[str, Any]) -> str:
    curves = []
    for row in chosen(results, OF_TIME):
        trace = row["trace"]
        step = f"{row['steps'][0]:g}" if row["tolerance"] else f"{1e3 * row['steps'][0]:.3g} ms"
        curves.append((f"{label(row)}, {step}", list(zip(trace["t"], [100.0 * x for x in trace["energy"]], strict=True))))
    axes = (even(0.0, 600.0, 6, spans()[0]), even(-1.0, 5.0, 6, spans()[1]))
    return chart(FIGURES["energy"][0], ("time (s)", "change of the energy (%)"), axes, curves, dots=False)


def figures(results: dict[str, Any]) -> dict[str, str]:
    return {"time-constant": of_step(results), "energy": of_time(results)}
