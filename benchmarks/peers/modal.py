"""A spinning elastic bar by hundreds of its modes: quasirigid and Exudyn on the same shapes, frequencies and mass matrix.

python modal.py 32 96 600
python modal.py 600 --duration 0.1 --steps 10,20

Takes the numbers of modes; needs `target/dist/quasirigid`. The bar floats freely, is made of rectangular hexahedra, and takes
energy in proportion to its stiffness. Without Exudyn the table has quasirigid alone. A row has one thread: seconds from the files
or arrays to the spin at the end, of quasirigid the shortest of some runs, and the part of them before the first step.
"""

import argparse
import json
import os
import subprocess
import time
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import scipy.io
import scipy.linalg
import scipy.sparse

PROGRAM = Path(__file__).resolve().parents[2] / "target" / "dist" / "quasirigid"
SIDES, CELLS = (1.0, 0.3, 0.2), (10, 4, 3)
YOUNG, POISSON, DENSITY = 2e6, 0.3, 1000.0
SPIN = (0.3, 1.5, 0.2)
PER_STIFFNESS = 2e-3
CORNERS = np.array(list(product((0, 1), repeat=3)))
REFERENCE = 1e-12
SHORT = 1e-9


def element(cell):
    """Stiffness and consistent mass of a hexahedron with these sides, by two Gauss points along each."""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    elasticity = np.diag([2 * shear] * 3 + [shear] * 3)
    elasticity[:3, :3] += lame
    signs, volume = 2 * CORNERS - 1, np.prod(cell) / 8
    stiffness, mass = np.zeros((24, 24)), np.zeros((24, 24))
    for point in signs / np.sqrt(3):
        factors = 1 + signs * point
        values = factors.prod(axis=1) / 8
        slopes = [signs[:, a] * np.delete(factors, a, 1).prod(axis=1) / 4 / cell[a] for a in range(3)]
        strain, moved = np.zeros((6, 24)), np.kron(values, np.eye(3))
        for a, (b, c) in enumerate(((1, 2), (2, 0), (0, 1))):
            strain[a, a::3] = slopes[a]
            strain[3 + a, b::3], strain[3 + a, c::3] = slopes[c], slopes[b]
        stiffness += volume * strain.T @ elasticity @ strain
        mass += volume * DENSITY * moved.T @ moved
    return stiffness, mass


def bar():
    """Places of the nodes, and stiffness and mass over three displacements of each."""
    shape = np.array(CELLS) + 1
    places = np.array(list(np.ndindex(*shape))) / CELLS * SIDES - np.array(SIDES) / 2
    parts = element(np.array(SIDES) / CELLS)
    sums = [np.zeros((3 * len(places),) * 2) for _ in parts]
    for cell in np.ndindex(*CELLS):
        nodes = np.ravel_multi_index((CORNERS + cell).T, shape)
        rows = (3 * nodes[:, None] + np.arange(3)).ravel()
        for whole, part in zip(sums, parts, strict=True):
            whole[np.ix_(rows, rows)] += part
    return places, *sums


def modes(stiffness, mass, count):
    """The first frequencies (rad/s) and shapes of the free bar, without its motions as a rigid body."""
    squares, shapes = scipy.linalg.eigh(stiffness, mass, subset_by_index=(6, 5 + count))
    return np.sqrt(squares), shapes


def model(duration, tolerance):
    frequencies = '{ file = "frequencies.npy" }'
    part = f'[[modes]]\nnodes = "nodes.csv"\nmass = "mass.mtx"\nshapes = "shapes.npy"\nfrequencies = {frequencies}\n'
    damping = 'damping_ratios = { file = "ratios.npy" }\n'
    start = f'[initial]\nangular_velocity = {list(SPIN)}\ndisplacements = "rest"\n'
    return f"{part}{damping}{start}[run]\nduration = {duration}\ntolerance = {tolerance}\nsamples = 2\n"


