//! Bodies of moderate numbers, described along turned axes and in other units.

use arbitrary::Unstructured;

use crate::laws::transform;

pub fn laws(bytes: &[u8]) {
    transform::check(&mut Unstructured::new(bytes));
}
