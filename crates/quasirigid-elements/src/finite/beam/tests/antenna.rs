//! Clamped antenna (Euler–Bernoulli) under inertial loads: its energy, and the share of each mode in it.

use super::*;

const LENGTH: f64 = 1.7;

/// Matrices of the antenna without its root.
struct Antenna {
    K: DMatrix<f64>,
    M: DMatrix<f64>,
    /// Loads of a unit acceleration across and of a unit angular acceleration about the root.
    loads: [DVector<f64>; 2],
    /// `EI` (N·m²).
    bending: f64,
    /// Mass per length (kg/m).
    line: f64,
}

/// An antenna of some elements along the second axis of the body, seen in the plane with the first.
fn antenna(count: usize) -> Antenna {
    let root = Vector3::new(0.5, 0.2, -0.3);
    let section = thin(2e-4, 3e-5, 1e-5);
    let chain = Chain::even(
        [root.into(), (root + LENGTH * Vector3::y()).into()],
        [1.0, 0.0, 0.0],
        section,
        ALLOY,
        count,
    );
    let kept: Vec<usize> = (1..=count).flat_map(|node| [6 * node, 6 * node + 5]).collect();
    let (mass, nodes) = (chain.sum(Beam::mass), chain.nodes());
    let turn = -Vector3::z();
    let loads = [rigid(&nodes, Vector3::x(), Vector3::zeros()), rigid(&nodes, -turn.cross(&root), turn)]
        .map(|field| (&mass * field).select_rows(&kept));
    Antenna {
        K: part(&chain.sum(Beam::stiffness), &kept),
        M: part(&mass, &kept),
        loads,
        bending: ALLOY.young * section.second_z,
        line: ALLOY.density * section.area,
    }
}

impl Antenna {
    /// `½ fᵀK⁻¹f` under a load `α + β s`, over its closed form.
    fn energy(&self, alpha: f64, beta: f64) -> f64 {
        let load = (alpha * &self.loads[0] + beta * &self.loads[1]) / self.line;
        0.5 * load.dot(&self.K.clone().cholesky().unwrap().solve(&load))
            / closed_energy(self.bending, alpha, beta)
    }

    /// Shares of the modes: of the mass, of the inertia about the root, of the energy under an even and a linear
    /// load.
    fn shares(&self) -> Vec<[f64; 4]> {
        let (squares, modes) = eigen(&self.K, &self.M);
        let whole = [self.line * LENGTH, self.line * LENGTH.powi(3) / 3.0];
        let energy = [closed_energy(self.bending, 1.0, 0.0), closed_energy(self.bending, 0.0, 1.0)];
        let share = |mode: usize| {
            let [even, linear] = [0, 1].map(|i| modes.column(mode).dot(&self.loads[i]).powi(2));
            let stored =
                |square: f64, i: usize| 0.5 * square / (squares[mode] * self.line.powi(2) * energy[i]);
            [even / whole[0], linear / whole[1], stored(even, 0), stored(linear, 1)]
        };
        (0..modes.ncols()).map(share).collect()
    }
}

fn closed_energy(bending: f64, a: f64, b: f64) -> f64 {
    let L = LENGTH;
    (L.powi(5) * a * a / 40.0 + 13.0 * L.powi(6) * a * b / 360.0 + 11.0 * L.powi(7) * b * b / 840.0) / bending
}

/// Root `λ` of `cos λ cosh λ = −1`.
fn root(mode: usize) -> f64 {
    let f = |x: f64| x.cos() + 1.0 / x.cosh();
    let [mut low, mut high] = [mode as f64 * std::f64::consts::PI, (mode + 1) as f64 * std::f64::consts::PI];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
    }
    low
}

/// The shares of a mode `φ` of a cantilever: `∫φ = 2σ/λ`, `∫xφ = 2/λ²`.
fn exact(mode: usize) -> [f64; 4] {
    let x = root(mode);
    let sigma = (x.sinh() - x.sin()) / (x.cosh() + x.cos());
    let mass = (2.0 * sigma / x).powi(2);
    [mass, 12.0 / x.powi(4), 20.0 * mass / x.powi(4), 4.0 * 420.0 / 11.0 / x.powi(8)]
}

#[test]
fn energy_of_the_loaded_antenna_converges_with_the_fourth_power() {
    for (alpha, beta) in [(1.0, 0.0), (0.0, 1.0), (2.3, -0.7)] {
        let errors = [1, 2, 4, 8].map(|count| antenna(count).energy(alpha, beta) - 1.0);
        assert!(orders(&errors)[1..].iter().all(|order| (order - 4.0).abs() < 0.1), "{errors:?}");
        if beta == 0.0 {
            // The energy of elements fixed at their nodes under an even load is left out: h⁴/36 of all.
            assert!((errors[0] + 1.0 / 36.0).abs() < 1e-8, "{errors:?}");
        }
    }
}

#[test]
fn modes_share_mass_inertia_and_energy_as_published() {
    let shares = antenna(32).shares();
    let published: [&[f64]; 4] = [
        &[0.613076, 0.188300, 0.064732, 0.033087, 0.020014],
        &[0.970688, 0.024716, 0.003152],
        &[0.991843, 0.007757, 0.000340],
        &[0.999341, 0.000648, 0.000011],
    ];
    for (kind, values) in published.iter().enumerate() {
        for (mode, value) in values.iter().enumerate() {
            // Six digits were printed; h⁴ of the fifth mode adds about as much.
            assert!(
                (shares[mode][kind] - value).abs() < 2e-6,
                "{kind} {mode}: {} {value}",
                shares[mode][kind]
            );
            assert!((exact(mode)[kind] - value).abs() < 6e-7, "the two derivations of the reference");
        }
    }
}

#[test]
fn shares_of_modes_converge_with_the_fourth_power_at_least() {
    let all = [8, 16, 32].map(|count| antenna(count).shares());
    for mode in 0..3 {
        for kind in 0..4 {
            let errors = [0, 1, 2].map(|i| all[i][mode][kind] / exact(mode)[kind] - 1.0);
            let order = orders(&errors)[0];
            if kind >= 2 {
                assert!((3.85..4.15).contains(&order), "{mode} {kind}: {errors:?}");
            } else {
                // Mass and inertia converge with the sixth power; below 1e-9 rounding and the section's rotary inertia show.
                assert!(order > 5.5 && errors[2].abs() < 5e-8, "{mode} {kind}: {errors:?}");
            }
        }
    }
}
