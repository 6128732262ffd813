use quasirigid_io::light_curve::read_light_curve;
use quasirigid_study::light_curve::{LightCurveSettings, Scale, View};
use quasirigid_study::report::light_curve_picture;

use super::curve_files::CurveFiles;
use super::open;
use crate::args::LightcurveArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Forms of files that only a light curve has.
#[derive(Clone, Copy)]
enum Form {
    Damit,
    Alcdef,
}

/// Gives the light curve of the rotating body.
pub fn lightcurve(arguments: &LightcurveArgs) -> Result<ExitStatus, Failure> {
    let LightcurveArgs { common, out, overwrite, .. } = arguments;
    let own = |ending: &str| match ending {
        "txt" => Some(Form::Damit),
        "alcdef" => Some(Form::Alcdef),
        _ => None,
    };
    let files = CurveFiles::at(out, *overwrite, own, |path| Failure::LightCurveEnding { path })?;
    let asked = settings(arguments)?;
    let study = open(common)?;
    let interrupt = Interrupt::listen()?;
    let mut terminal = Terminal::new(&interrupt, common.quiet);
    let curve = study.light_curve(&arguments.run.partial()?, &asked, &mut terminal)?;
    drop(terminal);
    interrupt.forget();
    let bytes = |form| match form {
        Form::Damit => Ok(curve.damit()?.into_bytes()),
        Form::Alcdef => Ok(curve.alcdef()?.into_bytes()),
    };
    let files = files.filled(&study, &curve.columns(), light_curve_picture, bytes)?;
    output::print_answer(common.json, || study.with_inputs(curve.json()), || curve.text())?;
    let in_place = files.write(&study, common.quiet)?;
    Ok(if in_place && curve.holds { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn settings(arguments: &LightcurveArgs) -> Result<LightCurveSettings, Failure> {
    let view = match (&arguments.view, arguments.sun, arguments.observer) {
        (Some(file), ..) => View::File(read_light_curve(file)?),
        (None, Some(sun), Some(observer)) => View::Fixed { sun, observer },
        _ => return Err(Failure::NoView),
    };
    Ok(LightCurveSettings {
        system: arguments.system,
        view,
        epoch: arguments.epoch,
        scattering: arguments.law,
        phase: arguments.phase,
        scale: Scale::given(arguments.albedo, arguments.absolute_magnitude),
        periods: arguments.periods,
    })
}
