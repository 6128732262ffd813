use crate::math::sym3::Sym;
use crate::model::{Coordinate, Marker};

/// Mass, centre and inertia of the solid inside a surface, known exactly where cells fill it only nearly.
pub(crate) struct Exact<'a> {
    pub name: &'a str,
    pub mass: f64,
    pub center: [f64; 3],
    /// Inertia tensor about the centre of mass.
    pub inertia: Sym,
}

impl Exact<'_> {
    pub fn coordinates(&self, count: usize) -> Vec<Coordinate> {
        let name = |number: usize| format!("\"{}\" shape {number}", self.name);
        (1..=count).map(|number| Coordinate { name: name(number), unit: "m" }).collect()
    }

    /// The places farthest along each axis, both ways, under the names of the axes.
    pub fn markers(&self, places: Vec<Marker>) -> Vec<Marker> {
        let ends = (0..3).flat_map(|axis| [(axis, 1.0, '+'), (axis, -1.0, '-')]);
        let named = ends.filter_map(|(axis, sign, word)| {
            let along = |marker: &&Marker| sign * marker.position[axis];
            let farthest = places.iter().max_by(|a, b| along(a).total_cmp(&along(b)))?;
            let name = format!("{} along {word}{}", self.name, ['x', 'y', 'z'][axis]);
            Some(Marker { name, ..farthest.clone() })
        });
        named.collect()
    }
}
