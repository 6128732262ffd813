use std::path::{Path, PathBuf};

use quasirigid_study::Study;
use quasirigid_study::audit::{AuditBody, AuditError, AuditSettings, audit as audited, inertia};
use serde_json::json;

use crate::args::{AuditArgs, positive, positive_seconds};
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Ending of model files.
const MODEL: &str = "toml";

/// Audits histories of other programs.
pub fn audit(arguments: &AuditArgs) -> Result<ExitStatus, Failure> {
    let settings = settings(arguments)?;
    let (models, histories): (Vec<PathBuf>, Vec<PathBuf>) =
        arguments.files.iter().cloned().partition(|file| is_model(file));
    if let [first, second, ..] = &models[..] {
        return Err(Failure::TwoModels { first: first.clone(), second: second.clone() });
    }
    if let Some(badge) = &arguments.badge {
        output::check_file(badge, arguments.overwrite)?;
    }
    let study = models.first().map(|model| Study::open(model, None)).transpose()?;
    let body = match (&study, &arguments.inertia) {
        (Some(_), Some(_)) => return Err(AuditError::TwoBodies.into()),
        (None, None) => return Err(AuditError::NoBody.into()),
        (Some(study), None) => AuditBody::Model(study),
        (None, Some(entries)) => AuditBody::Inertia(inertia(entries)?),
    };
    let found = audited(&histories, body, &settings)?;
    output::print_answer(arguments.json, || json!(found), || found.text())?;
    let mut in_place = true;
    if let Some(path) = &arguments.badge {
        let placed = output::to_file(path, arguments.overwrite, |out| writeln!(out, "{:#}", found.badge()))?;
        if !arguments.quiet && !output::is_stdout(path) {
            remark(&format!("wrote {}", placed.path.display()));
        }
        in_place = placed.told(path);
    }
    let fine = in_place && found.holds && found.within_limits != Some(false);
    Ok(if fine { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn is_model(file: &Path) -> bool {
    file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(MODEL))
}

fn settings(arguments: &AuditArgs) -> Result<AuditSettings, Failure> {
    let limit = arguments.limit.map(|limit| positive("--limit", limit)).transpose()?;
    let least = arguments.min_time_constant.as_deref();
    let min_time_constant = least.map(|text| positive_seconds("--min-time-constant", text)).transpose()?;
    let steps = arguments.steps.iter().map(|step| positive("--steps", *step)).collect::<Result<_, _>>()?;
    Ok(AuditSettings { limit, min_time_constant, steps })
}
