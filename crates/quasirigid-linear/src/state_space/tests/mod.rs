//! Schur forms and Gramians of random systems, against definitions. Truncations are tested in `tests/suite`.

mod samples;

use self::samples::{Draws, decaying};
use super::lyapunov::{controllable, observable};
use super::schur::Schur;
use super::{C, Matrix, Real, System};

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
