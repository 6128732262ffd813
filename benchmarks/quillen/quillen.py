"""Wobbling mass-spring bodies simulated by other people, through `quasirigid evolve` as a user would run them.

Each row of `data/published/quillen_2019/runs.csv` becomes a homogeneous Kelvin-Voigt ellipsoid; the power at the start of its evolution is
compared with the rate at which the simulated body lost energy. No parameter is adjusted.

    cargo build --profile dist -p quasirigid-cli
    python3 benchmarks/quillen/quillen.py [PROGRAM]
"""

import csv
import json
import math
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target/dist/quasirigid")
MODEL = """\
[material.network]
density = {density!r}
young = {young!r}
poisson = 0.25
rheology = {{ kind = "kelvin-voigt", time = {time!r} }}
[[ellipsoid]]
name = "solid"
semi_axes = {axes!r}
material = "network"
[initial]
angular_velocity = {omega!r}
"""


def model(row: dict[str, str]) -> str:
    b, c = float(row["b_over_a"]), float(row["c_over_a"])
    long = (b * c) ** (-1 / 3)
    return MODEL.format(
        density=0.75 / math.pi,
        young=float(row["young_outer"]),
        time=float(row["kelvin_voigt_time"]),
        axes=[long, long * b, long * c],
        omega=[float(row["omega_" + axis]) for axis in "xyz"],
    )


def main() -> None:
    with (ROOT / "data/published/quillen_2019/runs.csv").open() as file:
        rows = list(csv.DictReader(file))
    ratios: dict[bool, list[float]] = {True: [], False: []}
    times, refused = [], 0
    print("run    steady  simulated, W   evolve, W     ratio  method    seconds")
    for row in rows:
        steady = row["steady_within_10pct"] == "1"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "model.toml"
            path.write_text(model(row))
            before = time.perf_counter()
            ran = subprocess.run([PROGRAM, "evolve", path, "--json", "--quiet"], capture_output=True, text=True, check=False)
            seconds = time.perf_counter() - before
        times.append(seconds)
        lost = -float(row["dEdt_measured"])
        answer = json.loads(ran.stdout) if ran.stdout.strip() else {"message": ran.stderr}
        if ran.returncode != 0:
            refused += 1
            print(f"{row['run']:<6} {steady!s:<6}  {lost:<13.4e}  exit {ran.returncode}: {' '.join(answer['message'].split())}")
            continue
        ratio = lost / answer["power"]
        ratios[steady].append(ratio)
        print(f"{row['run']:<6} {steady!s:<6}  {lost:<13.4e}  {answer['power']:<12.4e}  {ratio:5.3f}  {answer['road']:<8}  {seconds:.2f}")
    print(f"{len(rows)} runs, {len(rows) - refused} answered, {statistics.median(times):.2f} s each in the median, {max(times):.2f} s at most")
    for steady, found in ratios.items():
        gaps = [abs(ratio - 1) for ratio in found]
        name = "steady rates" if steady else "other rates"
        print(f"{name}: {len(found)}, ratio {statistics.median(found):.3f} in the median, gap {statistics.median(gaps):.1%} in the median, {max(gaps):.1%} at most")


if __name__ == "__main__":
    main()
