use quasirigid_elements::PrescribedMotion;
use quasirigid_math::expression::Expression;

use super::key::{Form, Keys, Shape, any, key, of};
use super::value::Value;
use crate::units::Dimension;

/// Variables of a formula, in the order of its arguments, and their meaning.
pub(super) struct Variables {
    pub(super) names: &'static [&'static str],
    pub(super) meaning: &'static str,
}

/// The time.
pub(super) const TIME: Variables = Variables { names: &["t"], meaning: "t (s)" };
/// Position and velocity of the place of a force, time, angular velocity and attitude. (F9)
pub(super) const PLACE: Variables = Variables {
    names: &["x", "y", "z", "vx", "vy", "vz", "t", "wx", "wy", "wz", "qw", "qx", "qy", "qz"],
    meaning: "x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz",
};

/// Number, or a formula of the time in a table.
pub(super) const PRESCRIBED: Form = any(&[Shape::Number, Shape::Table(&LAW)]);
/// Keys of the formula of a quantity over time.
pub(super) const LAW: Keys = Keys { known: &[key("formula", of(Shape::Formula), "in `t`")] };

/// Reads a number, or a formula of the time, of what a drive prescribes; `title` is the key in messages.
pub(super) fn prescribed(
    value: &Value<'_>,
    title: &'static str,
    dimension: Dimension,
) -> Option<PrescribedMotion> {
    if !value.is_table() {
        return value.quantity(dimension).map(PrescribedMotion::Constant);
    }
    let table = value.table(title, &LAW)?;
    let text = table.required("formula", "{ formula = \"0.1 * t\" }")?;
    formula(&text, &TIME, dimension).map(PrescribedMotion::Law)
}

/// Reads three formulas, or numbers in their place.
pub(super) fn formulas(
    value: &Value<'_>,
    variables: &Variables,
    dimension: Dimension,
) -> Option<[Expression; 3]> {
    value.array("formulas", |item| formula(&item, variables, dimension))
}

/// Reads a formula, or a number in its place.
pub(super) fn formula(value: &Value<'_>, variables: &Variables, dimension: Dimension) -> Option<Expression> {
    let help =
        format!("write a formula in {} that gives {}, or a number", variables.meaning, dimension.unit());
    let text = match value.words() {
        Some(text) => text.to_owned(),
        None if value.is_number() => format!("{:?}", value.quantity(Dimension::NUMBER)?),
        None => return value.mismatch("a formula", &help),
    };
    match Expression::parse(&text, variables.names) {
        Ok(formula) => Some(formula),
        Err(error) => {
            let message = format!("`{}`: {}", value.key(), error.message);
            value.refuse_at(value.span_of(error.span), message, "in this formula", help)
        }
    }
}
