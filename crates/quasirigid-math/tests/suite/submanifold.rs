//! Spectral submanifolds of oscillators against SSMTool, `data/published/ssmtool_2023`.

use std::ops::ControlFlow;
use std::time::Instant;

use quasirigid_math::submanifold::{
    Equations, LinearPart, Master, Plan, PolynomialSystem, Ring, Style, Truncated, expand,
};

const VALUES: &str = include_str!("../../../../data/published/ssmtool_2023/values.csv");

/// Oscillators of unit mass with springs that have a cubic part, `ẍ + Cẋ + Kx + f(x) = 0`; state: velocities, then displacements.
struct Oscillators {
    damping: Vec<Vec<f64>>,
    stiffness: Vec<Vec<f64>>,
    /// Ends of the springs with a cubic part, none for the ground, and its coefficient.
    cubic: Vec<([Option<usize>; 2], f64)>,
}

impl PolynomialSystem for Oscillators {
    fn size(&self) -> usize {
        2 * self.stiffness.len()
    }

    fn equations(&self, ring: &Ring, state: &[Truncated]) -> Equations {
        let (v, x) = state.split_at(self.stiffness.len());
        let mut forces: Vec<Truncated> = v.iter().map(|_| ring.zero()).collect();
        for (row, force) in forces.iter_mut().enumerate() {
            for column in 0..x.len() {
                force.add_scaled(-self.damping[row][column], &v[column]);
                force.add_scaled(-self.stiffness[row][column], &x[column]);
            }
        }
        for (ends, coefficient) in &self.cubic {
            let mut stretch = ring.zero();
            for (end, sign) in ends.iter().zip([1.0, -1.0]) {
                end.iter().for_each(|end| stretch.add_scaled(sign, &x[*end]));
            }
            let cube = ring.product(&stretch, &ring.product(&stretch, &stretch));
            for (end, sign) in ends.iter().zip([1.0, -1.0]) {
                end.iter().for_each(|end| forces[*end].add_scaled(-sign * coefficient, &cube));
            }
        }
        forces.extend_from_slice(v);
        Equations { momenta: state.to_vec(), forces }
    }

    fn scales(&self) -> Vec<f64> {
        vec![1.0; self.size()]
    }
}

/// Two masses, each on a spring to the ground and one between them.
fn pair(damping: [[f64; 2]; 2], stiffness: [f64; 2], cubic: f64) -> Oscillators {
    let [own, coupling] = stiffness;
    Oscillators {
        damping: damping.map(|row| row.to_vec()).to_vec(),
        stiffness: vec![vec![own, coupling], vec![coupling, own]],
        cubic: vec![([Some(0), None], cubic)],
    }
}

/// Chain of masses between two walls.
fn chain(count: usize, damping: f64, cubic: f64) -> Oscillators {
    let links = |factor: f64| -> Vec<Vec<f64>> {
        let entry = |i: usize, k: usize| match i.abs_diff(k) {
            0 => 2.0 * factor,
            1 => -factor,
            _ => 0.0,
        };
        (0..count).map(|i| (0..count).map(|k| entry(i, k)).collect()).collect()
    };
    let end = |k: usize| k.checked_sub(1).filter(|k| *k < count);
    let cubic = (0..=count).map(|k| ([end(k + 1), end(k)], cubic)).collect();
    Oscillators { damping: links(damping), stiffness: links(1.0), cubic }
}

fn published(system: &str, quantity: &str) -> [f64; 2] {
    let row = VALUES.lines().find(|line| line.starts_with(&format!("{system},{quantity},"))).unwrap();
    let number = |column: usize| row.split(',').nth(column).unwrap().parse().unwrap();
    [number(2), number(3)]
}

/// Eigenvalue of the slowest mode and coefficients of its normal form in the leading amplitude of a coordinate.
fn normal_form(system: &Oscillators, coordinate: usize, degree: usize) -> (Vec<[f64; 2]>, [f64; 2]) {
    let size = system.size();
    let linear = LinearPart::at(system, &vec![0.0; size]);
    let found = linear.spectrum().unwrap();
    let (lambda, vector) = found.iter().max_by(|a, b| a.0[0].total_cmp(&b.0[0])).unwrap();
    let pair = linear.refined(*lambda, vector).unwrap();
    let [re, im] = pair.right[size / 2 + coordinate];
    let pair = pair.scaled([0.5 / re.hypot(im), 0.0]);
    let lambda = pair.lambda;
    let masters = vec![
        Master { mode: pair.clone(), partner: 1, weight: vec![1] },
        Master { mode: pair.conjugate(), partner: 0, weight: vec![-1] },
    ];
    let plan = Plan { masters, style: Style::NormalForm, degree };
    let manifold = expand(system, &linear, plan, &mut |_| ControlFlow::Continue(())).unwrap();
    let coefficient = |j: u8| manifold.rates[0].coefficient(manifold.ring.index(&[j + 1, j]).unwrap());
    ((1..=(degree as u8 - 1) / 2).map(coefficient).collect(), lambda)
}

#[test]
fn normal_forms_are_those_of_ssmtool() {
    let (c1, c2) = (0.03, 0.03 * 3.0_f64.sqrt());
    let systems = [
        ("shaw_pierre", pair([[c1 + c2, -c2], [-c2, c1 + c2]], [6.0, -3.0], 0.4), 0),
        ("shaw_pierre_nonprop", pair([[0.06, -0.02], [-0.02, 0.03]], [2.0, -1.0], 0.5), 0),
        ("chain10", chain(10, 0.1, 0.5), 4),
    ];
    for (name, system, coordinate) in systems {
        let (found, lambda) = normal_form(&system, coordinate, 7);
        let gap = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) / b[0].hypot(b[1]);
        let gaps: Vec<f64> =
            (0..3).map(|j| gap(found[j], published(name, &format!("gamma{}", j + 1)))).collect();
        let times = [3, 5, 7].map(|degree| {
            let start = Instant::now();
            normal_form(&system, coordinate, degree);
            start.elapsed()
        });
        println!("{name}: {gaps:?}, degrees 3, 5 and 7 in {times:?}");
        assert!(gap(lambda, published(name, "lambda")) < 1e-14, "{name}: {lambda:?}");
        // 2e-14 between two programs; the coefficients of degree 7 are small differences of larger terms.
        assert!(gaps.iter().all(|gap| *gap < 1e-11), "{name}: {found:?}");
    }
}
