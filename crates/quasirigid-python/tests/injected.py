"""Until the reports carry their data: a page with data read from its static curves, and with the scripts of the charts."""

from __future__ import annotations

import base64
import html
import json
import re
from pathlib import Path
from typing import Any

import numpy as np

ASSETS = Path(__file__).resolve().parents[2] / "quasirigid-report" / "src" / "assets"
SCRIPTS = (
    "decode words scale series curve link layer pointer chart zoom keys picture table toolbar start"
).split()
UNITS = {"s": 1, "min": 60, "h": 3600, "d": 86400}
POLICY = "script-src 'unsafe-inline'"
MANY = 400


def packed(values: Any) -> str:
    return base64.b64encode(np.asarray(values, dtype="<f4").tobytes()).decode()


def axis(name: str, ends: str, log: bool) -> dict[str, Any]:
    low, high = map(float, ends.split())
    found = re.fullmatch(r"(.*) \[(?:10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+) ?)?(.*)\]", name)
    assert found, name
    power = (found[2] or "0").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    return {"name": found[1], "unit": found[3], "power": int(power), "low": low, "high": high, "log": log}


def series(path: str, x: Any, y: Any) -> tuple[Any, Any, int]:
    """Points of a curve as drawn; a long one as the extremes of intervals."""
    places = np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", path), dtype=float).reshape(-1, 2)
    places = places[np.argsort(places[:, 0], kind="stable")] if "t" == x["name"] else places
    t = x["low"] + (x["high"] - x["low"]) * places[:, 0] / 800
    v = y["high"] + (y["low"] - y["high"]) * places[:, 1] / 240
    if len(t) < MANY:
        return t, v, len(t)
    rows = []
    for edges in np.array_split(np.arange(len(t)), len(t) // 6):
        low, high = edges[np.argmin(v[edges])], edges[np.argmax(v[edges])]
        rows += [min(low, high), max(low, high)]
    return t[rows], v[rows], 25 * len(rows)


def data(figure: str) -> str:
    unquoted = html.unescape
    ends_x, ends_y, log = re.search(r'data-x="([^"]*)" data-y="([^"]*)"( data-log)?', figure).groups()  # type: ignore[union-attr]
    names = [unquoted(name) for name in re.findall(r'<text class="name(?: end)?"[^>]*>(.*?)</text>', figure)]
    y, x = axis(names[0], ends_y, bool(log)), axis(names[1], ends_x, False)
    x["link"] = {"group": "t", "factor": UNITS[x["unit"]]} if x["name"] == "t" else None
    grids: list[Any] = []
    found = []
    for style, label, path in reversed(re.findall(r'<path class="curve ([^"]*)" data-label="([^"]*)" d="([^"]*)"', figure)):
        t, v, rows = series(path, x, y)
        if packed(t) not in grids:
            grids.append(packed(t))
        found.append({"label": unquoted(label), "class": style, "grid": grids.index(packed(t)), "values": packed(v), "rows": rows, "points": False})
    title = unquoted(re.search(r"<h3>(.*?)</h3>", figure)[1])  # type: ignore[index]
    name = re.search(r'<title id="(.*?)-title"', figure)[1]  # type: ignore[index]
    place = r'<line class="event" x1="([\d.]+)%".*?</line><text[^>]*>(.*?)</text>'
    marks = [{"x": x["low"] + float(at) / 100 * (x["high"] - x["low"]), "label": unquoted(label)} for at, label in re.findall(place, figure)]
    text = json.dumps({"name": name, "title": title, "x": x, "y": y, "grids": grids, "series": found, "marks": marks}, ensure_ascii=False)
    return text.replace("<", "\\u003c")


def injected(text: str) -> str:
    """The page with data and scripts; what it carries already stays as it is."""
    if "startPlots" in text:
        return text

    def with_data(found: re.Match[str]) -> str:
        figure = found[0]
        if "data-x=" not in figure:
            return figure
        return figure.replace("</figure>", f'<script type="application/json" class="figure-data">{data(figure)}</script></figure>')

    if "figure-data" not in text:
        text = re.sub(r"<figure>.*?</figure>", with_data, text, flags=re.DOTALL)
    scripts = "".join((ASSETS / "plot" / f"{name}.js").read_text() for name in SCRIPTS)
    start = text.index("<script>// Reads the values")
    end = text.index("</script>", start)
    text = f'{text[:start]}<script>(() => {{\n"use strict";\n{scripts}}})();\n{text[end:]}'
    viewer = text.find('"use strict";\n// Typed arrays from base64. The scene')
    if viewer >= 0:
        new = (ASSETS / "viewer" / "controls.js").read_text()
        at = text.index(new.split("\n", 1)[0], viewer)
        text = text[:at] + new.rstrip("\n") + text[text.index("\n// Starts the viewer", at) :]
    if "img-src" not in text:
        text = text.replace(POLICY, f"{POLICY}; img-src data:")
    return text.replace("</style>", (ASSETS / "plot" / "plot.css").read_text() + "</style>", 1)
