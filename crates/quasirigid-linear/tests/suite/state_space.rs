//! Truncations of random systems: bounds against responses, integrators, refusals, units and axes.

use nalgebra::{Complex, DMatrix};
use quasirigid_linear::state_space::{StateSpace, TruncationError, TruncationMethod, TruncationRequest};

use self::samples::{Draws, decaying};

#[path = "../../src/state_space/tests/samples.rs"]
mod samples;

type C = Complex<f64>;
type Real = DMatrix<f64>;
type Matrix = DMatrix<C>;

/// Matrices of a state space.
#[derive(Clone, Debug)]
struct System {
    A: Real,
    B: Real,
    C: Real,
    D: Real,
}

impl System {
    fn of(space: &StateSpace) -> Self {
        let (states, inputs, outputs) = (space.A.len(), space.D.first().map_or(0, Vec::len), space.D.len());
        let matrix = |rows: &[Vec<f64>], height, width| {
            DMatrix::from_row_iterator(height, width, rows.iter().flatten().copied())
        };
        Self {
            A: matrix(&space.A, states, states),
            B: matrix(&space.B, states, inputs),
            C: matrix(&space.C, outputs, states),
            D: matrix(&space.D, outputs, inputs),
        }
    }

    fn listed(&self) -> StateSpace {
        let rows = |matrix: &Real| matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
        StateSpace { A: rows(&self.A), B: rows(&self.B), C: rows(&self.C), D: rows(&self.D) }
    }

    fn states(&self) -> usize {
        self.A.nrows()
    }

    /// Two systems with the same inputs, whose outputs add.
    fn beside(&self, other: &Self) -> Self {
        let (first, second) = (self.states(), other.states());
        let mut A = Real::zeros(first + second, first + second);
        A.view_mut((0, 0), (first, first)).copy_from(&self.A);
        A.view_mut((first, first), (second, second)).copy_from(&other.A);
        let mut B = Real::zeros(first + second, self.B.ncols());
        B.rows_mut(0, first).copy_from(&self.B);
        B.rows_mut(first, second).copy_from(&other.B);
        let mut C = Real::zeros(self.C.nrows(), first + second);
        C.columns_mut(0, first).copy_from(&self.C);
        C.columns_mut(first, second).copy_from(&other.C);
        Self { A, B, C, D: &self.D + &other.D }
    }
}

/// Transfer matrix at a complex frequency (1/s).
fn response(system: &System, s: C) -> Matrix {
    let size = system.states();
    let shifted = Matrix::from_diagonal_element(size, size, s) - system.A.map(C::from);
    let states = shifted.lu().solve(&system.B.map(C::from)).unwrap();
    system.C.map(C::from) * states + system.D.map(C::from)
}

/// Largest singular value.
fn gain(matrix: &Matrix) -> f64 {
    matrix.singular_values().max()
}

/// Of one state: `σ = |b c| / 2|a|`, and the error of leaving it out is its bound.
#[test]
fn one_relaxation_has_its_closed_singular_value() {
    let of = |entry: f64| Real::from_element(1, 1, entry);
    let system = System { A: of(-0.4), B: of(3.0), C: of(-0.2), D: of(0.7) };
    let asked = TruncationRequest {
        method: TruncationMethod::Balanced,
        states: 0,
        rate: 0.0,
        inputs: &[0],
        outputs: &[0],
    };
    let none = system.listed().truncated(&asked).unwrap();
    let unit = none.scales[0][0] * none.scales[1][0];
    assert!((unit * none.singular_values[0] - 0.75).abs() < 1e-15);
    assert!((unit * none.bound - 1.5).abs() < 1e-15);
    let error = response(&system, C::from(0.0)) - System::of(&none.system).D.map(C::from);
    assert!((gain(&error) - 1.5).abs() < 1e-15);
}

fn request(method: TruncationMethod, states: usize) -> TruncationRequest<'static> {
    TruncationRequest { method, states, rate: 0.0, inputs: &[0, 0], outputs: &[0, 0] }
}

/// Two integrators beside the oscillators, coupled with them.
fn with_integrators(draws: &mut Draws, modes: usize) -> System {
    let part = decaying(draws, modes);
    let mut A = Real::zeros(2, 2);
    A[(0, 1)] = 1.0;
    let rigid = System { A, B: draws.matrix(2, 2), C: draws.matrix(2, 2), D: Real::zeros(2, 2) };
    let whole = rigid.beside(&part);
    let size = whole.states();
    let mut change = Real::identity(size, size);
    change.view_mut((0, 2), (2, size - 2)).copy_from(&(0.1 * draws.matrix(2, size - 2)));
    let inverse = change.clone().try_inverse().unwrap();
    System { A: &change * whole.A * &inverse, B: change * whole.B, C: whole.C * inverse, D: whole.D }
}

