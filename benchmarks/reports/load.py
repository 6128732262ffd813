"""Size of reports and the time until a browser has loaded them: ``python load.py REPORT.html ...``.

Needs playwright, a Chromium on the path and, for ``--large``, the program: ``quasirigid`` on the path, or the one that QUASIRIGID names.
Each page is loaded three times from the disk, drawn in software; the shortest time is given in which it is loaded, its charts are live and
its body is drawn, and the number of messages in the console. ``--large REPORT.html`` copies the record of a report, puts a membrane of
10 000 vertices with six modes in 2000 frames in place of its body, and takes the report that the program makes of it, ``large.html``
beside the first.
"""

from __future__ import annotations

import argparse
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from playwright.sync_api import Browser, Page, sync_playwright

LOADED = """(() => {
  const [{ loadEventEnd }] = performance.getEntriesByType("navigation");
  const marks = ["charts", "viewer"].map((name) => performance.getEntriesByName(`quasirigid:${name}`)[0]?.startTime ?? 0);
  const awaited = [true, document.getElementById("scene")];
  return loadEventEnd && awaited.every((part, i) => !part || marks[i]) ? Math.max(loadEventEnd, ...marks) : 0;
})()"""
PATIENCE = 10  # s


def packed(values: object, kind: str) -> str:
    return base64.b64encode(np.asarray(values, dtype=kind).tobytes()).decode()


def whole(vectors: np.ndarray) -> dict[str, object]:
    unit = float(np.abs(vectors).max()) / 32767
    return {"unit": unit, "values": packed(np.round(vectors / unit), "<i2")}


def enlarged(report: Path) -> Path:
    scene = json.loads((report.parent / "scene.json").read_text())
    side, frames, modes = 100, 2000, range(6)
    x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side)))
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    cells = [corner, corner + 1, corner + side, corner + 1, corner + side + 1, corner + side]
    wave = [np.sin((m % 3 + 1) * np.pi * (x + 1) / 2) * np.sin((m // 3 + 1) * np.pi * (y + 1) / 2) for m in modes]
    piece = {"name": "membrane", "kind": "panel", "lines": None, "size": None, "turning": None}
    piece["vertices"] = whole(np.stack([x, y, 0.1 * (1 - x * x) * (1 - y * y)], axis=-1))
    piece["triangles"] = packed(np.stack(cells, axis=-1), "<u2")
    piece["fields"] = [{"coordinate": m, "vectors": whole(np.stack([0 * x, 0 * x, wave[m]], axis=-1))} for m in modes]
    scene.update(radius=1.5, pieces=[piece], modes=[], coordinates=[{"name": f"mode {m}", "unit": "m"} for m in modes])
    track = scene["track"]
    rows = np.linspace(0, len(base64.b64decode(track["t"])) // 8 - 1, frames).round().astype(int)
    for key, kind, width in [("t", "<f8", 1), ("attitude", "<f4", 4), ("omega", "<f4", 3), ("momentum", "<f4", 3), ("dissipated", "<f8", 1)]:
        track[key] = packed(np.frombuffer(base64.b64decode(track[key]), kind).reshape(-1, width)[rows], kind)
    track["t"] = packed(np.linspace(0, 60, frames), "<f8")
    track["q"] = packed([[0.01 * np.sin(0.01 * (m + 1) * i) for m in modes] for i in range(frames)], "<f4")
    if scene["equations"]:
        scene["equations"]["displacements"] = []
    large = report.with_name("large.html")
    with tempfile.TemporaryDirectory() as folder:
        record = Path(folder) / "record"
        shutil.copytree(report.parent, record)
        (record / "scene.json").write_text(json.dumps(scene))
        program = os.environ.get("QUASIRIGID", "quasirigid")
        subprocess.run([program, "report", record, "--out", large.resolve(), "--overwrite", "--quiet"], check=True)
    return large


def loaded(page: Page) -> float:
    """Milliseconds until all of the page is there."""
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until:
        if spent := page.evaluate(LOADED):
            return float(spent)
        page.wait_for_timeout(20)
    return float("nan")


def tell(browser: Browser, report: Path) -> None:
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    messages: list[str] = []
    page.on("console", lambda message: messages.append(message.text))
    page.on("pageerror", lambda error: messages.append(str(error)))
    times = []
    for _ in range(3):
        page.goto(report.resolve().as_uri())
        times.append(loaded(page))
    name = f"{report.parent.name}/{report.name}"
    print(f"{name:32s} {report.stat().st_size / 1e6:.2f} MB  {min(times) / 1000:.2f} s  {len(messages)} messages")
    page.close()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("reports", nargs="*", type=Path)
    parser.add_argument("--large", type=Path)
    arguments = parser.parse_args()
    reports = arguments.reports + ([enlarged(arguments.large)] if arguments.large else [])
    browsers = ("chromium", "chromium-browser", "google-chrome", "chrome")
    program = next(filter(None, map(shutil.which, browsers)), None)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=program, args=["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        )
        for report in reports:
            tell(browser, report)
