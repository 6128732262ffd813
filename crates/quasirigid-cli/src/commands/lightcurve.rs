use std::path::Path;

use quasirigid_io::light_curve::read_light_curve;
use quasirigid_io::model::Named;
use quasirigid_io::record::TableFormat;
use quasirigid_study::Study;
use quasirigid_study::light_curve::{LightCurve, LightCurveSettings, Scale, View};
use quasirigid_study::report::{light_curve_picture, png};
use serde_json::json;

use super::{PIXELS, inputs_beside, open};
use crate::args::LightcurveArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Files that a light curve is written to.
#[derive(Clone, Copy)]
enum Written {
    Table(TableFormat),
    Svg,
    Png,
    Damit,
    Alcdef,
}

/// Gives the light curve of the rotating body.
pub fn lightcurve(arguments: &LightcurveArgs) -> Result<ExitStatus, Failure> {
    let LightcurveArgs { common, out, overwrite, .. } = arguments;
    let form = |path| {
        output::check_file(path, *overwrite)?;
        written(path)
    };
    let forms = out.iter().map(|path| form(path)).collect::<Result<Vec<_>, Failure>>()?;
    let asked = settings(arguments)?;
    let study = open(common)?;
    let interrupt = Interrupt::listen()?;
    let mut terminal = Terminal::new(&interrupt, common.quiet);
    let curve = study.light_curve(&arguments.run.partial()?, &asked, &mut terminal)?;
    drop(terminal);
    interrupt.forget();
    let files = out.iter().zip(forms).map(|(path, form)| Ok((path, form, bytes(&study, &curve, form)?)));
    let files = files.collect::<Result<Vec<_>, Failure>>()?;
    output::print_answer(common.json, || study.with_inputs(curve.json()), || curve.text())?;
    let mut in_place = true;
    for (path, form, bytes) in files {
        let placed = output::to_file(path, *overwrite, |out| out.write_all(&bytes))?;
        if !common.quiet && !output::is_stdout(path) {
            remark(&format!("wrote {}", placed.path.display()));
        }
        in_place &= placed.told(path);
        if matches!(form, Written::Table(TableFormat::Csv)) {
            in_place &= inputs_beside(&study.inputs(), &placed.path, *overwrite)?;
        }
    }
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

/// Form of a file, by its ending.
fn written(path: &Path) -> Result<Written, Failure> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let ending = ending.as_ref().and_then(|ending| ending.to_str()).unwrap_or_default();
    let table = TableFormat::VALUES.iter().find(|(name, ..)| *name == ending);
    match (table, ending) {
        (Some((_, format, _)), _) => Ok(Written::Table(*format)),
        (None, "svg") => Ok(Written::Svg),
        (None, "png") => Ok(Written::Png),
        (None, "txt") => Ok(Written::Damit),
        (None, "alcdef") => Ok(Written::Alcdef),
        _ => Err(Failure::LightCurveEnding { path: path.to_owned() }),
    }
}

fn bytes(study: &Study, curve: &LightCurve, form: Written) -> Result<Vec<u8>, Failure> {
    let svg = || light_curve_picture(&curve.columns()).unwrap_or_default();
    Ok(match form {
        Written::Table(format) => format.bytes(&curve.columns(), Some(&json!(study.inputs()).to_string()))?,
        Written::Svg => svg().into_bytes(),
        Written::Png => png(&svg(), PIXELS)?,
        Written::Damit => curve.damit()?.into_bytes(),
        Written::Alcdef => curve.alcdef()?.into_bytes(),
    })
}
