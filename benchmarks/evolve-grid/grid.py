"""`quasirigid evolve` against integrated full systems, over bodies drawn at random.

    python3 grid.py PROGRAM [--seed 1] [--cases 300]

Draws carriers with one sprung mass (on a line or free), a boom on a hinge or a flywheel on friction: tuning, damping ratio 0.003 to 1, share of
the mass 1e-4 to 0.03, spin over frequency 0.01 to 10, wobbles of 2 to 25 degrees about either axis. Each answer of a method other than the full
system itself is compared with `--method full`: the full system from start to end, by the same wobbles (energies would not do: a soft part
holds a part of them at rest in the spin). Prints a line a case and a table.
"""

import argparse
import json
import math
import random
import subprocess
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def model(draw):
    """A model file, and what it holds."""
    kind = draw.choice(["line", "line", "free", "hinge", "rotor"])
    inertia = sorted([draw.uniform(8, 12), draw.uniform(12, 14), draw.uniform(15, 19)])
    mode = draw.choice(["short-axis", "short-axis", "long-axis"])
    angle = draw.choice([2, 5, 12, 25])
    zeta, share = log_uniform(draw, 0.003, 1), log_uniform(draw, 1e-4, 0.03)
    nutation = math.sqrt((inertia[2] - inertia[0]) * (inertia[2] - inertia[1]) / (inertia[0] * inertia[1]))
    tuned = draw.random() < 0.4
    frequency = nutation * draw.choice([0.97, 1.0, 1.03, 1.1]) if tuned else 1.0 / log_uniform(draw, 0.01, 10)
    mass = 100 * share
    text = f"[carrier]\nmass = 100.0\ncenter_of_mass = [0, 0, 0]\ninertia = {inertia}\n"
    if kind in ("line", "free"):
        line = "motion = { line = [0.1, 0, 1] }\n" if kind == "line" else ""
        text += f'[[point]]\nname = "p"\nmass = {mass}\nposition = [0.4, 0.2, 0.2]\n{line}'
        text += f'[[spring]]\nfrom = "p"\nto = "carrier"\nstiffness = {mass * frequency**2}\n'
        text += f"damping = {2 * zeta * mass * frequency}\n"
    elif kind == "hinge":
        arm = 0.5
        own, whole = mass * arm**2 / 3, mass * arm**2 * 4 / 3
        text += f'[[hinged]]\nname = "b"\nmass = {mass}\ncenter_of_mass = [0.8, 0, 0.1]\ninertia = [0.0, {own}, {own}]\n'
        text += "hinge = [0.3, 0, 0.1]\naxes = [[0, 1, 0], [0, 0, 1]]\n"
        text += f"stiffness = {whole * frequency**2}\ndamping = {2 * zeta * whole * frequency}\n"
    else:
        wheel = 8 * log_uniform(draw, 1e-3, 0.2)
        text += f"[[rotor]]\naxis = [1, 0.2, 0]\ninertia = {wheel}\nfriction = {wheel * log_uniform(draw, 0.01, 10)}\n"
    until = f"{angle * draw.choice([0.1, 0.3]):g} deg" if mode == "short-axis" else "5 deg"
    text += f'[initial]\nwobble = {{ angle = "{angle} deg", rate = 1.0, mode = "{mode}" }}\n'
    known = dict(kind=kind, mode=mode, angle=angle, ratio=1 / frequency, zeta=zeta, share=share, tuned=tuned)
    return text, until, known


def run(program, *arguments, timeout=900):
    """What the program did; the code 124 if it took longer than allowed."""
    try:
        return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(program, 124, "", "took too long")


def judge(program, folder, number, drawn):
    """The word for a case, and the relative error where it was measured, with the error told."""
    text, until, known = drawn
    file = folder / f"{number}.toml"
    file.write_text(text + f'[run]\nevolve = {{ until = "{until}" }}\n')
    answer = run(program, "evolve", str(file), "--json", "--quiet")
    if answer.returncode == 124:
        print(number, "too slow", known, flush=True)
        return "too slow", None
    if answer.returncode != 0:
        unstable = "unstable" in answer.stdout + answer.stderr or "no steady spin" in answer.stderr
        print(number, "unstable spin" if unstable else "refused", known, flush=True)
        return ("unstable spin" if unstable else "refused"), None
    found = json.loads(answer.stdout)
    if found["road"] == "direct":
        return "direct", None
    if found["turns"] > 1e5:
        return found["road"] + ", too long for the full system", None
    direct = run(program, "evolve", str(file), "--json", "--quiet", "--method", "full")
    if direct.returncode != 0:
        print(number, found["road"], "the full system gave no answer", direct.stderr.strip(), known, flush=True)
        return found["road"] + ", the full system gave no answer", None
    error = found["time"] / json.loads(direct.stdout)["time"] - 1
    told = found["time_error"] or 0.0
    beyond = "" if abs(error) <= told else ", MORE THAN TOLD"
    print(
        number, found["road"], f"{100 * error:.3f} %, told {100 * told:.3f} %{beyond}, {found['turns']:.4g} turns", known, flush=True
    )
    return found["road"], (error, told)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=300)
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    words, errors = Counter(), {}
    with tempfile.TemporaryDirectory() as folder:
        cases = [model(draw) for _ in range(arguments.cases)]
        with ThreadPoolExecutor() as workers:
            judged = workers.map(lambda case: judge(arguments.program, Path(folder), *case), enumerate(cases))
        for word, error in judged:
            words[word] += 1
            if error is not None:
                errors.setdefault(word, []).append((abs(error[0]), abs(error[0]) > error[1]))
    for word, count in sorted(words.items()):
        worst = ""
        if word in errors:
            off, beyond = zip(*errors[word])
            worst = f", worst error {100 * max(off):.2f} %, more than told {sum(beyond)}"
        print(f"{word:<42} {count:>4}{worst}")
    steady = arguments.cases - words["unstable spin"]
    print(f"answered {steady - words['refused'] - words['too slow']} of {steady} with a stable spin")


if __name__ == "__main__":
    main()
