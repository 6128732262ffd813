//! Grids: evenly spaced numbers, numbers in geometric progression, and lists of any values.
//! The ends of a grid are met to the bit, whatever the rounding between them.

use super::measure::{Measures, measures};
use crate::model::KeyValue;
use crate::model::key::{Form, Key, Keys, Shape, array, integer, key, of};
use crate::model::table::Table;
use crate::model::value::Value;

/// First and last number, with units or without.
pub(super) const ENDS: Form = array(2, &Shape::Number).in_unit("any unit");
const COUNT_OF_GRID: Key = key("count", integer(2, MAX_POINTS as u64), "numbers of the grid");

pub(super) const LINEAR: Keys =
    Keys { known: &[key("linear", ENDS, "ends of a grid, evenly spaced"), COUNT_OF_GRID] };
pub(super) const GEOMETRIC: Keys =
    Keys { known: &[key("geometric", ENDS, "ends of a grid with a constant ratio"), COUNT_OF_GRID] };
pub(super) const LIST: Keys = Keys { known: &[key("list", of(Shape::List(&Shape::Value)), "any values")] };

/// Most points of one grid.
const MAX_POINTS: usize = 10_000_000;

/// Values that a key takes one after the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Grid {
    /// Numbers from one to another.
    Numbers {
        /// First and last number.
        ends: [f64; 2],
        /// Number of points, two or more.
        count: usize,
        /// Unit of the numbers; none for plain ones, in SI units.
        unit: Option<String>,
        /// Whether the ratio of neighbors is constant, and not their difference.
        geometric: bool,
    },
    /// Values as written.
    List(Vec<KeyValue>),
}

impl Grid {
    /// Number of points.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers { count, .. } => *count,
            Self::List(values) => values.len(),
        }
    }

    /// Whether the grid has no points; no grid of a study is so.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The unit of the numbers; none for plain ones, and for lists.
    #[must_use]
    pub fn unit(&self) -> Option<&str> {
        match self {
            Self::Numbers { unit, .. } => unit.as_deref(),
            Self::List(_) => None,
        }
    }

    /// The point with an index below the number of points: a number in the unit of the grid, or a value as written.
    #[must_use]
    pub fn point(&self, index: usize) -> KeyValue {
        match self {
            Self::List(values) => values[index].clone(),
            Self::Numbers { ends: [first, last], count, geometric, .. } => {
                let share = index as f64 / (count - 1) as f64;
                KeyValue::Number(match index {
                    0 => *first,
                    index if index == count - 1 => *last,
                    _ if *geometric => first * (last / first).powf(share),
                    _ => first + (last - first) * share,
                })
            }
        }
    }
}

/// Reads `{ linear = [first, last], count = n }` or the same with `geometric`.
pub(super) fn numbers(table: &Table<'_>, key: &'static str) -> Option<Grid> {
    let value = table.get(key)?;
    let count = table.read("count", "count = 11", |value| value.integer(2..=MAX_POINTS));
    let [first, last] = value.array("numbers", Some)?;
    let Measures { numbers, unit } = measures(&[first, last])?;
    let ends = [numbers[0], numbers[1]];
    let geometric = key == "geometric";
    if geometric && !(ends[0] * ends[1].signum() > 0.0 && ends[1] != 0.0) {
        return value.refuse(
            "a geometric progression needs two numbers of one sign, neither of them zero",
            "no ratio between these",
            "write both above zero, or take `linear`",
        );
    }
    if ends[0] == ends[1]
        || !(ends[1] - ends[0]).is_finite()
        || (geometric && !(ends[1] / ends[0]).is_finite())
    {
        return value.refuse(
            "a grid needs two different ends",
            "no range",
            "write the first and the last value of the grid",
        );
    }
    Some(Grid::Numbers { ends, count: count?, unit, geometric })
}

/// Reads `{ list = [..] }`.
pub(super) fn list(value: &Value<'_>) -> Option<Grid> {
    let values = value.list("a list of values", |item| item.given())?;
    if values.is_empty() {
        return value.refuse("the list is empty", "no values", "write at least one value");
    }
    Some(Grid::List(values))
}
