#!/usr/bin/env python3
"""Checks a certificate of quasirigid with NumPy and mpmath, in 50 digits; it shares no code with the program.

    python3 tools/check_certificate.py FILE.json

Exit codes: 0 holds, 1 does NOT hold, 2 cannot read. Equations by their labels: docs/theory/15-modes.md.
"""

import hashlib
import json
import sys
import tomllib

import numpy as np
from mpmath import gamma, mp, mpc, mpf

mp.dps = 50
KNOWN = {"kind": "quasirigid-certificate", "version": 1, "units": "SI"}
TOLERANCES = {"modes": {"eigenvalue": 1e-9, "decay": 1e-6, "light_decay": 2e-5, "shape": 1e-8, "steady": 1e-9},
              "simulate": {"row": 1e-9, "flow": 1e-9, "taken": 1e-5}}
UNITS = {"N/m": 1, "kN/m": 1000, "N s/m": 1, "kg": 1, "g": mpf("0.001"), "m": 1, "cm": mpf("0.01"), "mm": mpf("0.001"),
         "kg m^2": 1, "N m s/rad": 1, "N m s": 1}
exact = np.vectorize(mpf, otypes=[object])


class Judge:
    """Places where a certificate does not hold, and what was checked."""

    def __init__(self):
        self.wrong, self.told = [], []

    def __call__(self, true, where, what):
        if not true:  # what is not a number is never true
            self.wrong.append(f"{where}: {what}")

    def close(self, stated, own, size, tolerance, where):
        """Whether numbers differ by no more than a share of a size."""
        gap = max((abs(a - b) for a, b in zip(np.ravel(stated), np.ravel(own), strict=True)), default=0)
        self(gap <= tolerance * size, where, f"differs by {float(gap / size) if size else float(gap):.2g} of its size")


def size_of(*arrays):
    return max((abs(x) for array in arrays for x in np.ravel(array)), default=mpf(0))


def whole(entries, n, value=mpf):
    """Matrix of listed entries."""
    matrix = exact(np.zeros((n, n)))
    for row, column, *numbers in entries:
        matrix[row, column] += value(*numbers)
    return matrix


def cross(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]], dtype=object)


def least_eigenvalue(matrix):
    """Least eigenvalue of a symmetric matrix with rows and columns scaled to a diagonal of one."""
    unit = np.array([1 / mp.sqrt(abs(d)) if d else mpf(1) for d in np.diag(matrix)], dtype=object)
    scaled = (matrix * unit[:, None] * unit).astype(float)
    return np.linalg.eigvalsh(scaled).min() if scaled.size else 1.0


def modulus(law, s):
    """Complex modulus of a material over its elastic one, at a complex frequency (1/s). (G1)"""
    kind = law["kind"]
    relaxed = lambda: s * mpf(law["time"]) / (1 + s * mpf(law["time"]))
    if kind in ("quality-factor", "table"):
        if s.imag == 0:
            return mpf(1)
        if kind == "quality-factor":
            return mpc(1, mp.sign(s.imag) / mpf(law["Q"]))
        rows, nu = exact(np.array(law["rows"])), abs(s.imag)
        above = sum(row[0] <= nu for row in rows)
        low, high = rows[max(above - 1, 0)], rows[min(above, len(rows) - 1)]
        share = max(mp.log(nu / low[0]) / mp.log(high[0] / low[0]), 0) if low[0] < high[0] else mpf(0)
        value, loss = (low[i] * (high[i] / low[i]) ** share for i in (1, 2))
        return mpc(value, mp.sign(s.imag) * value * loss)
    if kind == "andrade":
        alpha = mpf(law["exponent"])
        creep = gamma(1 + alpha) * (s * mpf(law["creep_time"])) ** -alpha
        return 1 / (1 + creep + 1 / (s * mpf(law["time"])))
    return {"elastic": lambda: mpf(1), "kelvin-voigt": lambda: 1 + s * mpf(law["time"]), "maxwell": relaxed,
            "standard-linear": lambda: 1 + mpf(law["strength"]) * relaxed()}[kind]()


