//! Keys that are varied: their sizes, their ranges, and what is known of them beforehand.

use quasirigid_io::estimate::{Amount, Limits};
use quasirigid_io::model::{KeyPath, KeyValue, Model, Template, WrittenNumber};

use super::InferSettings;
use crate::error::StudyError;
use crate::study::Study;

/// Key that is varied. Points of the search have its number over its scale.
pub(super) struct Key {
    pub number: WrittenNumber,
    /// Least and greatest number, in its unit.
    pub range: [f64; 2],
    /// Mean and standard deviation that are known beforehand, in its unit.
    pub prior: Option<[f64; 2]>,
}

impl Key {
    /// The key as the file has it.
    pub fn start(&self) -> f64 {
        self.number.number / self.number.scale
    }

    /// Range over the scale.
    pub fn bounds(&self) -> [f64; 2] {
        self.range.map(|end| end / self.number.scale)
    }

    /// Size by which changes of the key at a point are measured: of a number that may be zero no less than its scale.
    pub fn size(&self, x: f64) -> f64 {
        let [low, high] = self.range;
        if low >= 0.0 || high <= 0.0 { x.abs() } else { x.abs().max(1.0) }
    }

    /// Residual of what is known beforehand. (O18)
    pub fn prior(&self, x: f64) -> Option<f64> {
        self.prior.map(|[mean, sigma]| (x * self.number.scale - mean) / sigma)
    }
}

/// The text of the model with the order that was asked for.
pub(super) fn template(study: &Study) -> Result<Template, StudyError> {
    let template = Template::new(&study.model.source.text)?;
    if !study.order_given {
        return Ok(template);
    }
    let order = ("run.order".parse()?, KeyValue::Integer(study.order as i64));
    Ok(Template::new(&template.changed(&[order])?)?)
}

/// The keys that are asked for, with what is known of them.
pub(super) fn keys(
    study: &Study,
    template: &Template,
    asked: &InferSettings,
) -> Result<Vec<Key>, StudyError> {
    let mut keys = Vec::new();
    for path in &asked.vary {
        let number = template.number(path)?.ok_or_else(|| StudyError::NoNumber { key: path.to_string() })?;
        check(&number, &keys)?;
        let range = range_of_sign(study, template, &number);
        keys.push(Key { number, range, prior: None });
    }
    for prior in &asked.priors {
        let place = place(template, &keys, &prior.name, "prior")?;
        let number = &keys[place].number;
        let [mean, sigma] =
            [&prior.value, &prior.sigma].map(|amount| of_amount(study, template, number, amount));
        if keys[place].prior.replace([mean?, sigma?]).is_some() {
            return refuse(format!("{} has two priors", prior.name));
        }
    }
    for limits in &asked.ranges {
        let place = place(template, &keys, &limits.name, "range")?;
        keys[place].range = range(study, template, &keys[place], limits)?;
    }
    Ok(keys)
}

fn refuse<T>(problem: String) -> Result<T, StudyError> {
    Err(StudyError::Infer { problem })
}

/// Refuses keys that nothing scales, and keys named twice.
fn check(number: &WrittenNumber, before: &[Key]) -> Result<(), StudyError> {
    if number.scale == 0.0 {
        return refuse(format!(
            "{} is zero, and nothing beside it gives its scale; write a first guess in the model",
            number.path
        ));
    }
    if before.iter().any(|other| other.number.path == number.path) {
        return refuse(format!("{} is named twice", number.path));
    }
    Ok(())
}

/// The half line of a number that makes no model with the other sign; else all numbers.
fn range_of_sign(study: &Study, template: &Template, number: &WrittenNumber) -> [f64; 2] {
    let is_model = |value: f64| {
        let text = template.changed(&[(number.path.clone(), number.with(value))]).ok();
        text.and_then(|text| Study::new(Model::parse(&study.model.source.file, &text).ok()?, None).ok())
            .is_some()
    };
    let value = number.number;
    if value == 0.0 || is_model(-value) {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    if value > 0.0 { [0.0, f64::INFINITY] } else { [f64::NEG_INFINITY, 0.0] }
}

/// Place of the key that a statement names.
fn place(template: &Template, keys: &[Key], name: &str, what: &str) -> Result<usize, StudyError> {
    let path: KeyPath = name.parse()?;
    let number = template.number(&path)?.ok_or_else(|| StudyError::NoNumber { key: name.to_owned() })?;
    let found = keys.iter().position(|key| key.number.path == number.path);
    found.map_or_else(|| refuse(format!("{name} has a {what} and is not varied; add it to --vary")), Ok)
}

/// The number of an amount in the unit of a key.
fn of_amount(
    study: &Study,
    template: &Template,
    number: &WrittenNumber,
    amount: &Amount,
) -> Result<f64, StudyError> {
    if let (None, Some(unit)) = (&number.unit, &amount.unit) {
        // the reader of the key knows what it measures
        let one = Amount { number: 1.0, unit: amount.unit.clone() }.in_si();
        let same = one.map(|one| Amount { number: number.number / one, unit: amount.unit.clone() });
        let text = same.map(|same| (number.path.clone(), KeyValue::Text(same.to_string())));
        let text = text.map(|change| template.changed(&[change])).transpose()?;
        let read = text.map(|text| Model::parse(&study.model.source.file, &text));
        if !matches!(read, Some(Ok(_))) {
            return refuse(format!("{} is not measured in {unit}", number.path));
        }
        return Ok(amount.in_si().unwrap_or(f64::NAN));
    }
    amount.in_unit(number.unit.as_deref().unwrap_or_default()).map_or_else(
        || {
            let unit = number.unit.as_deref().unwrap_or_default();
            refuse(format!("{} is in {unit} in the model, and {amount} is something else", number.path))
        },
        Ok,
    )
}

/// Range of a key: the part of it that is given, within its sign.
fn range(study: &Study, template: &Template, key: &Key, limits: &Limits) -> Result<[f64; 2], StudyError> {
    let end = |amount: &Option<Amount>| {
        amount.as_ref().map(|amount| of_amount(study, template, &key.number, amount)).transpose()
    };
    let (low, high) = (end(&limits.low)?, end(&limits.high)?);
    let low = low.map_or(key.range[0], |low| low.max(key.range[0]));
    let high = high.map_or(key.range[1], |high| high.min(key.range[1]));
    if !(low < high) {
        return refuse(format!("the range of {} is empty: {low} to {high}", limits.name));
    }
    let start = key.number.number;
    if start < low || start > high {
        return refuse(format!(
            "{} is {start} in the model, outside of its range; write a first guess that lies in it",
            limits.name
        ));
    }
    Ok([low, high])
}
