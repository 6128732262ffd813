//! Names of inputs, outputs and states, and their units.

use std::ops::Range;

use quasirigid::model::Marker;
use quasirigid::modes::{LinearInput, LinearOutput, LinearState};
use quasirigid_math::vec3::{add, norm, scale};

use super::object::Channel;
use crate::error::StudyError;
use crate::study::Study;
use crate::words::plain;

pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

impl Study {
    pub(super) fn named(&self, state: LinearState, inputs: &[String]) -> Channel {
        let coordinates = self.body.coordinates();
        let rate = |j: usize| if coordinates[j].unit == "m" { "m/s" } else { "rad/s" };
        let (name, unit) = match state {
            LinearState::Attitude(axis) => (format!("attitude.{}", AXES[axis]), "rad"),
            LinearState::Coordinate(j) => {
                (format!("coordinate.{}", plain(&coordinates[j].name)), coordinates[j].unit)
            }
            LinearState::Rate(axis) => (format!("rate.{}", AXES[axis]), "rad/s"),
            LinearState::Speed(j) => (format!("speed.{}", plain(&coordinates[j].name)), rate(j)),
            LinearState::Velocity(axis) => (format!("velocity.{}", AXES[axis]), "m/s"),
            LinearState::Lag { material, element, direction } => {
                (format!("lag.{}.{}.{}", material + 1, element + 1, direction + 1), "J^1/2")
            }
            LinearState::Wheel(input) => (inputs[input].replace(".torque", ".momentum"), "N m s"),
            LinearState::Truncated(number) => truncated(number),
        };
        Channel { name, unit: unit.to_owned() }
    }

    pub(super) fn input(&self, name: &str) -> Result<LinearInput, StudyError> {
        let unknown = || {
            no_channel(
                name,
                "torque.x, force.x, force.NODE.x, wheel.NAME.torque, hinge.NAME.torque or acceleration.x",
            )
        };
        if let Some(rotor) = name.strip_prefix("wheel.").and_then(|rest| rest.strip_suffix(".torque")) {
            return match self.wheel(rotor) {
                Some(axis) => Ok(LinearInput::Wheel { axis }),
                None => Ok(LinearInput::Motor { coordinate: self.rotor(name, rotor)? }),
            };
        }
        if let Some(hinge) = name.strip_prefix("hinge.").and_then(|rest| rest.strip_suffix(".torque")) {
            return Ok(LinearInput::Motor { coordinate: self.hinge(name, hinge)? });
        }
        let (path, axis) = with_axis(name).ok_or_else(unknown)?;
        match path.split_once('.') {
            None if path == "acceleration" => Ok(LinearInput::Acceleration { axis }),
            None if path == "torque" => Ok(LinearInput::Torque { axis }),
            None if path == "force" => Ok(LinearInput::Force { at: self.carrier(name)?, axis }),
            Some(("force", node)) => Ok(LinearInput::Force { at: self.place(name, node)?, axis }),
            _ => Err(unknown()),
        }
    }

