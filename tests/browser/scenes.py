"""Scenes for the tests: from records of real runs, with bodies drawn by hand, and one of ten thousand vertices."""

import base64
import csv
import json
import math
import os
import struct
import subprocess
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FRAMES = 2000


def program():
    """The program: $QUASIRIGID, or the newest build of this checkout."""
    named = os.environ.get("QUASIRIGID")
    builds = [Path(named)] if named else [ROOT / "target" / path for path in ("release/quasirigid", "profiling/release/quasirigid", "debug/quasirigid")]
    builds = [path for path in builds if path.exists()]
    return max(builds, key=lambda path: path.stat().st_mtime, default=None)


def model(name):
    return ROOT / "examples" / name / "model.toml"


@cache
def record(name, folder):
    """Record of a run of an example: a dictionary of its JSON tables and histories."""
    out = Path(folder) / name
    command = [program(), "run", model(name), "-o", out, "--overwrite", "-q"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode in (0, 1), finished.stderr  # 1: done, but the reduced equations do not hold
    tables = {path.stem: json.loads(path.read_text()) for path in out.glob("*.json")}
    for path in out.glob("history-*.csv"):
        with path.open() as file:
            rows = csv.reader(file)
            header = next(rows)
            tables[path.stem] = dict(zip(header, zip(*(map(float, row) for row in rows))))
    return tables


def packed(kind, values):
    values = list(values)
    return base64.b64encode(struct.pack(f"<{len(values)}{kind}", *values)).decode()


def f32(values):
    return packed("f", values)


def f64(values):
    return packed("d", values)


def u32(values):
    return packed("I", values)


def flat(rows):
    return [x for row in rows for x in row]


# How a coefficient changes with all stiffnesses times s and all dampings times d, at order 3: degree -> exponents.
EXPONENTS = {
    "spin_of_momentum": {1: (0, 0), 3: (-1, 0), 4: (-2, 1)},
    "momentum": {1: (0, 0), 3: (-1, 0), 4: (-2, 1)},
    "energy": {2: (0, 0), 4: (-1, 0), 5: (-2, 1)},
    "power": {6: (-2, 1)},
    "displacements": {2: (-1, 0), 3: (-2, 1)},
}


def terms(name, entries):
    """Terms of a polynomial from its list of exponents and values."""
    found = {}
    for entry in entries:
        if any(entry["value"]):
            found.setdefault(sum(entry["exponents"]), {})[tuple(entry["exponents"])] = entry["value"]
    result = []
    for degree, values in sorted(found.items()):
        order = [(i, j, degree - i - j) for i in range(degree, -1, -1) for j in range(degree - i, -1, -1)]
        rows = len(entries[0]["value"])
        stiffness, damping = EXPONENTS[name][degree]
        columns = [values.get(exponents, [0.0] * rows) for exponents in order]
        result.append(
            {"degree": degree, "stiffness": stiffness, "damping": damping, "values": [list(row) for row in zip(*columns)]}
        )
    return result


def value(polynomial, x):
    """Value of a list of terms."""
    rows = [0.0] * len(polynomial[0]["values"])
    for term in polynomial:
        degree = term["degree"]
        monomials = [
            x[0] ** i * x[1] ** j * x[2] ** (degree - i - j)
            for i in range(degree, -1, -1)
            for j in range(degree - i, -1, -1)
        ]
        for r, row in enumerate(term["values"]):
            rows[r] += sum(a * m for a, m in zip(row, monomials))
    return rows


def momentum_of(polynomial, omega, momentum):
    """Angular momentum with a given spin: a fixed point, for the spin is almost linear in it."""
    for _ in range(200):
        error = [w - s for w, s in zip(omega, value(polynomial, momentum))]
        linear = polynomial[0]["values"]
        change = solved(linear, error)
        momentum = [k + c for k, c in zip(momentum, change)]
    return momentum


def solved(matrix, right):
    """Solution of three linear equations, by Cramer's rule."""
    columns = list(zip(*matrix))
    whole = determinant(columns)
    return [determinant([right if i == j else columns[j] for j in range(3)]) / whole for i in range(3)]


def determinant(c):
    (a, b, c_), (d, e, f), (g, h, i) = c
    return a * (e * i - f * h) - b * (d * i - f * g) + c_ * (d * h - e * g)


def equations(tables):
    reduced, history = tables["reduced"], tables["history-reduced"]
    polynomials = {name: terms(name, reduced[name]) for name in EXPONENTS}
    polynomials["momentum"].insert(0, {"degree": 1, "stiffness": 0, "damping": 0, "values": reduced["inertia"]})
    omega = [history[w][0] for w in ("wx", "wy", "wz")]
    rigid = [sum(a * w for a, w in zip(row, omega)) for row in reduced["inertia"]]
    slowest = min(reduced["frequencies"])
    return polynomials | {
        "order": 3,
        "scalable": True,
        "note": "",
        "limits": [0.15 * slowest, 0.5 * slowest],
        "start": {
            "K": momentum_of(polynomials["spin_of_momentum"], omega, rigid),
            "attitude": [history[q][0] for q in ("qw", "qx", "qy", "qz")],
            "duration": history["t"][-1],
        },
    }


def track(tables, system):
    """Main history of a record, thinned."""
    history = tables[f"history-{system}"]
    inertia = tables["record"]["body"]["inertia"]
    count = len(history["t"])
    chosen = [round(i * (count - 1) / (FRAMES - 1)) for i in range(FRAMES)] if count > FRAMES else range(count)
    rows = lambda names: [[history[name][i] for name in names] for i in chosen]
    omega = rows(["wx", "wy", "wz"])
    frozen = [[sum(a * w for a, w in zip(row, w_)) for row in inertia] for w_ in omega]
    sizes = rows(["momentum"])
    momentum = [[k * s[0] / math.hypot(*K) for k in K] for K, s in zip(frozen, sizes)]
    displacements = terms("displacements", tables["reduced"]["displacements"])
    t = [history["t"][i] for i in chosen]
    turns = [0.0]
    for i in range(1, len(t)):
        turns.append(turns[-1] + math.hypot(*omega[i]) * (t[i] - t[i - 1]) / (2 * math.pi))
    return {
        "system": system,
        "t": f64(t),
        "attitude": f32(flat(rows(["qw", "qx", "qy", "qz"]))),
        "omega": f32(flat(omega)),
        "momentum": f32(flat(momentum)),
        "q": f32(flat(value(displacements, w) for w in omega)),
        "rotors": None,
        "rotor_names": [],
        "dissipated": f64(x[0] for x in rows(["dissipated"])),
        "energy": f64(x[0] for x in rows(["energy"])),
        "revolutions": f64(turns),
    }


BOX_FACES = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]


