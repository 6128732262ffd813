{{heading}}

import sympy as sp

# Angular momentum (N m s), torque (N m), body axes; attitude, scalar first.
K = sp.Matrix(sp.symbols("K_x K_y K_z", real=True))
M = sp.Matrix(sp.symbols("M_x M_y M_z", real=True))
q = sp.Matrix(sp.symbols("q_w q_x q_y q_z", real=True))
# Start of the model: angular momentum and quaternion.
START = {{start}}


def _symmetric(xx, yy, zz, yz, zx, xy):
    return sp.Matrix([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])


x, y, z = K
# Energy (J), the vector c and the tensor T of the energy form.
energy = (
        {{energy}}
)
c = sp.Matrix([
        {{c_x}},
        {{c_y}},
        {{c_z}},
])
T = _symmetric(
        {{T_xx}},
        {{T_yy}},
        {{T_zz}},
        {{T_yz}},
        {{T_zx}},
        {{T_xy}},
)
gradient = sp.Matrix([sp.diff(energy, component) for component in K])

# Symbols that stand for gradient, c and T in the equations below, which are too long with the polynomials in their place.
g = sp.Matrix(sp.symbols("g_x g_y g_z", real=True))
C = sp.Matrix(sp.symbols("c_x c_y c_z", real=True))
S = _symmetric(*sp.symbols("T_xx T_yy T_zz T_yz T_zx T_xy", real=True))
POLYNOMIALS = {**dict(zip(g, gradient)), **dict(zip(C, c)), **dict(zip(S, T))}


def _motion():
    a = 1 + K.dot(C)
    d = a**2 + K.dot(S.adjugate() * K)
    v = K.cross(g)
    m = M + C * K.dot(M)
    once = K.cross(S * m)
    twice = K.cross(S * once)
    rate = (a * v + K.cross(S * v)) / d + (m + (a * once + twice) / d) / a
    braking = S * rate
    return g + C.cross(rate) + braking, rate, rate.dot(braking)


# Angular velocity (rad/s), rate of the angular momentum (N m), power dissipated (W); with .subs(POLYNOMIALS) functions of K and M alone.
omega, rate, power = _motion()
_s, _v = q[0], sp.Matrix(q[1:])
attitude_rate = sp.Matrix([-_v.dot(omega), *(_s * omega + _v.cross(omega))]) / 2

# Angular momentum, torque; angular velocity, rate of the angular momentum, power, energy.
TESTS = {{tests}}


def self_test():
    """Largest relative difference from quasirigid's own numbers."""
    symbols, values = list(POLYNOMIALS), list(POLYNOMIALS.values())
    polynomials = sp.lambdify([*K], [*values, energy])
    motion = sp.lambdify([*K, *M, *symbols], [*omega, *rate, power], cse=True)
    found = []
    for row in TESTS:
        *parts, level = polynomials(*row[:3])
        found.append([*motion(*row[:6], *parts), level])
    worst = 0.0
    for columns in ((0, 1, 2), (3, 4, 5), (6,), (7,)):
        size = max(abs(row[6 + i]) for row in TESTS for i in columns)
        apart = max(abs(row[6 + i] - now[i]) for row, now in zip(TESTS, found) for i in columns)
        worst = max(worst, apart / max(size, 1e-300))
    return worst


if __name__ == "__main__":
    print(f"largest relative difference from quasirigid: {self_test():.1e}")