    pub(super) fn output(&self, name: &str, inputs: &[String]) -> Result<LinearOutput, StudyError> {
        let unknown = || {
            no_channel(
                name,
                "rate.x, attitude.x, momentum.x, acceleration.NODE.x, displacement.NODE.x, wheel.NAME.speed, wheel.NAME.momentum, hinge.NAME.angle, hinge.NAME.rate, cavity.NAME.momentum.x or coordinate.NAME",
            )
        };
        if let Some(rotor) = name.strip_prefix("wheel.").and_then(|rest| rest.strip_suffix(".speed")) {
            return Ok(LinearOutput::Speed { coordinate: self.rotor(name, rotor)? });
        }
        if let Some(wheel) = name.strip_prefix("wheel.").and_then(|rest| rest.strip_suffix(".momentum")) {
            let torque = format!("wheel.{wheel}.torque");
            let input = inputs.iter().position(|input| *input == torque && self.wheel(wheel).is_some());
            let expected = format!("a [[wheel]] whose torque, {torque}, is an input");
            return input
                .map(|input| LinearOutput::Wheel { input })
                .ok_or_else(|| no_channel(name, &expected));
        }
        if let Some((hinge, what)) = name.strip_prefix("hinge.").and_then(|rest| rest.rsplit_once('.')) {
            return match what {
                "angle" => Ok(LinearOutput::Coordinate { coordinate: self.hinge(name, hinge)? }),
                "rate" => Ok(LinearOutput::Speed { coordinate: self.hinge(name, hinge)? }),
                _ => Err(no_channel(name, "hinge.NAME.angle or hinge.NAME.rate")),
            };
        }
        if let Some(wanted) = name.strip_prefix("coordinate.") {
            let elastic = self.body.coordinates().iter().take(self.body.elastic());
            let found = elastic.enumerate().find(|(_, coordinate)| plain(&coordinate.name) == plain(wanted));
            let (coordinate, _) =
                found.ok_or_else(|| no_channel(name, "a coordinate that `quasirigid modes` lists"))?;
            return Ok(LinearOutput::Coordinate { coordinate });
        }
        let (path, axis) = with_axis(name).ok_or_else(unknown)?;
        match path.split_once('.') {
            None if path == "rate" => Ok(LinearOutput::Rate { axis }),
            None if path == "attitude" => Ok(LinearOutput::Attitude { axis }),
            None if path == "momentum" => Ok(LinearOutput::Momentum { axis }),
            None if path == "acceleration" => {
                Ok(LinearOutput::Acceleration { at: self.carrier(name)?, axis })
            }
            Some(("acceleration", node)) => {
                Ok(LinearOutput::Acceleration { at: self.place(name, node)?, axis })
            }
            Some(("displacement", node)) => {
                Ok(LinearOutput::Displacement { at: self.place(name, node)?, axis })
            }
            Some(("cavity", rest)) => {
                let cavity = rest.strip_suffix(".momentum").ok_or_else(unknown)?;
                Ok(LinearOutput::Internal { coordinates: self.liquid(name, cavity)?, axis })
            }
            _ => Err(unknown()),
        }
    }

    /// Coordinate of an axis of a hinge: `NAME`, or `NAME.1` to `NAME.3` of several.
    fn hinge(&self, channel: &str, hinge: &str) -> Result<usize, StudyError> {
        let coordinates = self.body.coordinates();
        let axes = |name: &str| {
            let own =
                |j: &usize| coordinates[*j].part() == name && coordinates[*j].name.contains(" about axis ");
            (0..self.body.elastic()).filter(own).collect::<Vec<_>>()
        };
        let numbered =
            hinge.rsplit_once('.').and_then(|(name, number)| Some((name, number.parse::<usize>().ok()?)));
        let found = match (&axes(hinge)[..], numbered) {
            ([only], _) => Some(*only),
            ([], Some((name, number))) => {
                number.checked_sub(1).and_then(|place| axes(name).get(place).copied())
            }
            _ => None,
        };
        let names: Vec<_> = self
            .model
            .assembly
            .hinged
            .iter()
            .map(|hinged| named_axes(&hinged.name, hinged.axes.len()))
            .collect();
        let expected = if names.is_empty() {
            "a channel of another kind, as the model has no [[hinged]]".to_owned()
        } else {
            format!("the name of a [[hinged]], and of several axes the number of one: {}", names.join(", "))
        };
        found.ok_or_else(|| no_channel(channel, &expected))
    }

    /// Coordinates of the liquid in a cavity.
    fn liquid(&self, channel: &str, cavity: &str) -> Result<Range<usize>, StudyError> {
        let coordinates = self.body.coordinates();
        let known = self.model.assembly.cavities.iter().any(|own| plain(&own.name) == plain(cavity));
        let own = |j: &usize| plain(coordinates[*j].part()) == plain(cavity);
        let all: Vec<usize> = self.body.cyclic().filter(own).collect();
        match (known, all.first(), all.last()) {
            (true, Some(first), Some(last)) => Ok(*first..last + 1),
            (true, ..) => Err(no_channel(
                channel,
                "a [[cavity]] whose liquid has relaxations of its own, by modes = 1 or more",
            )),
            _ => Err(no_channel(channel, "the name of a [[cavity]]")),
        }
    }

