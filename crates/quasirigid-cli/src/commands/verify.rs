use quasirigid_study::about_spin::{verification_json, verification_text};
use quasirigid_study::beyond;
use quasirigid_study::layout::paragraph;
use quasirigid_study::settings::{PartialSpinVerify, PartialVerify};
use quasirigid_study::verification::text;
use serde_json::json;

use super::{note_left_out, open};
use crate::args::{About, Verify};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Sets the full system against the reduced equations, and prints the differences with their order.
pub fn verify(arguments: &Verify) -> Result<ExitStatus, Failure> {
    match arguments.about {
        About::Rest if arguments.spin_manifold.is_given() || arguments.amplitude.is_some() => {
            Err(Failure::NotAboutSpin { with: "--about spin" })
        }
        About::Rest => about_rest(arguments),
        About::Spin => about_spin(arguments),
    }
}

fn about_spin(arguments: &Verify) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    let asked = PartialSpinVerify {
        spin_manifold: arguments.spin_manifold.partial(),
        verify: partial(arguments),
        amplitude: arguments.amplitude.map(f64::to_radians),
    };
    let interrupt = Interrupt::listen()?;
    let found = study.verify_about_spin(&asked, &mut Terminal::new(&interrupt, arguments.common.quiet))?;
    let Some(found) = found else {
        remark("the verification was interrupted; nothing was measured");
        return Ok(ExitStatus::CheckFailed);
    };
    let text = || verification_text(&study.model.name, study.model.kind, &found);
    output::print_answer(arguments.common.json, || study.with_inputs(verification_json(&found)), text)?;
    Ok(if found.reached() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn about_rest(arguments: &Verify) -> Result<ExitStatus, Failure> {
    let quiet = arguments.common.quiet;
    let study = open(&arguments.common)?;
    note_left_out(&study, study.initial()?.omega, &arguments.common);
    let plan = study.verification_plan(partial(arguments));
    let highest = plan.orders.iter().copied().max().unwrap_or_default();
    let beyond = beyond(&study.model.assembly, highest);
    if let Some(note) = beyond.as_ref().filter(|_| highest > study.order && !quiet) {
        remark(&format!("note: {note}"));
    }
    let interrupt = Interrupt::listen()?;
    let Some(record) = study.verify(&plan, &mut Terminal::new(&interrupt, quiet))? else {
        remark("the verification was interrupted; nothing was measured");
        return Ok(ExitStatus::CheckFailed);
    };
    if arguments.common.json {
        output::print(&format!("{:#}\n", study.with_inputs(json!(record))))?;
    } else {
        output::print(&text(&study.model.name, &record))?;
        if let Some(note) = beyond {
            output::print(&format!("{}\n", paragraph(&note, "", "  ")))?;
        }
    }
    Ok(if record.reached { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn partial(arguments: &Verify) -> PartialVerify {
    let Verify { revolutions, orders, halvings, .. } = arguments;
    PartialVerify { revolutions: *revolutions, orders: orders.clone(), halvings: *halvings }
}
