{{heading}}
#![allow(non_snake_case, clippy::all)]

/// Start of the model: angular momentum (N m s, body axes) and quaternion.
pub const START: [f64; 7] = {{start}};
/// Inertia about the centre of mass (kg m^2): xx, yy, zz, yz, zx, xy.
pub const INERTIA: [f64; 6] = {{inertia}};
/// Mass (kg).
pub const MASS: f64 = {{mass}};
/// Spins (rad/s) up to which the equations hold, and from which they fail.
pub const SPIN_HOLDS: f64 = {{spin_holds}};
pub const SPIN_FAILS: f64 = {{spin_fails}};
/// Angular momentum of momentum wheels relative to the body (N m s).
pub const WHEELS: [f64; 3] = {{wheels}};
const LEAST_MOMENT: f64 = {{least_moment}};

/// Motion at an angular momentum under a torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Angular velocity of the carrier (rad/s), body axes.
    pub omega: [f64; 3],
    /// Rate of the angular momentum in body axes (N m).
    pub rate: [f64; 3],
    /// Power dissipated (W).
    pub power: f64,
}

/// Status of the range of validity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The equations hold.
    Holds,
    /// Digits are lost.
    Marginal,
    /// The equations fail.
    Fails,
    /// The state is no number.
    NotFinite,
}

/// Energy (J) at an angular momentum.
pub fn energy(K: [f64; 3]) -> f64 {
    {{energy}}
}

fn energy_gradient(K: [f64; 3]) -> [f64; 3] {
    [
        {{gradient_x}},
        {{gradient_y}},
        {{gradient_z}},
    ]
}

fn internal_momenta(K: [f64; 3]) -> [f64; 3] {
    let _ = K;
    [
        {{c_x}},
        {{c_y}},
        {{c_z}},
    ]
}

fn dissipation(K: [f64; 3]) -> [f64; 6] {
    let _ = K;
    [
        {{T_xx}},
        {{T_yy}},
        {{T_zz}},
        {{T_yz}},
        {{T_zx}},
        {{T_xy}},
    ]
}

/// Motion at an angular momentum (N m s) under a torque (N m) on the carrier, body axes.
pub fn motion(K: [f64; 3], torque: [f64; 3]) -> Motion {
    let (gradient, c, T) = (energy_gradient(K), internal_momenta(K), dissipation(K));
    let v = cross(K, gradient);
    let a = 1.0 + dot(K, c);
    let d = a * a + dot(K, times(adjugate(T), K));
    let turned = cross(K, times(T, v));
    // what the torque adds: (a - K x T)^-1 (M + c K.M)
    let along = dot(K, torque);
    let m = [torque[0] + along * c[0], torque[1] + along * c[1], torque[2] + along * c[2]];
    let once = cross(K, times(T, m));
    let twice = cross(K, times(T, once));
    let rate = [0, 1, 2].map(|i| (a * v[i] + turned[i]) / d + (m[i] + (a * once[i] + twice[i]) / d) / a);
    let (braking, curved) = (times(T, rate), cross(c, rate));
    let omega = [0, 1, 2].map(|i| gradient[i] + curved[i] + braking[i]);
    Motion { omega, rate, power: dot(rate, braking) }
}

/// Right-hand side: rates of the state (K, quaternion) for any integrator.
pub fn rates(y: [f64; 7], torque: [f64; 3]) -> [f64; 7] {
    let all = account(y, torque);
    [0, 1, 2, 3, 4, 5, 6].map(|i| all[i])
}

/// Angular momentum with an angular velocity where no torque acts, if there is one.
pub fn momentum_of(omega: [f64; 3]) -> Option<[f64; 3]> {
    let size = norm(omega);
    let first = times(INERTIA, omega);
    let mut K = [0, 1, 2].map(|i| first[i] + WHEELS[i]);
    let mut error = f64::INFINITY;
    for _ in 0..200 {
        let now = motion(K, [0.0; 3]).omega;
        let gap = [0, 1, 2].map(|i| omega[i] - now[i]);
        error = norm(gap);
        if error <= 4e-16 * size {
            break;
        }
        let change = times(INERTIA, gap);
        K = [0, 1, 2].map(|i| K[i] + change[i]);
    }
    if error <= 1e-12 * size { Some(K) } else { None }
}

/// Status of a state.
pub fn status(y: [f64; 7], torque: [f64; 3]) -> Status {
    let spin = norm(motion([y[0], y[1], y[2]], [0.0; 3]).omega);
    // the angular acceleration of a torque counts as the square of a spin
    let turn = sqrt(norm(torque) / LEAST_MOMENT);
    let spin = if turn > spin { turn } else { spin };
    if !spin.is_finite() || y.iter().any(|entry| !entry.is_finite()) {
        Status::NotFinite
    } else if spin < SPIN_HOLDS {
        Status::Holds
    } else if spin < SPIN_FAILS {
        Status::Marginal
    } else {
        Status::Fails
    }
}

/// One step of the classical Runge-Kutta method with a constant torque; returns the status of the new state.
/// Without a torque |K|, the angular momentum in inertial axes and the balance of the energy are then restored to rounding.
pub fn step(y: &mut [f64; 7], torque: [f64; 3], dt: f64) -> Status {
    normalise(y);
    let (mut slope, mut sum) = ([0.0; 8], [0.0; 8]);
    for (place, weight) in [(0.0, 1.0 / 6.0), (0.5, 1.0 / 3.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 6.0)] {
        let stage = [0, 1, 2, 3, 4, 5, 6].map(|i| y[i] + place * dt * slope[i]);
        slope = account(stage, torque);
        for i in 0..8 {
            sum[i] += weight * slope[i];
        }
    }
    let mut next = [0, 1, 2, 3, 4, 5, 6].map(|i| y[i] + dt * sum[i]);
    normalise(&mut next);
    let K = [y[0], y[1], y[2]];
    if dot(torque, torque) == 0.0 && norm(K) > 0.0 {
        let restored = restored([next[0], next[1], next[2]], norm(K), energy(K) + dt * sum[7]);
        next[..3].copy_from_slice(&restored);
        realign(y, &mut next);
    }
    *y = next;
    status(next, torque)
}

