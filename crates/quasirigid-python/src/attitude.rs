//! Attitude files, read and written.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use quasirigid_io::attitude::{
    self, AttitudeFormat, AttitudeHistory, Epoch, InertialFrame, Labels, TimeSystem, Unwritten, creation_time,
};
use quasirigid_io::disk::replace;

use crate::arguments::named;
use crate::columns::Columns;
use crate::failure::Failure;
use crate::series::Series;

/// Object, reference axes, epoch and time scale of a file, as texts.
type Told = (String, String, Option<String>, Option<&'static str>);

/// Reads an attitude file: its records, and what it says beside them.
#[pyfunction]
pub fn read_attitude(py: Python<'_>, file: PathBuf) -> PyResult<(Columns, Told)> {
    let history = py.detach(|| attitude::read_attitude(&file));
    let history = history.map_err(|error| Failure::File(error.to_string()))?;
    let AttitudeHistory { object, frame, epoch, time_system, .. } = &history;
    let told = (
        object.clone(),
        frame.clone(),
        epoch.map(|epoch| epoch.to_string()),
        time_system.map(TimeSystem::label),
    );
    Ok((columns(history), told))
}

/// The records as columns named as those of a history.
fn columns(history: AttitudeHistory) -> Columns {
    let AttitudeHistory { t, attitude, angular_velocity, .. } = history;
    let parts = ["qw", "qx", "qy", "qz"].into_iter().enumerate();
    let quaternions = parts
        .map(|(place, name)| Series::numbers(name, "1", attitude.iter().map(|four| four[place]).collect()));
    let axes = ["wx", "wy", "wz"].into_iter().enumerate().filter(|_| !angular_velocity.is_empty());
    let rates = axes.map(|(place, name)| {
        Series::numbers(name, "rad/s", angular_velocity.iter().map(|three| three[place]).collect())
    });
    let rates: Vec<Series> = rates.collect();
    let quaternions: Vec<Series> = quaternions.collect();
    Columns::new([vec![Series::numbers("t", "s", t)], rates, quaternions].concat())
}

/// Labels of a file that is written.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    object: String,
    epoch: Option<String>,
    time_system: String,
    frame: String,
    rates: bool,
}

/// Writes columns as an attitude file, over one of that name, with the setup file that belongs to it.
#[pyfunction]
pub fn write_attitude(
    py: Python<'_>,
    file: PathBuf,
    format: Option<String>,
    columns: &Columns,
    asked: Asked,
) -> PyResult<()> {
    let format = match named::<AttitudeFormat>(format.as_deref(), "format")? {
        Some(format) => format,
        None => AttitudeFormat::of_ending(&file).ok_or_else(|| {
            let endings = "aem, a, msopck and npz";
            Failure::Input(format!(
                "{}: the endings of attitude files are {endings}; give format",
                file.display()
            ))
        })?,
    };
    let labels = labels(asked)?;
    let columns = columns.numbers();
    Ok(py.detach(|| {
        let mut bytes = Cursor::new(Vec::new());
        format.write(&mut bytes, (&labels, None), (&columns, None)).map_err(refused)?;
        put(&file, bytes.get_ref())?;
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let mut beside = file.clone().into_os_string();
        beside.push(".setup");
        format
            .setup(&labels, &columns, &name)
            .map_or(Ok(()), |setup| put(Path::new(&beside), setup.as_bytes()))
    })?)
}

fn labels(asked: Asked) -> Result<Labels, Failure> {
    let Asked { object, epoch, time_system, frame, rates } = asked;
    let epoch = epoch.map(|text| {
        text.parse::<Epoch>().map_err(|problem| Failure::Input(format!("epoch = {text:?}: {problem}")))
    });
    Ok(Labels {
        object,
        epoch: epoch.transpose()?,
        time_system: named::<TimeSystem>(Some(&time_system), "time_system")?.unwrap_or_default(),
        frame: named::<InertialFrame>(Some(&frame), "frame")?.unwrap_or_default(),
        rates,
        created: creation_time(),
    })
}

fn refused(error: Unwritten) -> Failure {
    match error {
        Unwritten::Record(_) | Unwritten::File(_) => Failure::File(error.to_string()),
        other => Failure::Input(other.to_string()),
    }
}

/// Puts bytes into a file, whole; into a pipe or a device as they are.
fn put(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let written = match place.metadata() {
        Ok(there) if !there.is_file() => fs::write(&place, bytes),
        _ => replace(&place, |out| out.write_all(bytes)),
    };
    written.map_err(|cause| Failure::File(format!("cannot write {}: {cause}", path.display())))
}
