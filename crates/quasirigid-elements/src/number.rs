//! Checks of numbers and directions that the elements share.

use nalgebra::Vector3;

use crate::Problem;

pub(crate) fn finite(values: &[f64]) -> Result<(), Problem> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(Problem::NotFinite { value }),
        None => Ok(()),
    }
}

pub(crate) fn positive(value: f64) -> Result<(), Problem> {
    finite(&[value])?;
    if value > 0.0 { Ok(()) } else { Err(Problem::NotPositive { value }) }
}

pub(crate) fn non_negative(value: f64) -> Result<(), Problem> {
    finite(&[value])?;
    if value >= 0.0 { Ok(()) } else { Err(Problem::Indefinite { eigenvalue: value }) }
}

pub(crate) fn mass(value: f64) -> Result<(), Problem> {
    finite(&[value])?;
    if value > 0.0 { Ok(()) } else { Err(Problem::NotAMass { value }) }
}

pub(crate) fn unit(direction: [f64; 3]) -> Result<Vector3<f64>, Problem> {
    finite(&direction)?;
    let vector = Vector3::from(direction);
    let largest = vector.amax();
    if largest > 0.0 { Ok((vector / largest).normalize()) } else { Err(Problem::ZeroDirection) }
}
