//! Audits of histories of other programs.

use std::path::PathBuf;

use pyo3::prelude::*;
use quasirigid_study::audit::{self, AuditBody, AuditError, AuditSettings};
use serde_json::json;

use crate::answers::Answer;
use crate::arguments::Quantity;
use crate::failure::Failure;
use crate::model::Model;

/// Body and limits of an audit.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    inertia: Option<Vec<f64>>,
    limit: Option<f64>,
    min_time_constant: Option<Quantity>,
    steps: Vec<f64>,
}

/// Audits histories with an inertia or a model.
#[pyfunction]
pub fn audit_histories(
    py: Python<'_>,
    files: Vec<PathBuf>,
    model: Option<&Model>,
    asked: Asked,
) -> PyResult<Answer> {
    let Asked { inertia, limit, min_time_constant, steps } = asked;
    let least = min_time_constant.map(|time| time.seconds("min_time_constant")).transpose()?;
    let settings = AuditSettings { limit, min_time_constant: least, steps };
    let study = model.map(|model| model.study(None)).transpose()?;
    let found = py.detach(|| {
        let body = match (&study, &inertia) {
            (Some(_), Some(_)) => return Err(AuditError::TwoBodies),
            (None, None) => return Err(AuditError::NoBody),
            (Some(study), None) => AuditBody::Model(study),
            (None, Some(entries)) => AuditBody::Inertia(audit::inertia(entries)?),
        };
        audit::audit(&files, body, &settings)
    });
    let found = found.map_err(refused)?;
    let badge = found.badge();
    let mut object = json!(found);
    object["badge"] = badge;
    let holds = found.holds && found.within_limits != Some(false);
    Ok(Answer::plain(object, found.text(), found.sentence, holds, found.notes))
}

fn refused(error: AuditError) -> Failure {
    match error {
        AuditError::Study(error) => error.into(),
        AuditError::File(error) => Failure::File(error.to_string()),
        AuditError::NoBody => {
            Failure::Input("the inertia of the body is not given; give inertia or a model".to_owned())
        }
        AuditError::TwoBodies => {
            Failure::Input("the inertia is given twice, by inertia and by a model; leave one out".to_owned())
        }
        other => Failure::Input(other.to_string()),
    }
}
