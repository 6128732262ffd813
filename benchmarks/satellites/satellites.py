"""`evolve` on random satellites: how long each answer takes, and how far it is from the full system.

    python satellites.py QUASIRIGID [--count 100] [--seed 1] [--folder FOLDER]

Every satellite has one or two kinds of parts that bend or dissipate, spins at 0.1 to 60 rpm and wobbles by 1 to 30 degrees about its axis of
greatest or least inertia. Asked for the whole fall of the wobble, `evolve` answers or refuses; asked for a few hundred revolutions, its loss of energy
is compared with that of the full system.
"""

import argparse
import csv
import json
import math
import random
import subprocess
import time
from pathlib import Path

LIMIT = 120.0  # s, for each command
REVOLUTIONS = 300


def log_uniform(draw: random.Random, low: float, high: float) -> float:
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def vector(draw: random.Random, size: float) -> list[float]:
    return [round(draw.uniform(-size, size), 4) for _ in range(3)]


def points(draw: random.Random, mass: float, size: float) -> str:
    text = ""
    for name in ["tip", "mast"][: draw.randint(1, 2)]:
        m = mass * log_uniform(draw, 0.002, 0.05)
        f, zeta = log_uniform(draw, 0.5, 20.0), log_uniform(draw, 0.002, 0.1)
        k = m * (2 * math.pi * f) ** 2
        damping = 2 * zeta * math.sqrt(k * m)
        position = vector(draw, 2 * size)
        text += f'[[point]]\nname = "{name}"\nmass = {m:.5g}\nposition = {position}\n'
        text += f'[[spring]]\nfrom = "{name}"\nto = "carrier"\nstiffness = {k:.6g}\ndamping = {damping:.5g}\n'
    return text


def panels(draw: random.Random, mass: float, size: float) -> str:
    m, length = mass * log_uniform(draw, 0.01, 0.06), size * draw.uniform(0.8, 2.5)
    f, zeta = log_uniform(draw, 0.3, 10.0), log_uniform(draw, 0.002, 0.05)
    about, text = m * length**2 / 3, ""
    for name, side in (("panel +y", 1), ("panel -y", -1)):
        inertia = [m * length**2 / 12, m * size**2 / 24, 0.999 * m * (length**2 + size**2 / 2) / 12]
        text += f'[[hinged]]\nname = "{name}"\nmass = {m:.5g}\ncenter_of_mass = [0, {side * (size + length) / 2:.5g}, 0.05]\n'
        text += f"inertia = {[float(f'{i:.5g}') for i in inertia]}\nhinge = [0, {side * size / 2:.5g}, 0.05]\naxes = [[1, 0, 0]]\n"
        text += f'stiffness = "{about * (2 * math.pi * f) ** 2:.6g} N m/rad"\n'
        text += f'damping = "{2 * zeta * about * 2 * math.pi * f:.5g} N m s/rad"\n'
    return text


def beam(draw: random.Random, mass: float, size: float) -> str:
    length, radius = size * draw.uniform(1.0, 4.0), size * draw.uniform(0.008, 0.02)
    tip, lag = mass * log_uniform(draw, 0.001, 0.01), log_uniform(draw, 1e-4, 3e-3)
    root = [0.05, -0.02, size / 2]
    end = [0.05 + 0.1 * length, -0.02, size / 2 + length]
    return (
        f'[material.cfrp]\ndensity = "1.6 g/cm^3"\nyoung = "100 GPa"\npoisson = 0.3\n'
        f'rheology = {{ kind = "kelvin-voigt", time = {lag:.4g} }}\n'
        f'[section.tube]\nshape = "tube"\nradius = {radius:.4g}\nthickness = {0.1 * radius:.4g}\n'
        f'[[beam]]\nname = "boom"\nnodes = {{ root = {root}, tip = {end} }}\nlines = [["root", "tip"]]\nsection = "tube"\n'
        f'material = "cfrp"\nmasses = [{{ node = "tip", mass = {tip:.4g} }}]\nattach = "root"\n'
    )


def rotor(draw: random.Random, mass: float, size: float) -> str:
    inertia = mass * size**2 * log_uniform(draw, 1e-4, 1e-2)
    settles = log_uniform(draw, 0.02, 1.0)
    return f'[[rotor]]\nname = "damper"\naxis = {vector(draw, 1)}\ninertia = {inertia:.5g}\nfriction = {inertia / settles:.5g}\n'


def liquid(draw: random.Random, mass: float, size: float) -> str:
    radius = size * draw.uniform(0.05, 0.15)
    return (
        f'[[cavity]]\nname = "ring"\nshape = "sphere"\nradius = {radius:.4g}\ncenter = {vector(draw, size / 4)}\n'
        f'density = "1.0 g/cm^3"\nkinematic_viscosity = {log_uniform(draw, 1e-4, 1e-1) * radius**2:.4g}\n'
    )