    /// Centre of mass of the carrier.
    fn carrier(&self, channel: &str) -> Result<Marker, StudyError> {
        let Some(carrier) = &self.model.assembly.carrier else {
            return Err(no_channel(channel, "the name of a node, as the body has no carrier"));
        };
        let position = add(carrier.center_of_mass, scale(-1.0, self.body.pole()));
        Ok(Marker {
            name: "carrier".into(),
            position,
            shapes: Vec::new(),
            rotations: Vec::new(),
            curvature: Vec::new(),
            carried: None,
        })
    }

    fn place(&self, channel: &str, node: &str) -> Result<Marker, StudyError> {
        let mut named = self.body.markers().iter().filter(|marker| plain(&marker.name) == plain(node));
        match (named.next(), named.next()) {
            (Some(marker), None) => Ok(marker.clone()),
            (Some(_), Some(_)) => Err(no_channel(channel, "a node whose name no other has")),
            (None, _) => {
                let some: Vec<_> =
                    self.body.markers().iter().take(LISTED).map(|marker| &*marker.name).collect();
                Err(no_channel(channel, &format!("one of the nodes, such as {}", some.join(", "))))
            }
        }
    }

    /// Axis of a momentum wheel, a unit vector.
    fn wheel(&self, name: &str) -> Option<[f64; 3]> {
        let wheel = self.model.assembly.wheels.iter().find(|wheel| plain(&wheel.name) == plain(name))?;
        Some(scale(norm(wheel.axis).recip(), wheel.axis))
    }

    /// Coordinate of a rotor.
    fn rotor(&self, channel: &str, name: &str) -> Result<usize, StudyError> {
        let mut cyclic = self.body.cyclic();
        let found = cyclic.find(|j| plain(&self.body.coordinates()[*j].name) == plain(name));
        found.ok_or_else(|| {
            no_channel(
                channel,
                "the name of a [[rotor]] about one axis, or for a torque that of a [[wheel]], whose angular momentum is wheel.NAME.momentum",
            )
        })
    }

    pub(super) fn unit_of_output(&self, output: &LinearOutput) -> &'static str {
        let coordinates = self.body.coordinates();
        match output {
            LinearOutput::Rate { .. } => "rad/s",
            LinearOutput::Attitude { .. } => "rad",
            LinearOutput::Momentum { .. } | LinearOutput::Internal { .. } | LinearOutput::Wheel { .. } => {
                "N m s"
            }
            LinearOutput::Displacement { .. } => "m",
            LinearOutput::Acceleration { .. } => "m/s^2",
            LinearOutput::Coordinate { coordinate } => coordinates[*coordinate].unit,
            LinearOutput::Speed { coordinate } if coordinates[*coordinate].unit == "m" => "m/s",
            LinearOutput::Speed { .. } => "rad/s",
        }
    }
}

/// Nodes listed where one asked for is not there.
const LISTED: usize = 6;

pub(super) fn unit_of_input(input: &LinearInput) -> &'static str {
    match input {
        LinearInput::Torque { .. } | LinearInput::Motor { .. } | LinearInput::Wheel { .. } => "N m",
        LinearInput::Force { .. } => "N",
        LinearInput::Acceleration { .. } => "m/s^2",
    }
}

/// Name and unit of a state of a truncated model, from 0.
pub(super) fn truncated(number: usize) -> (String, &'static str) {
    (format!("truncated.{}", number + 1), "1")
}

/// Names of the axes of a hinge.
fn named_axes(name: &str, count: usize) -> String {
    if count == 1 { name.to_owned() } else { format!("{name}.1 to {name}.{count}") }
}

/// A path before an axis.
fn with_axis(name: &str) -> Option<(&str, usize)> {
    let (path, axis) = name.rsplit_once('.')?;
    Some((path, AXES.iter().position(|known| *known == axis)?))
}

pub(super) fn no_channel(name: &str, expected: &str) -> StudyError {
    StudyError::NoChannel { name: name.into(), expected: expected.into() }
}
