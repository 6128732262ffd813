//! Damped free vibrations and relaxations of the recoiling body, and their amplitudes from an initial displacement and rate.
//! The eigenvalue problem is solved in undamped modes, where it is skew but for the damping; cyclic coordinates have no stiffness and join
//! as modes of friction.
//! Equations (V3), docs/theory/04-validity.md; (B1), docs/theory/09-forced-reduction.md; (C8), docs/theory/13-inside.md.

use nalgebra::{Complex, DMatrix, DVector};

use crate::math::eigen::{Dense, NoConvergence, eigenvectors, modes};
use crate::math::krylov::dot;
use crate::model::FlexibleBody;

/// Damped mode: `q(t) = Re(shape · e^{λt})`.
#[derive(Clone, Debug, PartialEq)]
pub struct DampedMode {
    /// Decay rate `−Re λ` (1/s).
    pub decay: f64,
    /// Frequency `Im λ` (rad/s); zero of an overdamped mode.
    pub frequency: f64,
    /// Real and imaginary part of the displacement of each coordinate at `t = 0`; of a cyclic one from its final rest position.
    pub shape: Vec<[f64; 2]>,
}

/// Damped free vibrations and relaxations of the body that recoils, from a displacement and its rate, in the undamped modes
/// `(Ωη, η̇)`, slowest decay first. (V3) with the recoil of (V2), (C8)
pub(super) fn damped_modes(
    body: &FlexibleBody,
    q: &[f64],
    rate: &[f64],
) -> Result<Vec<DampedMode>, NoConvergence> {
    let (n, elastic) = (q.len(), body.elastic());
    let size = elastic + n;
    let mass = body.recoiling_mass_matrix();
    let Undamped { frequencies, shapes } = undamped(body, &mass)?;
    let mut system = Dense::zero(size);
    for (k, frequency) in frequencies.iter().enumerate() {
        system.add(k, elastic + k, *frequency);
        system.add(elastic + k, k, -frequency);
    }
    for (k, shape) in shapes.iter().enumerate() {
        let force = body.damping().times(shape);
        for (row, other) in shapes.iter().enumerate() {
            system.add(elastic + row, elastic + k, -dot(other, &force));
        }
    }
    // Modal coordinates by orthogonality, Xᵀ M X = 1.
    let (inertia, moving) = (mass.times(q), mass.times(rate));
    let start = (0..size).map(|i| {
        Complex::from(match i.checked_sub(elastic) {
            None => frequencies[i] * dot(&shapes[i], &inertia),
            Some(mode) => dot(&shapes[mode], &moving),
        })
    });
    let (values, vectors) = eigenvectors(&system)?;
    let matrix = DMatrix::from_fn(size, size, |row, column| complex(vectors[column][row]));
    let amplitudes = DVector::from_iterator(size, start);
    let amplitudes = matrix.lu().solve(&amplitudes).ok_or(NoConvergence { size })?;
    let mut found: Vec<DampedMode> = Vec::with_capacity(n);
    for ((value, vector), amplitude) in values.iter().zip(&vectors).zip(amplitudes.iter()) {
        let [decay, frequency] = [-value[0], value[1]];
        if frequency < 0.0 {
            continue;
        }
        let twice = amplitude * if frequency > 0.0 { 2.0 } else { 1.0 };
        let eta: Vec<Complex<f64>> = (0..n)
            .map(|k| match frequencies.get(k) {
                Some(undamped) => complex(vector[k]) * twice / undamped,
                None => complex(vector[elastic + k]) * twice / complex(*value),
            })
            .collect();
        let displacement = |row: usize| {
            let sum: Complex<f64> = eta.iter().zip(&shapes).map(|(eta, shape)| eta * shape[row]).sum();
            [sum.re, sum.im]
        };
        found.push(DampedMode { decay, frequency, shape: (0..n).map(displacement).collect() });
    }
    found.sort_by(|a, b| a.decay.total_cmp(&b.decay));
    Ok(found)
}

/// Undamped modes of unit modal mass: vibrations with their frequencies, then motions without stiffness.
pub(super) struct Undamped {
    pub frequencies: Vec<f64>,
    pub shapes: Vec<Vec<f64>>,
}

/// Undamped modes: vibrations give cyclic coordinates zero momentum, `M_cc x_c = −M_ce x_e`; the other modes move cyclic coordinates
/// alone.
pub(super) fn undamped(body: &FlexibleBody, mass: &Dense) -> Result<Undamped, NoConvergence> {
    let (elastic, cyclic) = (body.elastic(), body.cyclic());
    let brakes = Dense::of(&body.damping().block(cyclic.clone()));
    let loose = modes(&mass.block(cyclic.clone()), &brakes)?;
    let loose: Vec<Vec<f64>> = (0..cyclic.len())
        .map(|k| {
            let mut shape = vec![0.0; elastic];
            shape.extend((0..cyclic.len()).map(|row| loose.shapes.at(row, k)));
            shape
        })
        .collect();
    let momenta: Vec<Vec<f64>> = loose.iter().map(|shape| mass.times(shape)).collect();
    let mut left = mass.block(0..elastic);
    for angular_momentum in &momenta {
        for (row, a) in angular_momentum[..elastic].iter().enumerate() {
            for (column, b) in angular_momentum[..elastic].iter().enumerate() {
                left.add(row, column, -a * b);
            }
        }
    }
    let held = modes(&left, &Dense::of(&body.stiffness().block(0..elastic)))?;
    let vibration = |k: usize| {
        let mut shape: Vec<f64> = (0..elastic).map(|row| held.shapes.at(row, k)).collect();
        shape.resize(cyclic.end, 0.0);
        for (loose, angular_momentum) in loose.iter().zip(&momenta) {
            let amount = dot(&angular_momentum[..elastic], &shape[..elastic]);
            cyclic.clone().for_each(|row| shape[row] -= amount * loose[row]);
        }
        shape
    };
    let shapes = (0..elastic).map(vibration).collect::<Vec<_>>();
    Ok(Undamped { shapes: [shapes, loose].concat(), frequencies: held.frequencies })
}

fn complex([re, im]: [f64; 2]) -> Complex<f64> {
    Complex::new(re, im)
}
