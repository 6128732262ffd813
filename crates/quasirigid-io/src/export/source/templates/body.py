{{heading}}

import numpy as np

# Start of the model: angular momentum (N m s, body axes) and quaternion.
START = np.array({{start}})
# Inertia about the centre of mass (kg m^2): xx, yy, zz, yz, zx, xy; its least principal moment.
INERTIA = np.array({{inertia}})
LEAST_MOMENT = {{least_moment}}
# Mass (kg).
MASS = {{mass}}
# Angular momentum of momentum wheels relative to the body (N m s).
WHEELS = np.array({{wheels}})
# Spins (rad/s) up to which the equations hold, and from which they fail.
SPIN_HOLDS = {{spin_holds}}
SPIN_FAILS = {{spin_fails}}
HOLDS, MARGINAL, FAILS, NOT_FINITE = range(4)

_NONE = np.zeros(3)


def energy(K):
    """Energy (J) at an angular momentum."""
    x, y, z = K
    return (
        {{energy}}
    )


def energy_gradient(K):
    x, y, z = K
    return np.array([
        {{gradient_x}},
        {{gradient_y}},
        {{gradient_z}},
    ])


def internal_momenta(K):
    """The vector c of the energy form."""
    x, y, z = K
    return np.array([
        {{c_x}},
        {{c_y}},
        {{c_z}},
    ])


def dissipation(K):
    """The tensor T of the energy form: xx, yy, zz, yz, zx, xy."""
    x, y, z = K
    return np.array([
        {{T_xx}},
        {{T_yy}},
        {{T_zz}},
        {{T_yz}},
        {{T_zx}},
        {{T_xy}},
    ])


def motion(K, torque=_NONE):
    """Angular velocity (rad/s), rate of the angular momentum (N m), both in body axes, and power dissipated (W)."""
    gradient, c, T = energy_gradient(K), internal_momenta(K), dissipation(K)
    v = np.cross(K, gradient)
    a = 1.0 + K @ c
    d = a * a + K @ _times(_adjugate(T), K)
    free = (a * v + np.cross(K, _times(T, v))) / d
    # what the torque adds: (a - K x T)^-1 (M + c K.M)
    m = torque + c * (K @ torque)
    once = np.cross(K, _times(T, m))
    twice = np.cross(K, _times(T, once))
    rate = free + (m + (a * once + twice) / d) / a
    braking = _times(T, rate)
    return gradient + np.cross(c, rate) + braking, rate, rate @ braking


def rates(y, torque=_NONE):
    """Right-hand side: rates of the state (K, quaternion) for any integrator."""
    omega, rate, _ = motion(y[:3], torque)
    return np.concatenate([rate, _attitude_rate(y[3:], omega)])


def momentum_of(omega):
    """Angular momentum with an angular velocity where no torque acts."""
    omega = np.asarray(omega, dtype=float)
    K = _times(INERTIA, omega) + WHEELS
    for _ in range(200):
        gap = omega - motion(K)[0]
        if np.linalg.norm(gap) <= 4e-16 * np.linalg.norm(omega):
            break
        K = K + _times(INERTIA, gap)
    if not np.linalg.norm(gap) <= 1e-12 * np.linalg.norm(omega):
        raise ValueError("no angular momentum has this angular velocity: it is beyond the range of the equations")
    return K


def status(y, torque=_NONE):
    """Status of a state: HOLDS, MARGINAL, FAILS or NOT_FINITE."""
    spin = np.linalg.norm(motion(y[:3])[0])
    # the angular acceleration of a torque counts as the square of a spin
    spin = max(spin, np.sqrt(np.linalg.norm(torque) / LEAST_MOMENT))
    if not (np.isfinite(spin) and np.all(np.isfinite(y))):
        return NOT_FINITE
    return HOLDS if spin < SPIN_HOLDS else MARGINAL if spin < SPIN_FAILS else FAILS


def step(y, torque, dt):
    """State after one step of the classical Runge-Kutta method with a constant torque.

    Without a torque |K|, the angular momentum in inertial axes and the balance of the energy are restored to rounding.
    """
    y, torque = np.array(y, dtype=float), np.asarray(torque, dtype=float)
    y[3:] /= np.linalg.norm(y[3:])
    slope, total = np.zeros(8), np.zeros(8)
    for place, weight in ((0.0, 1 / 6), (0.5, 1 / 3), (0.5, 1 / 3), (1.0, 1 / 6)):
        stage = y + place * dt * slope[:7]
        omega, rate, power = motion(stage[:3], torque)
        slope = np.concatenate([rate, _attitude_rate(stage[3:], omega), [omega @ torque - power]])
        total += weight * slope
    after = y + dt * total[:7]
    after[3:] /= np.linalg.norm(after[3:])
    size = np.linalg.norm(y[:3])
    if not torque.any() and size > 0.0:
        after[:3] = _restored(after[:3], size, energy(y[:3]) + dt * total[7])
        after[3:] = _aligned(after[3:], _inertial(after[3:], after[:3]), _inertial(y[3:], y[:3]))
    return after


def _times(S, a):
    xx, yy, zz, yz, zx, xy = S
    x, y, z = a
    return np.array([xx * x + xy * y + zx * z, xy * x + yy * y + yz * z, zx * x + yz * y + zz * z])


def _adjugate(S):
    xx, yy, zz, yz, zx, xy = S
    return np.array([
        yy * zz - yz * yz, zz * xx - zx * zx, xx * yy - xy * xy,
        zx * xy - xx * yz, xy * yz - yy * zx, yz * zx - zz * xy,
    ])


def _attitude_rate(q, omega):
    s, v = q[0], q[1:]
    return 0.5 * np.concatenate([[-v @ omega], s * omega + np.cross(v, omega)])


def _inertial(q, vector):
    first = np.cross(q[1:], vector) + q[0] * vector
    return vector + 2.0 * np.cross(q[1:], first)


def _restored(K, size, level):
    for last in (False, False, True):
        K = K * (size / np.linalg.norm(K))
        gradient = energy_gradient(K)
        across = gradient - K * (gradient @ K) / (K @ K)
        squared, gap = across @ across, level - energy(K)
        # next to a steady spin the energy does not see where K is
        if last or not abs(gap) * np.linalg.norm(gradient) < squared * size:
            break
        K = K + across * (gap / squared)
    return K


def _aligned(q, now, then):
    s, v = np.linalg.norm(now) * np.linalg.norm(then) + now @ then, np.cross(now, then)
    if not s > 0.0:
        return q
    turned = np.concatenate([[s * q[0] - v @ q[1:]], s * q[1:] + q[0] * v + np.cross(v, q[1:])])
    return turned / np.linalg.norm(turned)


# Angular momentum, torque; angular velocity, rate of the angular momentum, power, energy.
TESTS = np.array({{tests}})


def self_test():
    """Largest relative difference from quasirigid's own numbers."""
    found = []
    for row in TESTS:
        omega, rate, power = motion(row[:3], row[3:6])
        found.append([*omega, *rate, power, energy(row[:3])])
    found, kept = np.array(found), TESTS[:, 6:]
    columns = [slice(0, 3), slice(3, 6), slice(6, 7), slice(7, 8)]
    return max(np.abs(found[:, s] - kept[:, s]).max() / max(np.abs(kept[:, s]).max(), 1e-300) for s in columns)


if __name__ == "__main__":
    print(f"largest relative difference from quasirigid: {self_test():.1e}")