def box(name, half, centre=(0, 0, 0), kind="carrier", fields=()):
    corners = [[c + s * h for c, s, h in zip(centre, (x, y, z), half)] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    fields = [{"coordinate": j, "vectors": f32(flat([list(v)] * 8))} for j, v in fields]
    return {"name": name, "kind": kind, "vertices": f32(flat(corners)), "triangles": u32(flat(BOX_FACES)), "lines": None, "size": None, "fields": fields, "curvatures": [], "turning": None}


def point(name, place, radius, fields):
    fields = [{"coordinate": j, "vectors": f32(v)} for j, v in fields]
    return {"name": name, "kind": "point", "vertices": f32(place), "triangles": None, "lines": None, "size": radius, "fields": fields, "curvatures": [], "turning": None}


def spring(name, ends, radius, fields):
    """A spring from its first end, which stays, to its second."""
    fields = [{"coordinate": j, "vectors": f32([0, 0, 0, *v])} for j, v in fields]
    return {"name": name, "kind": "spring", "vertices": f32(flat(ends)), "triangles": None, "lines": u32([0, 1]), "size": radius, "fields": fields, "curvatures": [], "turning": None}


def axes(tables):
    body = tables["record"]["body"]
    return {"moments": body["principal_moments"], "axes": body["principal_axes"]}


def nutation_damper(folder):
    tables = record("nutation-damper", folder)
    along = [(0, [0, 0, 1])]
    return {
        "version": 1,
        "name": "nutation damper",
        "radius": 0.62,
        "coordinates": [{"name": '"damper" along its line', "unit": "m"}],
        "pieces": [
            box("carrier", (0.42, 0.36, 0.22)),
            point("damper", [0.4, 0, 0.2], 0.045, along),
            spring("damper - carrier", [[0.4, 0, -0.2], [0.4, 0, 0.2]], 0.012, along),
        ],
        "principal": axes(tables),
        "track": track(tables, "full"),
        "modes": [
            {"name": "nutation", "frequency": 2.8114, "rate": -0.04425, "rotation": [[0.02, 0], [0, 0.024], [0, 0]], "q": [[0.01, 0.02]]},
            {"name": '"damper" along its line', "frequency": 2.7799, "rate": -0.2374, "rotation": [[0.004, 0], [0, 0.005], [0, 0]], "q": [[0.08, 0]]},
        ],
        "spin": [-0.008465229732987252, 0.0, 6.283179491459589],
        "equations": equations(tables),
    }


def boom_satellite(folder):
    tables = record("boom-satellite", folder)
    pole = tables["record"]["body"]["pole"]
    about = lambda place: [x - p for x, p in zip(place, pole)]
    tips = [("tip 1", about([0.4, 1.0, 0.5]), 0), ("tip 2", about([-0.4, 1.0, -0.5]), 3)]
    unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    fields = lambda first: [(first + i, unit[i]) for i in range(3)]
    pieces = [box("carrier", (0.33, 0.3, 0.22), about([0, 0, 0]))]
    for name, place, first in tips:
        root = about([math.copysign(0.3, place[0]), 0.3, math.copysign(0.2, place[2])])
        pieces += [point(name, place, 0.07, fields(first)), spring(f"{name} - carrier", [root, place], 0.02, fields(first))]
    return {
        "version": 1,
        "name": "boom satellite",
        "radius": 1.25,
        "coordinates": [{"name": name, "unit": "m"} for name in tables["reduced"]["coordinates"]],
        "pieces": pieces,
        "principal": axes(tables),
        "track": track(tables, "reduced"),
        "modes": [],
        "spin": None,
        "equations": equations(tables),
    }


def large(folder, rows=100, columns=100, modes=6):
    """A membrane of ten thousand vertices with six modes and two thousand frames, moving as the nutation damper does."""
    scene = nutation_damper(folder)
    grid = [(2 * i / (rows - 1) - 1, 2 * j / (columns - 1) - 1) for i in range(rows) for j in range(columns)]
    bump = lambda x, y: 0.12 * (1 - x * x) * (1 - y * y)
    corner = lambda i, j: i * columns + j
    faces = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)
            faces += [a, b, c, b, d, c]
    shape = lambda m, x, y: math.sin((m % 3 + 1) * math.pi * (x + 1) / 2) * math.sin((m // 3 + 1) * math.pi * (y + 1) / 2)
    fields = [{"coordinate": m, "vectors": f32(flat([0, 0, shape(m, x, y)] for x, y in grid))} for m in range(modes)]
    scene["coordinates"] = [{"name": f"mode {m + 1}", "unit": "m"} for m in range(modes)]
    scene["pieces"] = [
        {"name": "membrane", "kind": "panel", "vertices": f32(flat([x, y, bump(x, y)] for x, y in grid)), "triangles": u32(faces), "lines": None, "size": None, "fields": fields, "curvatures": [], "turning": None}
    ]
    scene["radius"] = 1.42
    scene["modes"] = []
    amplitudes = [[0.02 / (m + 1) * math.sin(0.05 * (m + 1) * i) for m in range(modes)] for i in range(FRAMES)]
    scene["track"]["q"] = f32(flat(amplitudes))
    scene["equations"]["displacements"] = None
    return scene