class Spin:
    """Equations of small motions about a stated spin, (M2) and (M3), with their symmetries made exact."""

    def __init__(self, spin, where, judge):
        self.spin, self.where, self.judge = spin, where, judge
        self.n = n = len(spin["unknowns"])
        self.omega, self.K = exact(spin["omega"]), exact(spin["angular_momentum"])
        self.h, self.slopes = (exact(np.array(spin[key]).reshape(n, 3)).T for key in ("h", "slopes"))
        self.J = self.alike(exact(np.array(spin["inertia"])), "inertia", 1)
        part = {"mass": 1, "damping": 1, "gyroscopic": -1, "stiffness": 1, "centrifugal": 1}
        self.A, self.B, self.G, self.C, self.N = (self.alike(whole(spin[k], n), k, s) for k, s in part.items())
        self.materials = [(m["law"], self.alike(whole(m["stiffness"], n), "materials", 1)) for m in spin["materials"]]
        self.moving = [j for j in range(n) if self.A[j, j] != 0]  # the others are angles of liquids
        restored = lambda j: self.C[j].any() or self.N[j].any() or self.slopes[:, j].any()
        self.loose = [j for j in range(n) if not restored(j)]  # rotors, liquids
        # K along the spin: to the last digit, so that rounding is no decay
        self.ratio = (self.K @ self.omega) / (self.omega @ self.omega)

    def alike(self, matrix, key, sign):
        """The symmetric, or antisymmetric, part of a matrix that mechanics gives that symmetry."""
        kind = "symmetric" if sign > 0 else "antisymmetric"
        self.judge(size_of(matrix - sign * matrix.T) <= mpf("1e-12") * size_of(matrix), f"{self.where}.{key}", f"is not {kind}")
        return (matrix + sign * matrix.T) / 2

    def mechanics(self):
        """Positive masses, and dashpots that only take energy."""
        mass = np.block([[self.J, self.h[:, self.moving]], [self.h[:, self.moving].T, self.A[np.ix_(self.moving, self.moving)]]])
        self.judge(least_eigenvalue(mass) > 0, f"{self.where}.mass", "the mass matrix with the inertia tensor is not positive")
        self.judge(least_eigenvalue(self.B) >= -1e-12, f"{self.where}.damping", "a motion gains energy by damping")
        for law, stiffness in self.materials:
            self.judge(least_eigenvalue(stiffness) >= -1e-12, f"{self.where}.materials", "a stiffness of a material is negative")

    def steady(self, tolerance):
        """Steady spin and the balance of the coordinates, (M1)."""
        spin, judge, where, omega = self.spin, self.judge, self.where, self.omega
        q, wheels = exact(spin["displacements"]), exact(spin["wheels"])
        momentum = size_of(self.K)
        judge(not any(q[j] for j in self.loose), f"{where}.displacements", "a coordinate without displacement has one")
        judge.close(self.J @ omega + wheels, self.K, momentum, tolerance, f"{where}.angular_momentum")
        judge.close(self.ratio * omega, self.K, momentum, tolerance, f"{where}: the angular momentum is not along the spin, which")
        held, load = self.C @ q, omega @ self.slopes / 2
        size = size_of(abs(self.C) @ abs(q), abs(omega) @ abs(self.slopes))
        judge.close(held, load, size or mpf(1), tolerance, f"{where}.displacements: the balance of a coordinate")
        energy = (omega @ self.J @ omega + q @ held) / 2
        judge.close(mpf(spin["energy"]), energy, abs(energy), tolerance, f"{where}.energy")

    def at(self, s, frozen):
        """P and its derivative at a complex frequency; materials and liquids as they are at the stated eigenvalue."""
        turn = s * np.eye(3, dtype=int) + cross(self.omega)
        top = np.hstack([turn @ self.J - self.ratio * cross(self.omega), turn @ (s * self.h + self.slopes)])
        below = np.hstack([(s * self.h - self.slopes).T, s * s * self.A + s * (self.B + self.G) + self.C - self.N + frozen])
        slope = np.hstack([self.J, s * self.h + self.slopes + turn @ self.h])
        slope = np.vstack([slope, np.hstack([self.h.T, 2 * s * self.A + self.B + self.G])])
        return np.vstack([top, below]), slope

    def units(self, s, frozen):
        """Scale of each unknown: rows and columns of P times it are of size one."""
        rate = abs(s) + mp.sqrt(self.omega @ self.omega)
        body = [rate * self.J[i, i] for i in range(3)]
        terms = (abs(s) ** 2 * self.A, abs(s) * self.B, self.C, self.N, frozen)
        sizes = body + [sum(abs(term[j, j]) for term in terms) for j in range(self.n)]
        return np.array([1 / mp.sqrt(size) if size else mpf(1) for size in sizes], dtype=object)

    def frozen(self, mode, s):
        """Materials and liquids at a complex frequency."""
        extra = whole(mode["liquids"], self.n, mpc) if mode["liquids"] else exact(np.zeros((self.n, self.n)))
        for law, stiffness in self.materials:
            extra = extra + (modulus(law, s) - 1) * stiffness
        return extra

    def solved(self, s, x, frozen):
        """Eigenvalue and vector next to stated ones: Newton's method with steps in double and residuals in 50 digits."""
        scale = self.units(s, frozen)
        y = x / scale
        y = y / mp.sqrt(sum(abs(v) ** 2 for v in y))
        for _ in range(60):
            P, slope = (m * scale[:, None] * scale for m in self.at(s, frozen))
            border = abs(s) * (slope @ y)
            system = np.block([[P, border[:, None]], [np.conj(y)[None, :], np.zeros((1, 1), dtype=object)]]).astype(complex)
            residual = P @ y
            unit = size_of(residual)
            if unit == 0:
                return s, y * scale
            step = np.linalg.lstsq(system, np.append(-residual / unit, 0).astype(complex), rcond=1e-15)[0]
            step = np.array([mpc(v) for v in step]) * unit
            y, s = y + step[:-1], s + abs(s) * step[-1]
            if size_of(step) < mpf("1e-32"):
                return s, y * scale
        return None

    def mode(self, mode, where, tolerance):
        """A mode solves the equations of its spin; the eigenvalue, in 50 digits."""
        judge = self.judge
        stated = mpc(-mpf(mode["decay_rate"]), mode["frequency"])
        time = mode["time_constant"]
        if mode["decay_rate"] == 0:
            judge(time is None, f"{where}.time_constant", "is given for a motion that neither decays nor grows")
        else:
            judge(time is not None and abs(mpf(time) * mpf(mode["decay_rate"]) - 1) < 1e-14, f"{where}.time_constant", "is not 1/decay_rate")
        if mode["neutral"]:
            judge(stated == 0, where, "a neutral motion has no rate")
            return None
        x = np.array([mpc(*pair) for pair in mode["omega"] + mode["shape"]], dtype=object)
        found = self.solved(stated, x, self.frozen(mode, stated)) if stated != 0 and size_of(x) > 0 else None
        judge(found is not None, where, "no eigenvalue next to the stated one")
        if found is None:
            return None
        own, y = found
        share = tolerance["light_decay" if self.materials else "decay"]
        decay = max(share * abs(own.real), 1e-11 * abs(own) if mode["decay_rate"] == 0 else 0)
        judge(abs(own - stated) <= tolerance["eigenvalue"] * abs(own), where, f"the eigenvalue is {mp.nstr(own, 12)}, not {mp.nstr(stated, 12)}")
        judge(abs(own.real - stated.real) <= decay, f"{where}.decay_rate", f"is {mp.nstr(-own.real, 12)}")
        told = list(range(3)) + [3 + j for j in self.moving]
        judge(not any(abs(v) for i, v in enumerate(x) if i not in told), f"{where}.shape", "an angle of a liquid is stated, and none is known")
        weight = 1 / self.units(own, 0 * self.A)
        a, b = (np.array([complex(v[i] * weight[i]) for i in told]) for v in (x, y))
        judge(np.linalg.norm(a - b * (np.vdot(b, a) / np.vdot(b, b))) <= tolerance["shape"] * np.linalg.norm(a), f"{where}.shape", "is not that of the eigenvalue")
        return own

    def complete(self, found, where):
        """No mode is missing: det P is the product of its stated zeros, and those that are neutral are zero."""
        roots = [r for own in found for r in ((own, mp.conj(own)) if own.imag else (own,))]
        zeros = 3 + 2 * self.n - len(roots)  # one of the spin, one of each angle that nothing restores, two of each neutral motion
        self.judge(zeros > len(self.loose), where, "there are more modes than the equations have")
        mass = np.block([[self.J, self.h], [self.h.T, self.A]])
        unit = np.array([1 / mp.sqrt(d) if d else mpf(1) for d in np.diag(mass)], dtype=object)
        rates = sorted(abs(r) for r in roots)
        for size in [mp.sqrt(self.omega @ self.omega), *rates[:: max(len(rates) // 2, 1)]]:
            z = size * mpc("0.83", "0.71")
            product = self.logdet(mass, unit) + zeros * mp.log(z) + sum(mp.log(z - r) for r in roots)
            ratio = mp.exp(self.logdet(self.at(z, 0 * self.A)[0], self.units(z, 0 * self.A)) - product)
            self.judge(abs(ratio - 1) < 1e-6, where, "a mode is missing, or there twice: the determinant is not the product of its zeros")

    @staticmethod
    def logdet(matrix, unit):
        sign, value = np.linalg.slogdet((matrix * unit[:, None] * unit).astype(complex))
        return mp.log(mpc(complex(sign))) + mpf(float(value)) - 2 * sum(mp.log(u) for u in unit)


def number(value):
    """A number of the model file in SI units; LookupError of a unit that is not known here."""
    if isinstance(value, str):
        figure, _, unit = value.strip().partition(" ")
        if unit not in UNITS:
            raise LookupError(f"the unit {unit!r}")
        return mpf(figure) * UNITS[unit]
    return mpf(value)


def tensor(value):
    """One number, three, or a matrix, as a 3 x 3 matrix."""
    value = np.array([number(v) for v in np.ravel(np.array(value, dtype=object))], dtype=object)
    return value.reshape(3, 3) if value.size == 9 else np.diag(value if value.size == 3 else [value[0]] * 3)


def points(model):
    """Masses, positions and directions of motion of a body of points on springs, with C and B; LookupError of any other."""
    strange = set(model) - {"body", "carrier", "point", "spring", "rotor", "initial", "run"}
    strange |= {key for s in model.get("spring", []) for key in set(s) - {"name", "from", "to", "stiffness", "damping"}}
    strange |= {key for p in model.get("point", []) if isinstance(p.get("motion"), dict) for key in set(p["motion"]) - {"line"}}
    if strange or "carrier" not in model:
        raise LookupError(", ".join(sorted(strange)) or "a body without a carrier")
    masses, places, moves, names = [], [], [], {}
    for p in model.get("point", []):
        line = p["motion"]["line"] if isinstance(p.get("motion"), dict) else None
        ways = np.eye(3, dtype=int) if line is None else exact([line]) / mp.sqrt(sum(mpf(v) ** 2 for v in line))
        names[p.get("name", f"point {len(masses) + 1}")] = len(masses)
        moves += [(len(masses), way) for way in exact(ways)]
        masses.append(number(p["mass"]))
        places.append([number(v) for v in p["position"]])
    n, rotors = len(moves), model.get("rotor", [])
    C, B = (exact(np.zeros((n + len(rotors),) * 2)) for _ in range(2))
    for spring in model.get("spring", []):
        sign = {names.get(spring["from"], "carrier"): 1, names.get(spring["to"], "carrier"): -1}
        for matrix, key in ((C, "stiffness"), (B, "damping")):
            k = tensor(spring.get(key, 0))
            for j, (a, d) in enumerate(moves):
                for l, (b, e) in enumerate(moves):
                    matrix[j, l] += sign.get(a, 0) * sign.get(b, 0) * (d @ k @ e)
    for j, rotor in enumerate(rotors, n):
        B[j, j] = number(rotor.get("friction", 0))
    return masses, exact(np.array(places).reshape(-1, 3)), moves, C, B, rotors


def rebuilt(spin, model):
    """Matrices about a stated spin of points on springs, from the positions of the points alone."""
    masses, places, moves, C, B, rotors = points(model)
    carrier = model["carrier"]
    q, omega = exact(spin["displacements"]), exact(spin["omega"])
    m = np.array([number(carrier["mass"]), *masses], dtype=object)
    r = np.vstack([np.array([[number(v) for v in carrier["center_of_mass"]]], dtype=object), places])
    for (a, d), x in zip(moves, q):
        r[a + 1] = r[a + 1] + x * d
    r = r - (m @ r) / sum(m)
    n, k = len(moves), len(rotors)
    outer = lambda a, b: (a @ b) * np.eye(3, dtype=int) - np.outer(b, a)
    own = {"inertia": tensor(carrier["inertia"]) + sum(mi * outer(ri, ri) for mi, ri in zip(m, r)), "stiffness": C, "damping": B}
    own["h"], own["slopes"] = (exact(np.zeros((n + k, 3))) for _ in range(2))
    own["mass"], own["gyroscopic"], own["centrifugal"] = (exact(np.zeros((n + k, n + k))) for _ in range(3))
    for j, (a, d) in enumerate(moves):
        mass = m[a + 1]
        own["h"][j] = mass * (cross(r[a + 1]) @ d)
        own["slopes"][j] = mass * ((outer(r[a + 1], d) + outer(d, r[a + 1])) @ omega)
        for l, (b, e) in enumerate(moves):
            share = mass * ((a == b) - m[b + 1] / sum(m))  # a free body recoils
            own["mass"][j, l] = share * (d @ e)
            own["gyroscopic"][j, l] = 2 * share * (omega @ (cross(e) @ d))
            own["centrifugal"][j, l] = share * ((omega @ omega) * (d @ e) - (omega @ d) * (omega @ e))
    for j, rotor in enumerate(rotors, n):
        axis = exact(rotor["axis"])
        own["mass"][j, j] = number(rotor["inertia"])
        own["h"][j] = own["mass"][j, j] * axis / mp.sqrt(axis @ axis)
    return own


def check_modes(document, judge):
    tolerance, model = document["tolerances"], tomllib.loads(document["model"]["text"])
    for spin in document["spins"]:
        about = f"spin about {spin['about']}"
        equations = Spin(spin, about, judge)
        equations.mechanics()
        equations.steady(mpf(tolerance["steady"]))
        modes = [(mode, f"{about}, mode {mode['name']}") for mode in spin["modes"]]
        found = [own for own in (equations.mode(mode, where, tolerance) for mode, where in modes) if own is not None]
        judge(spin["complete"] == (not spin["materials"] and not any(mode["liquids"] for mode in spin["modes"])), f"{about}.complete", "is wrong")
        if spin["complete"] and not judge.wrong:
            equations.complete(found, f"{about}.modes")
        judge(spin["stable"] == all(mode["decay_rate"] >= 0 for mode in spin["modes"]), f"{about}.stable", "is not what the modes say")
        try:
            for key, own in rebuilt(spin, model).items():
                vectors = key in ("inertia", "h", "slopes")
                stated = exact(np.array(spin[key])) if vectors else whole(spin[key], len(spin["unknowns"]))
                size = size_of(own) or (size_of(equations.J) * size_of(equations.omega) if key == "slopes" else mpf(1))
                judge.close(stated, own, size, 1e-10, f"{about}.{key} of the model file")
            judge.told.append(f"{about}: the matrices are those of the model file, rebuilt")
        except LookupError as other:
            judge.told.append(f"{about}: the matrices are taken as stated, since this checker does not rebuild {other}")
        judge.told.append(f"{about}: {len(found)} modes solve the equations" + (", and there is no other" if spin["complete"] else ""))


class Energy:
    """Energy form of the reduced equations, (R16) and (R17), with the attitude (P3), in double."""

    def __init__(self, stated):
        terms = [stated["E"], *stated["c"], *stated["T"]]
        self.exponents = np.array(sorted({tuple(e) for row in terms for e, _ in row} | {(0, 0, 0)}))
        place = {tuple(e): i for i, e in enumerate(self.exponents)}
        self.table = np.zeros((13, len(place)))
        for row, own in enumerate(terms):
            for e, value in own:
                self.table[row, place[tuple(e)]] += value
        for axis in range(3):  # the gradient of E
            for e, value in stated["E"]:
                if e[axis]:
                    lower = tuple(v - (i == axis) for i, v in enumerate(e))
                    if lower not in place:
                        place[lower] = len(place)
                        self.exponents = np.vstack([self.exponents, lower])
                        self.table = np.hstack([self.table, np.zeros((13, 1))])
                    self.table[10 + axis, place[lower]] += value * e[axis]

    def values(self, K):
        powers = np.power.outer(K, np.arange(self.exponents.max() + 1))
        x, y, z = self.exponents.T
        return self.table @ (powers[0][x] * powers[1][y] * powers[2][z])

    def motion(self, K):
        """Angular velocity, rate of the angular momentum, power and energy."""
        energy, *rest = self.values(K)
        c, (xx, yy, zz, yz, zx, xy), gradient = np.array(rest[:3]), rest[3:9], np.array(rest[9:])
        T = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])
        # omega = grad E - rate x c + T rate and rate = K x omega, solved as they stand
        turn, twist = (np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]) for x, y, z in (K, c))
        rate = np.linalg.solve(np.eye(3) - turn @ (twist + T), turn @ gradient)
        return gradient + (twist + T) @ rate, rate, rate @ T @ rate, energy

    def rate(self, y):
        """Rates of angular momentum, attitude (scalar first) and energy taken."""
        omega, moved, power, _ = self.motion(y[:3])
        w, v = y[3], y[4:7]
        (a, b, c), (x, y, z) = v, omega
        turned = (w * x + b * z - c * y, w * y + c * x - a * z, w * z + a * y - b * x)
        return np.array([*moved, -v @ omega / 2, *(r / 2 for r in turned), power])

    def momentum(self, omega):
        """Angular momentum of an angular velocity, by Newton's method."""
        step, K = np.linalg.inv(np.array([self.quadratic(axis) for axis in np.eye(3)])), np.zeros(3)
        K = step @ (omega - self.motion(K)[0])
        for _ in range(50):
            gap = omega - self.motion(K)[0]
            K = K + step @ gap
            if np.linalg.norm(gap) <= 1e-15 * np.linalg.norm(omega):
                break
        return K

    def quadratic(self, axis):
        """Second derivatives of the part of E of degree 2 along an axis."""
        at = lambda K: sum(v * np.prod(K ** e) for e, v in zip(self.exponents, self.table[0]) if sum(e) == 2)
        return np.array([at(axis + other) - at(axis) - at(other) if (axis != other).any() else 2 * at(axis) for other in np.eye(3)])

    def across(self, y, span):
        """The state after a time: extrapolated midpoint rule (Gragg, Bulirsch and Stoer) in steps whose error is rounding."""
        done, h = 0.0, min(span, 0.7 / np.linalg.norm(self.motion(y[:3])[0]))
        while done < span:
            h = min(h, span - done)
            columns = []
            for k in range(1, 9):
                n, a, b = 2 * k, y, y + h / (2 * k) * self.rate(y)
                for _ in range(n - 1):
                    a, b = b, a + 2 * h / n * self.rate(b)
                row = [(a + b + h / n * self.rate(b)) / 2]
                for j, old in enumerate(columns):
                    row.append(row[j] + (row[j] - old) / ((k / (k - j - 1)) ** 2 - 1))
                columns = row
            unit = np.concatenate([np.full(3, np.linalg.norm(y[:3])), np.ones(4), [np.inf]])
            if np.max(np.abs(columns[-1] - columns[-2]) / unit) > 1e-13 and h > 1e-3 * span:
                h /= 2
                continue
            done, y = done + h, columns[-1]
        return y


