//! Gramians, splits and bounds of random systems, against definitions and responses.

use nalgebra::DMatrix;

use super::balanced::Balanced;
use super::lyapunov::{controllable, observable};
use super::response::{Response, gain};
use super::schur::Schur;
use super::{C, Matrix, Real, System, TruncationError, TruncationMethod, TruncationRequest};

/// Numbers from −1 to 1, the same in each run.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Real {
        DMatrix::from_fn(rows, columns, |_, _| self.next())
    }
}

/// Damped oscillators of frequencies over two decades and a relaxation, in turned axes and odd units, with two inputs and outputs.
fn decaying(draws: &mut Draws, modes: usize) -> System {
    let size = 2 * modes + 1;
    let mut A = Real::zeros(size, size);
    A[(size - 1, size - 1)] = -0.3;
    for mode in 0..modes {
        let (frequency, k) = (10f64.powf(1.0 + draws.next()), 2 * mode);
        A[(k, k + 1)] = 1.0;
        A[(k + 1, k)] = -frequency * frequency;
        A[(k + 1, k + 1)] = -2.0 * (0.02 + 0.015 * draws.next()) * frequency;
    }
    let mix = Real::identity(size, size) + 0.3 * draws.matrix(size, size);
    let units = Real::from_fn(size, size, |i, k| if i == k { 10f64.powi((i % 5) as i32 - 2) } else { 0.0 });
    let change = mix * units;
    let inverse = change.clone().try_inverse().unwrap();
    System {
        A: &change * A * inverse,
        B: &change * draws.matrix(size, 2),
        C: draws.matrix(2, size) * change.try_inverse().unwrap(),
        D: draws.matrix(2, 2),
    }
}

#[test]
fn schur_form_and_exchanges_give_back_the_matrix() {
    let system = decaying(&mut Draws(3), 7);
    let mut schur = Schur::of(&system.A).unwrap();
    let back = |schur: &Schur| (&schur.Q * &schur.T * schur.Q.adjoint() - system.A.map(C::from)).norm();
    assert!(back(&schur) < 1e-13 * system.A.norm());
    let wanted: Vec<C> = schur.eigenvalues().iter().copied().skip(4).step_by(3).collect();
    let first: Vec<bool> = (0..schur.T.nrows()).map(|k| k >= 4 && (k - 4) % 3 == 0).collect();
    schur.order(&first);
    assert!(back(&schur) < 1e-13 * system.A.norm());
    let found = schur.eigenvalues();
    assert!(
        wanted.iter().zip(&found).all(|(a, b)| (a - b).norm() < 1e-12 * a.norm()),
        "{wanted:?} {found:?}"
    );
    assert!((schur.Q.adjoint() * &schur.Q - Matrix::identity(15, 15)).norm() < 1e-13);
}

#[test]
fn square_roots_of_gramians_solve_their_equations() {
    let system = decaying(&mut Draws(5), 6).balanced();
    let schur = Schur::of(&system.A).unwrap();
    let (reached, seen) = (controllable(&schur, &system.B), observable(&schur, &system.C));
    let (P, Q) = (&reached * reached.transpose(), &seen * seen.transpose());
    let first = &system.A * &P + &P * system.A.transpose() + &system.B * system.B.transpose();
    let second = system.A.transpose() * &Q + &Q * &system.A + system.C.transpose() * &system.C;
    assert!(first.norm() < 1e-12 * system.A.norm() * P.norm(), "{:e}", first.norm());
    assert!(second.norm() < 1e-12 * system.A.norm() * Q.norm(), "{:e}", second.norm());
}

/// Of one state: `σ = |b c| / 2|a|`, and the error of leaving it out is its bound.
#[test]
fn one_relaxation_has_its_closed_singular_value() {
    let of = |entry: f64| Real::from_element(1, 1, entry);
    let system = System { A: of(-0.4), B: of(3.0), C: of(-0.2), D: of(0.7) };
    let none = Balanced::of(&system, 0).unwrap();
    assert!((none.singular_values[0] - 0.75).abs() < 1e-15 && (none.bound - 1.5).abs() < 1e-15);
    let error = Response::of(&system).unwrap().at(C::from(0.0)) - none.system.D.map(C::from);
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
        let response = Response::of(&whole).unwrap();
        for (method, states) in [
            (TruncationMethod::Balanced, 4 + trial % 5),
            (TruncationMethod::Balanced, 2),
            (TruncationMethod::Modal, 7),
        ] {
            let found = whole.listed().truncated(&request(method, states)).unwrap();
            assert_eq!((found.system.A.len(), found.lasting), (states, 2), "{method:?}");
            let part = Response::of(&System::of(&found.system)).unwrap();
            let scale = found.scales[0][0] * found.scales[1][0];
            let mut worst: f64 = 0.0;
            for k in 0..400 {
                let frequency = 10f64.powf(-4.0 + 7.0 * f64::from(k) / 399.0);
                if found.up_to.is_some_and(|last| frequency > last) {
                    break;
                }
                let s = C::new(0.0, frequency);
                let (all, some) = (response.at(s), part.at(s));
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
        Response::of(&System::of(&found.system)).unwrap().at(C::new(0.0, frequency))
            * C::from(frequency * frequency)
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