/// Rates of the state and, last, of the energy.
fn account(y: [f64; 7], torque: [f64; 3]) -> [f64; 8] {
    let Motion { omega: w, rate, power } = motion([y[0], y[1], y[2]], torque);
    [
        rate[0],
        rate[1],
        rate[2],
        -0.5 * (y[4] * w[0] + y[5] * w[1] + y[6] * w[2]),
        0.5 * (y[3] * w[0] + y[5] * w[2] - y[6] * w[1]),
        0.5 * (y[3] * w[1] + y[6] * w[0] - y[4] * w[2]),
        0.5 * (y[3] * w[2] + y[4] * w[1] - y[5] * w[0]),
        dot(w, torque) - power,
    ]
}

/// K put back where |K| and the energy have their values.
fn restored(mut K: [f64; 3], size: f64, level: f64) -> [f64; 3] {
    for pass in 0..3 {
        let factor = size / norm(K);
        K = K.map(|entry| entry * factor);
        let gradient = energy_gradient(K);
        let along = dot(gradient, K) / dot(K, K);
        let across = [0, 1, 2].map(|i| gradient[i] - along * K[i]);
        let (squared, gap) = (dot(across, across), level - energy(K));
        // next to a steady spin the energy does not see where K is
        if pass == 2 || !(gap.abs() * norm(gradient) < squared * size) {
            break;
        }
        K = [0, 1, 2].map(|i| K[i] + gap / squared * across[i]);
    }
    K
}

/// The smallest rotation that gives K its former inertial direction.
fn realign(before: &[f64; 7], after: &mut [f64; 7]) {
    let (then, now) = (inertial(before), inertial(after));
    let s = sqrt(dot(now, now) * dot(then, then)) + dot(now, then);
    if !(s > 0.0) {
        return;
    }
    let v = cross(now, then);
    let (w, q) = (after[3], [after[4], after[5], after[6]]);
    let turned = cross(v, q);
    after[3] = s * w - dot(v, q);
    for i in 0..3 {
        after[4 + i] = s * q[i] + w * v[i] + turned[i];
    }
    normalise(after);
}

/// Inertial components of the angular momentum of a state.
fn inertial(y: &[f64; 7]) -> [f64; 3] {
    let (K, q) = ([y[0], y[1], y[2]], [y[4], y[5], y[6]]);
    let first = cross(q, K);
    let second = cross(q, [0, 1, 2].map(|i| first[i] + y[3] * K[i]));
    [0, 1, 2].map(|i| K[i] + 2.0 * second[i])
}

fn normalise(y: &mut [f64; 7]) {
    let size = sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5] + y[6] * y[6]);
    for entry in &mut y[3..] {
        *entry /= size;
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Symmetric matrices: xx, yy, zz, yz, zx, xy.
fn times(S: [f64; 6], a: [f64; 3]) -> [f64; 3] {
    [
        S[0] * a[0] + S[5] * a[1] + S[4] * a[2],
        S[5] * a[0] + S[1] * a[1] + S[3] * a[2],
        S[4] * a[0] + S[3] * a[1] + S[2] * a[2],
    ]
}

fn adjugate(S: [f64; 6]) -> [f64; 6] {
    [
        S[1] * S[2] - S[3] * S[3],
        S[2] * S[0] - S[4] * S[4],
        S[0] * S[1] - S[5] * S[5],
        S[4] * S[5] - S[0] * S[3],
        S[5] * S[3] - S[1] * S[4],
        S[3] * S[4] - S[2] * S[5],
    ]
}

fn norm(a: [f64; 3]) -> f64 {
    sqrt(dot(a, a))
}

/// Square root by Newton's method, as `core` has none: an estimate from the exponent, then five steps.
fn sqrt(x: f64) -> f64 {
    if !(x > 0.0) || !x.is_finite() {
        return if x == 0.0 { 0.0 } else if x > 0.0 { x } else { f64::NAN };
    }
    let mut root = f64::from_bits((x.to_bits() >> 1) + 0x1ff7_a3be_a91d_9b1b);
    for _ in 0..5 {
        root = 0.5 * (root + x / root);
    }
    root
}

/// Angular momentum, torque; angular velocity, rate of the angular momentum, power, energy.
pub const TESTS: [[f64; 14]; {{test_count}}] = {{tests}};

/// Largest relative difference from quasirigid's own numbers.
pub fn self_test() -> f64 {
    let (mut apart, mut largest) = ([0.0_f64; 4], [1e-300_f64; 4]);
    for row in TESTS {
        let K = [row[0], row[1], row[2]];
        let Motion { omega, rate, power } = motion(K, [row[3], row[4], row[5]]);
        let found = [omega[0], omega[1], omega[2], rate[0], rate[1], rate[2], power, energy(K)];
        for (i, now) in found.iter().enumerate() {
            let group = [0, 0, 0, 1, 1, 1, 2, 3][i];
            apart[group] = apart[group].max((now - row[6 + i]).abs());
            largest[group] = largest[group].max(row[6 + i].abs());
        }
    }
    (0..4).map(|group| apart[group] / largest[group]).fold(0.0, f64::max)
}