def rebuilt_energy(model, judge, own, order):
    """Leading terms of E, T and c of points on springs, from their displacements in balance with the rotation, (R4) at degree 2."""
    if model.get("rotor") or order < 3:
        raise LookupError("rotors" if model.get("rotor") else f"order {order}")
    n = sum(3 if not isinstance(p.get("motion"), dict) else 1 for p in model.get("point", []))
    at = lambda w: rebuilt({"displacements": [0.0] * n, "omega": list(w)}, model)
    frozen = at([0.0] * 3)
    as_float = lambda a: a.astype(float)
    inverse, softness = np.linalg.inv(as_float(frozen["inertia"])), np.linalg.inv(as_float(frozen["stiffness"]))
    h, size = as_float(frozen["h"]), np.sqrt(2 / np.trace(inverse))

    def part(row, K, degree):
        """The part of one degree at a place."""
        return sum(v * np.prod(K ** e) for e, v in zip(own.exponents, own.table[row]) if sum(e) == degree)

    for K in size * np.random.default_rng(1).standard_normal((4, 3)):
        pulled = lambda k: as_float(at(inverse @ k)["slopes"]) @ (inverse @ k) / 2  # by the centrifugal load
        moved = lambda k: softness @ (pulled(k) - h @ inverse @ np.cross(k, inverse @ k))  # and by that of the angular acceleration
        q = moved(K)
        N = np.array([(moved(K + size * d) - moved(K - size * d)) / (2 * size) for d in np.eye(3)]).T  # exact, since q is quadratic
        p = h @ inverse
        T = N.T @ as_float(frozen["damping"]) @ N
        expected = {"E of degree 2": ([0], 2, [K @ inverse @ K / 2]), "E of degree 4": ([0], 4, [q @ as_float(frozen["stiffness"]) @ q / 2 - q @ pulled(K)]),
                    "c of degree 1": ([1, 2, 3], 1, sum(np.cross(a, b) for a, b in zip(p, N))),
                    "T of degree 2": (range(4, 10), 2, [T[0, 0], T[1, 1], T[2, 2], T[1, 2], T[0, 2], T[0, 1]])}
        for name, (rows, degree, value) in expected.items():
            stated = [part(row, K, degree) for row in rows]
            judge.close(stated, value, np.max(np.abs(value)) or 1, 1e-8, f"{name} of the model file")


