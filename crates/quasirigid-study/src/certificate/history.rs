//! Certificate of a history by the reduced equations: the polynomials of the energy form, and rows that it leads from one to the next.
//! Equations (R16), (R17), docs/theory/03-reduction.md; (P3), (P4), docs/theory/05-propagation.md.

use quasirigid::dynamics::Form;
use quasirigid::polynomial::Series;
use quasirigid_io::model::System;
use quasirigid_math::vec3::norm;
use serde::Serialize;
use serde_json::json;

use super::{Certificate, Content, refused};
use crate::error::StudyError;
use crate::histories::History;
use crate::study::Study;
use crate::words::significant;

/// Error of the energy and of the angular momentum of a row, as a share of them.
const ROW: f64 = 1e-9;
/// Error of the motion from row to row, per radian, as a share of the angular momentum and of a radian.
const FLOW: f64 = 1e-9;
/// Error of the energy taken from row to row, as a share of it, beside `ROW` over a thousand of the energy.
const TAKEN: f64 = 1e-5;
/// Coarsest tolerance of the integrator whose rows are within these errors.
const TOLERANCE: f64 = 1e-10;
/// Radians between rows up to which a checker in Python takes seconds.
const MOST_RADIANS: f64 = 500.0;
/// Columns that are stated.
const COLUMNS: [&str; 11] =
    ["t", "wx", "wy", "wz", "qw", "qx", "qy", "qz", "energy", "momentum", "dissipated"];

/// Monomial of a polynomial in the components of the angular momentum: exponents and coefficient.
type Term = ([usize; 3], f64);

/// Energy form of the reduced equations, (R16), and the rows.
#[derive(Serialize)]
struct Followed {
    order: usize,
    #[serde(rename = "E")]
    energy: Vec<Term>,
    c: Vec<Vec<Term>>,
    /// Rows xx, yy, zz, yz, zx, xy.
    #[serde(rename = "T")]
    tensor: Vec<Vec<Term>>,
    columns: [&'static str; 11],
    rows: Vec<Vec<f64>>,
}

impl Study {
    /// Certificate of a history that was followed.
    ///
    /// # Errors
    /// [`StudyError::Uncertified`] of other equations than the reduced ones without torque, of tables on a disk, and of coarse tolerances.
    pub fn certify_history(&self, history: &History) -> Result<Certificate, StudyError> {
        let followed = &history.followed;
        if history.system != System::Reduced || followed.forced {
            return Err(refused(
                "of histories only those of the reduced equations without torque have one (--system reduced)",
            ));
        }
        if followed.form != Form::AngularMomentum {
            return Err(refused(
                "the form in the angular velocity keeps no balance of energy; take the form in the angular momentum, the default",
            ));
        }
        if followed.tolerance > TOLERANCE {
            let given = followed.tolerance;
            return Err(refused(format!(
                "its errors are stated for a tolerance of {TOLERANCE:e} or less, not {given:e}; leave --tolerance out"
            )));
        }
        if history.log.is_some() {
            return Err(refused(
                "its rows stand in one document, and these are too many; ask for fewer with --samples",
            ));
        }
        if let Some(reason) = history.reason() {
            return Err(refused(format!("the history is not that of the body to its end: {reason}")));
        }
        let rows = stated(history)?;
        let reduced = self.reduced(followed.order)?;
        let one = |map: &Series| rows_of(map).into_iter().next().unwrap_or_default();
        self.certified(Content {
            of: "simulate",
            claims: vec![
                "in each row the energy and the angular momentum are those of its angular velocity, by the polynomials E, c and T".into(),
                "the angular momentum is constant in inertial axes, and the energy taken is the energy lost".into(),
                "the energy form of the reduced equations leads from each row to the next; a checker follows as many as it is asked to".into(),
            ],
            not_claimed: vec![
                "that the polynomials are those of the model, beyond what the checker rebuilds from its text and says".into(),
                "that the reduced equations hold for the body, which `quasirigid check` and `quasirigid verify` judge".into(),
                "that the first row is the start of the model".into(),
            ],
            tolerances: json!({ "row": ROW, "flow": FLOW, "taken": TAKEN }),
            witness: (
                "history",
                Followed {
                    order: reduced.order,
                    energy: one(&reduced.energy_of_momentum),
                    c: rows_of(&reduced.c),
                    tensor: rows_of(&reduced.T),
                    columns: COLUMNS,
                    rows,
                },
            ),
        })
    }
}

/// Rows of the stated columns.
fn stated(history: &History) -> Result<Vec<Vec<f64>>, StudyError> {
    let column = |name: &&str| history.columns.iter().find(|column| column.name == **name);
    let columns: Option<Vec<_>> = COLUMNS.iter().map(column).collect();
    let columns = columns.ok_or_else(|| refused("a column of the motion is missing"))?;
    let rows: Vec<Vec<f64>> = (0..columns[0].values.len())
        .map(|row| columns.iter().map(|column| column.values[row]).collect())
        .collect();
    let spin = rows.first().map_or(0.0, |first| norm([first[1], first[2], first[3]]));
    let longest = rows.array_windows().map(|[a, b]| b[0] - a[0]).fold(0.0, f64::max);
    if spin * longest > MOST_RADIANS {
        return Err(refused(format!(
            "its rows lie {} radians apart, further than the {MOST_RADIANS} that a checker can follow; ask for more rows with --samples",
            significant(spin * longest, 3)
        )));
    }
    match rows.first() {
        Some(first) if rows.len() > 1 && first[1..4] != [0.0; 3] => Ok(rows),
        _ => Err(refused("a body at rest, or a single row, has no motion to check")),
    }
}

/// Terms of each row of a map; those that are zero are left out.
fn rows_of(map: &Series) -> Vec<Vec<Term>> {
    let mut rows = vec![Vec::new(); map.rows()];
    for degree in 0..=map.degree() {
        for (exponents, coefficients) in map.part(degree).terms() {
            let stated = rows.iter_mut().zip(coefficients).filter(|(_, coefficient)| *coefficient != 0.0);
            stated.for_each(|(row, coefficient)| row.push((exponents, coefficient)));
        }
    }
    rows
}
