"""Long histories: the cost of a revolution and the drift of the energy, of quasirigid beside WHFast, the symplectic
integrator of REBOUND for planets.

Run from this folder, with NumPy and REBOUND installed and the program built: ``python long.py``. The body is that of
``examples/three-masses``, spun slower so that its losses take longer: over a revolution they fall with the fourth power of the spin. A row has
processor time, that of a revolution, the error of the energy, and that error relative to the energy dissipated, where some is. The problems
are not the same; what can be compared is what it costs to go once around, and what the energy does meanwhile.
"""

from __future__ import annotations

import json
import re
import resource
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import rebound

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "target" / "dist" / "quasirigid"
MODEL = ROOT / "examples" / "three-masses" / "model.toml"
ROWS = 101


def processor() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def slower(text: str, factor: float) -> tuple[str, float]:
    """The model with its spin divided by a factor, and the size of that spin (rad/s)."""
    found = re.search(r"angular_velocity = (\[.*\])", text)
    assert found is not None
    spin = np.array(json.loads(found[1])) / factor
    return text.replace(found[0], f"angular_velocity = {spin.tolist()}"), float(np.linalg.norm(spin))


def quasirigid(folder: Path, factor: float, revolutions: float) -> tuple[float, float, float, float]:
    """Processor time (s), revolutions made, drift of the energy relative to its start, and relative to what was dissipated."""
    text, spin = slower(MODEL.read_text(), factor)
    model = folder / "model.toml"
    model.write_text(text)
    duration = f"{revolutions * 2 * np.pi / spin:.17g}"
    command = [str(PROGRAM), "simulate", str(model), "--duration", duration, "--samples", str(ROWS), "--json"]
    before = processor()
    done = subprocess.run(command, capture_output=True, check=True, text=True)
    used = processor() - before
    last = json.loads(done.stdout)
    drift = abs(last["energy_drift"])
    return used, last["turns"], drift / last["energy"], drift / last["dissipated"]


def whfast(orbits: float) -> tuple[float, float]:
    """Processor time (s) of Jupiter and Saturn around the Sun, and the largest error of their energy, relative."""
    simulation = rebound.Simulation()
    simulation.add(m=1.0)
    simulation.add(m=9.55e-4, a=5.2, e=0.048)
    simulation.add(m=2.86e-4, a=9.58, e=0.054, inc=0.02)
    simulation.move_to_com()
    period = simulation.particles[1].P
    simulation.integrator = "whfast"
    simulation.dt = period / 20.3
    simulation.integrator.corrector = 11
    simulation.integrator.safe_mode = 0
    first, largest = simulation.energy(), 0.0
    before = time.process_time()
    for end in np.linspace(0.0, orbits * period, 21)[1:]:
        simulation.integrate(float(end), exact_finish_time=0)
        simulation.synchronize()
        largest = max(largest, abs(simulation.energy() / first - 1))
    return time.process_time() - before, largest


def main() -> None:
    print("| program | revolutions | s | of a revolution | error of the energy | of the dissipated |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        used, made, error, of_loss = quasirigid(Path(folder), 5.0, 1e6)
    row = ["quasirigid", f"{made:.2g}", f"{used:.2f}", f"{1e9 * used / made:.3g} ns", f"{error:.1e}", f"{of_loss:.1e}"]
    print("| " + " | ".join(row) + " |", flush=True)
    for orbits in (1e4, 1e6):
        used, error = whfast(orbits)
        row = ["REBOUND, WHFast, Jupiter and Saturn", f"{orbits:.2g}", f"{used:.2f}", f"{1e9 * used / orbits:.3g} ns", f"{error:.1e}", ""]
        print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