def check_simulate(document, judge, most=3000):
    tolerance, stated = document["tolerances"], document["history"]
    own, rows = Energy(stated), np.array(stated["rows"], dtype=float)
    t, omega, attitude, energy, momentum, taken = rows[:, 0], rows[:, 1:4], rows[:, 4:8], *rows[:, 8:11].T
    judge(stated["columns"] == ["t", "wx", "wy", "wz", "qw", "qx", "qy", "qz", "energy", "momentum", "dissipated"], "columns", "are others")
    judge(np.all(np.diff(t) > 0), "rows", "the times do not ascend")
    K = np.array([own.momentum(w) for w in omega])
    for i, (k, e, size) in enumerate(zip(K, energy, momentum)):
        where = f"row {i}"
        found, _, power, own_energy = own.motion(k)
        judge(np.linalg.norm(found - omega[i]) <= 1e-13 * np.linalg.norm(omega[i]), where, "no angular momentum has this angular velocity")
        judge.close([e], [own_energy], abs(own_energy), tolerance["row"], f"{where}, energy")
        judge.close([size], [np.linalg.norm(k)], size, tolerance["row"], f"{where}, momentum")
        judge.close([attitude[i] @ attitude[i]], [1], 1, tolerance["row"], f"{where}, attitude")
        judge(power >= 0, where, "the power taken is negative")
    inertial = [k + 2 * np.cross(a[1:], np.cross(a[1:], k) + a[0] * k) for k, a in zip(K, attitude)]
    angle = np.cumsum(np.append(0, np.diff(t) * np.linalg.norm(omega[:-1], axis=1)))
    for i, (now, angle_now) in enumerate(zip(inertial, angle)):
        allowed = tolerance["row"] + tolerance["flow"] * angle_now
        judge.close(now, inertial[0], momentum[0], allowed, f"row {i}: the inertial angular momentum")
        floor = tolerance["taken"] * abs(taken[i] - taken[0]) + 1e-3 * tolerance["row"] * abs(energy[0]) * (1 + 1e-3 * angle_now)
        judge(abs(energy[i] - energy[0] + taken[i] - taken[0]) <= floor, f"row {i}, dissipated", "is not the energy lost")
    judge(taken[0] == 0, "row 0, dissipated", "does not start from zero")
    count = max(1, int(min(len(t) - 1, most * (len(t) - 1) / angle[-1])))  # about `most` radians are followed
    followed = sorted({int(i) for i in np.linspace(0, len(t) - 2, count)})
    for i in followed:
        after = own.across(np.concatenate([K[i], attitude[i], [0.0]]), t[i + 1] - t[i])
        allowed = tolerance["row"] + tolerance["flow"] * (angle[i + 1] - angle[i])
        where = f"from row {i} to row {i + 1}"
        judge.close(K[i + 1], after[:3], momentum[i], allowed, f"{where}: the angular momentum")
        sign = np.sign(after[3:7] @ attitude[i + 1])
        judge.close(attitude[i + 1], sign * after[3:7], 1, allowed, f"{where}: the attitude")
        loss = taken[i + 1] - taken[i]
        judge(abs(loss - after[7]) <= tolerance["taken"] * after[7] + 1e-3 * tolerance["row"] * abs(energy[0]), f"{where}: dissipated", "is not the integral of the power")
    judge.told.append(f"{len(t)} rows, and the equations lead from each to the next in {len(followed)} of {len(t) - 1} intervals")
    try:
        rebuilt_energy(tomllib.loads(document["model"]["text"]), judge, own, stated["order"])
        judge.told.append("the leading terms of E, c and T are those of the model file, rebuilt")
    except LookupError as other:
        judge.told.append(f"the polynomials are taken as stated, since this checker does not rebuild {other}")


