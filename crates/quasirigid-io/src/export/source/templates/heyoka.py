{{heading}}

import heyoka as hy

# Angular momentum (N m s, body axes) and attitude, scalar first; the torque (N m) is par[0] to par[2].
K = x, y, z = hy.make_vars("K_x", "K_y", "K_z")
q = hy.make_vars("q_w", "q_x", "q_y", "q_z")
M = hy.par[0], hy.par[1], hy.par[2]
# Start of the model: angular momentum and quaternion.
START = {{start}}


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _times(S, a):
    xx, yy, zz, yz, zx, xy = S
    return [xx * a[0] + xy * a[1] + zx * a[2], xy * a[0] + yy * a[1] + yz * a[2], zx * a[0] + yz * a[1] + zz * a[2]]


def _adjugate(S):
    xx, yy, zz, yz, zx, xy = S
    return [
        yy * zz - yz * yz, zz * xx - zx * zx, xx * yy - xy * xy,
        zx * xy - xx * yz, xy * yz - yy * zx, yz * zx - zz * xy,
    ]


def _expressions(numbers):
    return [number if isinstance(number, hy.expression) else hy.expression(number) for number in numbers]


# Energy (J), its gradient, the vector c and the tensor T of the energy form.
energy = (
        {{energy}}
)
gradient = _expressions([
        {{gradient_x}},
        {{gradient_y}},
        {{gradient_z}},
])
c = _expressions([
        {{c_x}},
        {{c_y}},
        {{c_z}},
])
T = _expressions([
        {{T_xx}},
        {{T_yy}},
        {{T_zz}},
        {{T_yz}},
        {{T_zx}},
        {{T_xy}},
])


def _motion():
    a = 1.0 + _dot(K, c)
    d = a * a + _dot(K, _times(_adjugate(T), K))
    v = _cross(K, gradient)
    turned = _cross(K, _times(T, v))
    along = _dot(K, M)
    m = [M[i] + c[i] * along for i in range(3)]
    once = _cross(K, _times(T, m))
    twice = _cross(K, _times(T, once))
    rate = [(a * v[i] + turned[i]) / d + (m[i] + (a * once[i] + twice[i]) / d) / a for i in range(3)]
    braking, curved = _times(T, rate), _cross(c, rate)
    return [gradient[i] + curved[i] + braking[i] for i in range(3)], rate, _dot(rate, braking)


# Angular velocity (rad/s), rate of the angular momentum (N m), power dissipated (W).
omega, rate, power = _motion()
_turned = _cross(q[1:], omega)
attitude_rate = [-0.5 * _dot(q[1:], omega), *(0.5 * (q[0] * omega[i] + _turned[i]) for i in range(3))]
# The system of equations: hy.taylor_adaptive(SYSTEM, START, pars=[0.0, 0.0, 0.0]).
SYSTEM = list(zip([*K, *q], [*rate, *attitude_rate]))

# Angular momentum, torque; angular velocity, rate of the angular momentum, power, energy.
TESTS = {{tests}}


def self_test():
    """Largest relative difference from quasirigid's own numbers."""
    function = hy.cfunc([*omega, *rate, power, energy], list(K))
    found = [function(row[:3], pars=row[3:6]) for row in TESTS]
    worst = 0.0
    for columns in ((0, 1, 2), (3, 4, 5), (6,), (7,)):
        size = max(abs(row[6 + i]) for row in TESTS for i in columns)
        apart = max(abs(row[6 + i] - now[i]) for row, now in zip(TESTS, found) for i in columns)
        worst = max(worst, apart / max(size, 1e-300))
    return worst


if __name__ == "__main__":
    print(f"largest relative difference from quasirigid: {self_test():.1e}")