def wheel(draw: random.Random, mass: float, size: float, spin: float) -> str:
    momentum = mass * size**2 / 6 * spin * log_uniform(draw, 0.02, 0.5)
    return f'[[wheel]]\nname = "bias"\naxis = {vector(draw, 1)}\nmomentum = {momentum:.5g}\n'


KINDS = {"points": points, "panels": panels, "beam": beam, "rotor": rotor, "liquid": liquid}


def satellite(seed: int) -> tuple[str, str, float]:
    """Kinds of the parts, model file, and spin (rad/s)."""
    draw = random.Random(seed)
    mass, size = log_uniform(draw, 4.0, 1500.0), 0.0
    size = 0.18 * mass ** (1 / 3)
    spin = log_uniform(draw, 0.1, 60.0) * 2 * math.pi / 60
    thirds = sorted(draw.uniform(0.7, 1.3) for _ in range(3))
    draw.shuffle(thirds)
    inertia = [float(f"{mass * size**2 / 6 * third:.5g}") for third in thirds]
    kinds = draw.sample(sorted(KINDS), draw.choice([1, 1, 2]))
    text = f"[body]\nname = \"satellite {seed}\"\n[carrier]\nmass = {mass:.5g}\ncenter_of_mass = {vector(draw, 0.02 * size)}\n"
    text += f"inertia = {inertia}\n" + "".join(KINDS[kind](draw, mass, size) for kind in kinds)
    if draw.random() < 0.15:
        text += wheel(draw, mass, size, spin)
        kinds.append("wheel")
    mode = draw.choice(["short-axis", "short-axis", "long-axis"])
    angle = draw.uniform(1.0, 30.0)
    text += f'[initial]\nwobble = {{ angle = "{angle:.3f} deg", rate = {spin:.5g}, mode = "{mode}" }}\n'
    return "+".join(kinds), text, spin


def answer(command: list[str]) -> tuple[int | None, float, dict, str]:
    begin = time.perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return None, LIMIT, {}, "out of time"
    record = json.loads(done.stdout) if done.stdout.strip().startswith("{") else {}
    return done.returncode, time.perf_counter() - begin, record, " ".join(done.stderr.split())


def losses(program: str, model: Path, spin: float) -> tuple[float, float] | None:
    """Energy (J) lost in the second half of a few hundred revolutions, by `evolve` and by the full system; none where either has no answer. In the first
    half the vibrations of the start die out, whose energy is none of the wobble."""
    revolutions = REVOLUTIONS * 2 * math.pi / spin
    table = model.with_suffix(".csv")
    asked = ["--duration", str(revolutions), "--samples", "3", "--out", str(table), "--overwrite", "--json"]
    code, _, _, _ = answer([program, "evolve", str(model), *asked])
    if code != 0:
        return None
    with table.open() as file:
        rows = list(csv.DictReader(file))
    if len(rows) < 3:
        return None
    middle, end = rows[-2], rows[-1]
    lost = []
    for row in (middle, end):
        ends = ["--duration", row["t"], "--samples", "2", "--json"]
        code, _, full, _ = answer([program, "simulate", str(model), "--system", "full", *ends])
        if code != 0:
            return None
        lost.append(full["dissipated"])
    return float(middle["energy"]) - float(end["energy"]), lost[1] - lost[0]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=Path, default=Path("satellites"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(exist_ok=True)
    rows = []
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        kinds, text, spin = satellite(seed)
        model = arguments.folder / f"{seed}.toml"
        model.write_text(text)
        code, seconds, record, told = answer([arguments.program, "evolve", str(model), "--json"])
        both = losses(arguments.program, model, spin) if code == 0 else None
        gap = both[0] / both[1] - 1 if both and both[1] else None
        rows.append((code, seconds, gap))
        print(f"{seed:4} {kinds:22} {spin * 30 / math.pi:7.2f} rpm  exit {code}  {seconds:7.2f} s", end="  ")
        print(f"{record.get('road')}  " + (f"{100 * gap:+.2f} %" if gap is not None else "-"), flush=True)
        if code != 0:
            print("      " + (record.get("message") or told)[:200])
    answered = [row for row in rows if row[0] == 0]
    gaps = sorted(abs(row[2]) for row in rows if row[2] is not None)
    print(f"{len(answered)} of {len(rows)} answered; longest {max(row[1] for row in rows):.1f} s")
    if gaps:
        print(f"{len(gaps)} compared: median {100 * gaps[len(gaps) // 2]:.2f} %, largest {100 * gaps[-1]:.2f} %")


if __name__ == "__main__":
    main()