CHECKS = {"modes": check_modes, "simulate": check_simulate}


def checked(document):
    """The judge of a document."""
    judge = Judge()
    for key, value in KNOWN.items():
        if document.get(key) != value:
            raise ValueError(f"{key} is {document.get(key)!r}, and this checker knows {value!r}")
    kind = document["of"]
    if document["tolerances"] != TOLERANCES[kind]:
        raise ValueError("the tolerances are not those of this version")
    model = document["model"]
    digest = hashlib.sha256(model["text"].encode()).hexdigest()
    judge(digest == model["sha256"], "model.sha256", "is not that of the text")
    CHECKS[kind](document, judge)
    return judge


UNREADABLE = (OSError, ValueError, KeyError, TypeError, IndexError, AttributeError, ZeroDivisionError, np.linalg.LinAlgError)


def main(path):
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
        judge = checked(document)
    except UNREADABLE as error:
        print(f"cannot read {path}: {type(error).__name__}: {error}", file=sys.stderr)
        return 2
    print(f"{path}: {'does NOT hold' if judge.wrong else 'holds'}")
    for line in judge.wrong or judge.told:
        print(f"  {line}")
    if not judge.wrong:
        print("  not claimed: " + "; ".join(document["not_claimed"]))
    return 1 if judge.wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
