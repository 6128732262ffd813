use std::ops::Range;

use quasirigid::elements::{Field, Place};

/// Where the elements of a model stand in its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Spans {
    pub(super) carrier: ElementSpans,
    pub(super) points: Vec<ElementSpans>,
    pub(super) springs: Vec<ElementSpans>,
    pub(super) hinged: Vec<ElementSpans>,
    pub(super) ellipsoids: Vec<ElementSpans>,
    pub(super) surfaces: Vec<ElementSpans>,
    pub(super) parts: Vec<ElementSpans>,
    pub(super) connections: Vec<ElementSpans>,
    pub(super) rotors: Vec<ElementSpans>,
    pub(super) wheels: Vec<ElementSpans>,
    pub(super) cavities: Vec<ElementSpans>,
    pub(super) support: ElementSpans,
    pub(super) forces: Vec<ElementSpans>,
    pub(super) networks: Vec<NetworkSpans>,
}

/// Where a network stands, of which there are points and springs.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct NetworkSpans {
    pub(super) points: Range<usize>,
    pub(super) springs: Range<usize>,
    pub(super) table: ElementSpans,
}

/// Where an element and its values stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ElementSpans {
    /// Header of its table.
    pub(super) header: Range<usize>,
    /// Its values, by key.
    pub(super) values: Vec<(&'static str, Range<usize>)>,
}

impl Spans {
    /// The place of a value; that of its element where the file leaves the value out; the start of the file where it
    /// leaves the element out.
    pub(super) fn find(&self, place: Place, field: Field) -> Range<usize> {
        let element = match place {
            Place::Carrier => Some(&self.carrier),
            Place::Point(index) => {
                self.points.get(index).or_else(|| self.network(|network| network.points.contains(&index)))
            }
            Place::Spring(index) => {
                self.springs.get(index).or_else(|| self.network(|network| network.springs.contains(&index)))
            }
            Place::Hinged(index) => self.hinged.get(index),
            Place::Ellipsoid(index) => self.ellipsoids.get(index),
            Place::Surface(index) => self.surfaces.get(index),
            Place::Part(index) => self.parts.get(index),
            Place::Connection(index) => self.connections.get(index),
            Place::Rotor(index) => self.rotors.get(index),
            Place::Wheel(index) => self.wheels.get(index),
            Place::Cavity(index) => self.cavities.get(index),
            Place::Support => Some(&self.support),
            Place::Force(index) => self.forces.get(index),
        };
        let Some(element) = element else {
            return 0..0;
        };
        let key = field.to_string();
        let value = element.values.iter().find(|(known, _)| *known == key);
        value.map_or_else(|| element.header.clone(), |(_, span)| span.clone())
    }

    fn network(&self, owns: impl Fn(&NetworkSpans) -> bool) -> Option<&ElementSpans> {
        self.networks.iter().find(|network| owns(network)).map(|network| &network.table)
    }
}