#[test]
fn bounds_are_not_exceeded_and_integrators_stay_what_they_are() {
    let mut draws = Draws(11);
    for trial in 0..12 {
        let whole = with_integrators(&mut draws, 5 + trial % 3);
        for (method, states) in [
            (TruncationMethod::Balanced, 4 + trial % 5),
            (TruncationMethod::Balanced, 2),
            (TruncationMethod::Modal, 7),
        ] {
            let found = whole.listed().truncated(&request(method, states)).unwrap();
            assert_eq!((found.system.A.len(), found.lasting), (states, 2), "{method:?}");
            let part = System::of(&found.system);
            let scale = found.scales[0][0] * found.scales[1][0];
            let mut worst: f64 = 0.0;
            for k in 0..400 {
                let frequency = 10f64.powf(-4.0 + 7.0 * f64::from(k) / 399.0);
                if found.up_to.is_some_and(|last| frequency > last) {
                    break;
                }
                let s = C::new(0.0, frequency);
                let (all, some) = (response(&whole, s), response(&part, s));
                worst = worst.max((gain(&(&all - some)) - 1e-11 * gain(&all)) / scale);
            }
            assert!(
                worst <= found.bound && !found.spoiled,
                "{trial} {method:?}: {worst:e} {:e}",
                found.bound
            );
            assert!(found.found <= found.bound);
            assert!(worst > 1e-3 * found.bound, "{trial} {method:?}: {worst:e} {:e}", found.bound);
        }
    }
}

/// A double integrator of a truncated model has the response `1/s²` of its own, however low the frequency.
#[test]
fn integrators_have_no_digit_of_the_others() {
    let whole = with_integrators(&mut Draws(2), 6);
    let found = whole.listed().truncated(&request(TruncationMethod::Balanced, 8)).unwrap();
    let [near, far] = [1e-6, 1e-9].map(|frequency| {
        response(&System::of(&found.system), C::new(0.0, frequency)) * C::from(frequency * frequency)
    });
    assert!(gain(&(&near - &far)) < 1e-4 * gain(&near), "{near} {far}");
}

#[test]
fn numbers_of_states_that_cannot_be_are_refused() {
    let mut draws = Draws(7);
    let whole = with_integrators(&mut draws, 3);
    let refused =
        |system: &System, method, states| system.listed().truncated(&request(method, states)).unwrap_err();
    assert_eq!(refused(&whole, TruncationMethod::Balanced, 9), TruncationError::Small { states: 9 });
    assert!(matches!(
        refused(&whole, TruncationMethod::Balanced, 1),
        TruncationError::Lasting { least: 2, .. }
    ));
    assert_eq!(refused(&whole, TruncationMethod::Modal, 1), TruncationError::Rigid { least: 2 });
    let pair = |states| {
        let found = whole.listed().truncated(&request(TruncationMethod::Modal, states));
        matches!(found, Err(TruncationError::Between { asked, below, above }) if below + 1 == asked && above == asked + 1)
    };
    assert!((3..8).any(pair));
    // without damping
    let mut oscillators = decaying(&mut draws, 0);
    for frequency in [2.0, 3.0] {
        let A = Real::from_row_slice(2, 2, &[0.0, 1.0, -frequency * frequency, 0.0]);
        let own = System { A, B: draws.matrix(2, 2), C: draws.matrix(2, 2), D: Real::zeros(2, 2) };
        oscillators = oscillators.beside(&own);
    }
    let told = refused(&oscillators, TruncationMethod::Balanced, 2).to_string();
    assert!(told.contains("4 states do not decay") && told.contains("2.0000, 3.0000 rad/s"), "{told}");
    let modal = oscillators.listed().truncated(&request(TruncationMethod::Modal, 3)).unwrap();
    assert!(modal.bound.is_finite() && modal.found <= modal.bound);
}

/// Unit and axes of the channels, and units of the states, change no singular value.
#[test]
fn singular_values_do_not_know_units_and_axes() {
    let whole = with_integrators(&mut Draws(13), 5);
    let found = |system: &System| system.listed().truncated(&request(TruncationMethod::Balanced, 6)).unwrap();
    let first = found(&whole);
    let turn = Real::from_row_slice(2, 2, &[0.6, -0.8, 0.8, 0.6]);
    let size = whole.states();
    let units = Real::from_fn(size, size, |i, k| if i == k { 10f64.powi(i as i32 % 7 - 3) } else { 0.0 });
    let inverse = units.clone().try_inverse().unwrap();
    let turned = System {
        A: &units * &whole.A * &inverse,
        B: 1e6 * units * &whole.B * &turn,
        C: 1e-4 * &turn * &whole.C * inverse,
        D: 1e2 * &turn * &whole.D * &turn,
    };
    let second = found(&turned);
    for (a, b) in first.singular_values.iter().zip(&second.singular_values) {
        assert!((a - b).abs() < 1e-8 * first.singular_values[0], "{a:e} {b:e}"); // digits lost in turning the states
    }
    assert!((first.bound / second.bound - 1.0).abs() < 1e-6);
}

/// Nothing is rigid and nothing lasts: all is balanced, and the slowest modes alone are kept.
#[test]
fn systems_without_rigid_motions_are_truncated() {
    let whole = decaying(&mut Draws(17), 5);
    for method in [TruncationMethod::Balanced, TruncationMethod::Modal] {
        let found = whole.listed().truncated(&request(method, 7)).unwrap();
        assert!(found.lasting == 0 && found.found <= found.bound && !found.spoiled, "{found:?}");
    }
}