def write(folder, places, mass, frequencies, shapes):
    table = np.column_stack([np.arange(1, len(places) + 1), places])
    np.savetxt(folder / "nodes.csv", table, fmt=["%d", *["%.17g"] * 3], delimiter=",", header="node,x,y,z", comments="")
    scipy.io.mmwrite(folder / "mass.mtx", scipy.sparse.coo_matrix(mass), symmetry="symmetric")
    arrays = {"shapes": shapes, "frequencies": frequencies, "ratios": PER_STIFFNESS * frequencies / 2}
    for name, array in arrays.items():
        np.save(folder / f"{name}.npy", array)


def simulate(folder, duration, tolerance, repeat, *flags):
    """Seconds of the program, and the spin at the end."""
    (folder / "bar.toml").write_text(model(duration, tolerance))
    command = [PROGRAM, "simulate", folder / "bar.toml", "--system", "full", "--json", *flags]
    seconds = []
    for _ in range(repeat):
        start = time.perf_counter()
        run = subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, "RAYON_NUM_THREADS": "1"})
        seconds.append(time.perf_counter() - start)
    return min(seconds), np.array(json.loads(run.stdout)["omega"])


def exudyn(places, stiffness, mass, count, duration, steps):
    """Set-up and the whole (s), and the spin at the end, by the generalized-α method on the reduced floating frame."""
    import exudyn as exu
    from exudyn.FEM import FEMinterface, ObjectFFRFreducedOrderInterface

    fem = FEMinterface()
    fem.nodes = {"Position": places}
    fem.stiffnessMatrix, fem.massMatrix = map(scipy.sparse.csr_matrix, (stiffness, mass))
    fem.ComputeEigenmodes(count, excludeRigidBodyModes=6, useSparseSolver=False)
    start = time.perf_counter()
    system = exu.SystemContainer().AddSystem()
    body = ObjectFFRFreducedOrderInterface(fem).AddObjectFFRFreducedOrder(
        system,
        positionRef=[0.0] * 3,
        initialVelocity=[0.0] * 3,
        rotationMatrixRef=np.eye(3),
        initialAngularVelocity=list(SPIN),
        gravity=[0.0] * 3,
        stiffnessProportionalDamping=PER_STIFFNESS,
    )
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps, settings.timeIntegration.endTime = steps, duration
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.solution.file.write = False
    ready = time.perf_counter()
    system.SolveDynamic(settings)
    end = time.perf_counter()
    omega = system.GetNodeOutput(body["nRigidBody"], exu.OutputVariableType.AngularVelocityLocal)
    return ready - start, end - start, np.array(omega)


def compare(count, arguments):
    """Rows of the table for one number of modes."""
    places, stiffness, mass = bar()
    frequencies, shapes = modes(stiffness, mass, count)

    def row(program, setting, setup, whole, omega):
        error = np.abs(omega - reference).max()
        print(f"| {count} | {program} | {setting} | {error:.0e} | {setup:.2f} | {whole:.2f} |", flush=True)

    with TemporaryDirectory() as name:
        folder = Path(name)
        write(folder, places, mass, frequencies, shapes)
        _, reference = simulate(folder, arguments.duration, REFERENCE, 1, "--integrator", "explicit")
        setup, _ = simulate(folder, SHORT, 1e-8, arguments.repeat)
        for tolerance in (1e-6, 1e-8, 1e-10):
            whole, omega = simulate(folder, arguments.duration, tolerance, arguments.repeat)
            row("**quasirigid**", f"{tolerance:.0e}", setup, whole, omega)
    for steps in arguments.steps:
        try:
            row("Exudyn", f"{steps} steps", *exudyn(places, stiffness, mass, count, arguments.duration, steps))
        except ModuleNotFoundError:
            print("exudyn is not installed: skipped")
            return


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("modes", type=int, nargs="+", help="numbers of modes, up to 654")
    parser.add_argument("--duration", type=float, default=1.0, help="seconds of motion")
    parser.add_argument("--steps", type=lambda text: [int(part) for part in text.split(",")], default=[50, 200])
    parser.add_argument("--repeat", type=int, default=3, help="runs of quasirigid, of which the shortest counts")
    arguments = parser.parse_args()
    print("| modes | program | tolerance or steps | error in ω (rad/s) | set-up (s) | whole (s) |\n" + "|---" * 6 + "|")
    for count in arguments.modes:
        compare(count, arguments)


if __name__ == "__main__":
    main()
