//! Controllers as elements: their names found on a body. (Y2), (Y4), (Y8), (Y12)

use crate::Assembly;
use crate::element::Element;
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::kinds::wheel::{Wheel, WheelSpeed};
use crate::model::FlexibleBody;
use crate::model::Marker;
use crate::model::control::{Actuator, ControlLaw, ControlProblem, ControlledWheel, Controller, Controls};
use crate::model::force::{ForceLaw, SunPath, Trajectory};
use crate::number;

/// Controller that names places, internal coordinates and wheels.
pub type NamedController = Controller<String, String, String>;

/// Names listed where one is not there.
const LISTED: usize = 8;

impl Element for NamedController {
    fn check(&self, id: ElementId, body: &Assembly) -> Vec<ElementError> {
        body.problem_of(self).map(|problem| refused(id, problem)).into_iter().collect()
    }
}

fn refused(id: ElementId, problem: ControlProblem) -> ElementError {
    at(id, Field::new(problem.key()))(Problem::Control(problem))
}

impl Assembly {
    /// Controllers with what they name on the body of this assembly, and rods.
    pub(crate) fn controls_on(&self, body: &FlexibleBody) -> Result<Controls, ElementError> {
        let rods = self.lawful_rods()?;
        let field = self.magnetic_field.filter(|_| !rods.is_empty());
        let mut controls = Controls { rods, field, ..Controls::default() };
        for (index, controller) in self.controllers.iter().enumerate() {
            let id = ElementKind::Controller.at(index);
            if let Some(problem) = self.problem_of(controller) {
                return Err(refused(id, problem));
            }
            if controller.is_magnetic() {
                controls.field = self.magnetic_field;
            }
            if controller.is_relative_to_orbit() {
                controls.orbit = Some(self.only_orbit().map_err(|problem| refused(id, problem))?);
            }
            if controller.sees_the_sun() {
                controls.sun = Some(self.sun().map_err(|problem| refused(id, problem))?);
            }
            let key = if matches!(controller.law, ControlLaw::Formulas(_)) { "motors" } else { "outputs" };
            for output in &controller.outputs {
                if let Actuator::Wheel { wheel } = &output.to {
                    let known = self.controlled((key, wheel), &mut controls.wheels);
                    known.map_err(|problem| refused(id, problem))?;
                }
            }
            let wheels = std::cell::RefCell::new(std::mem::take(&mut controls.wheels));
            let bound = controller.try_map(
                |place| marker(body, place).cloned(),
                |coordinate| numbered(body, coordinate),
                |wheel| self.controlled(("inputs", wheel), &mut wheels.borrow_mut()),
            );
            controls.controllers.push(bound.map_err(|problem| refused(id, problem))?);
            controls.wheels = wheels.into_inner();
        }
        Ok(controls)
    }

    /// What is wrong with a controller on this body, as far as it names nothing.
    fn problem_of(&self, controller: &NamedController) -> Option<ControlProblem> {
        let blind = controller.is_magnetic() && self.magnetic_field.is_none();
        let orbit = || controller.is_relative_to_orbit().then(|| self.only_orbit().err()).flatten();
        let sun = || controller.sees_the_sun().then(|| self.sun().err()).flatten();
        controller.problem().or(blind.then_some(ControlProblem::NoField)).or_else(orbit).or_else(sun)
    }

    /// The orbit that attraction and magnetic fields have in common; that about the Sun where there is no other. (Y12)
    fn only_orbit(&self) -> Result<Trajectory, ControlProblem> {
        let laws = || self.forces.iter().map(|force| force.law.timed().0);
        let attracted = laws().filter(|law| matches!(law, ForceLaw::CentralGravity { .. }));
        let fields = laws().filter_map(ForceLaw::magnetic_field).chain(&self.magnetic_field);
        let through = fields.filter_map(|field| field.orbit().copied().map(Trajectory::from));
        let mut known: Vec<Trajectory> = Vec::new();
        for path in attracted.filter_map(|law| law.trajectory().cloned()).chain(through) {
            if !known.contains(&path) {
                known.push(path);
            }
        }
        if known.is_empty() {
            known.extend(laws().find_map(|law| law.trajectory().cloned()));
        }
        match known.len() {
            0 => Err(ControlProblem::NoOrbit),
            1 => Ok(known.swap_remove(0)),
            count => Err(ControlProblem::SeveralOrbits { count }),
        }
    }

    /// Where the Sun stands: that of the first force of sunlight. (Y12)
    fn sun(&self) -> Result<SunPath, ControlProblem> {
        let mut suns = self.forces.iter().filter_map(|force| match force.law.timed().0 {
            ForceLaw::Sunlight { sun, .. } => Some(sun.clone()),
            _ => None,
        });
        suns.next().ok_or(ControlProblem::NoSun)
    }

    /// Index of a wheel, named at a key, among those that are controlled, to which it is added.
    fn controlled(
        &self,
        (key, name): (&'static str, &str),
        wheels: &mut Vec<ControlledWheel>,
    ) -> Result<usize, ControlProblem> {
        if let Some(index) = wheels.iter().position(|wheel| wheel.name == name) {
            return Ok(index);
        }
        let wheel = self.wheels.iter().find(|wheel| wheel.name == name);
        let unknown =
            || unknown((key, "wheel of constant speed"), name, self.wheels.iter().map(|wheel| &*wheel.name));
        let Some(Wheel { axis, speed: WheelSpeed::Constant { angular_momentum }, .. }) = wheel else {
            return Err(unknown());
        };
        let axis = number::unit(*axis).map_err(|_| unknown())?.into();
        wheels.push(ControlledWheel { name: name.to_owned(), axis, angular_momentum: *angular_momentum });
        Ok(wheels.len() - 1)
    }
}

fn marker<'a>(body: &'a FlexibleBody, name: &str) -> Result<&'a Marker, ControlProblem> {
    let mut named = body.markers().iter().filter(|marker| plain(&marker.name) == plain(name));
    match (named.next(), named.next()) {
        (Some(marker), None) => Ok(marker),
        _ => Err(unknown(
            ("inputs", "node of this name alone,"),
            name,
            body.markers().iter().map(|marker| &*marker.name),
        )),
    }
}

fn numbered(body: &FlexibleBody, name: &str) -> Result<usize, ControlProblem> {
    let coordinates = body.coordinates();
    let found = coordinates.iter().position(|coordinate| plain(&coordinate.name) == plain(name));
    found.ok_or_else(|| {
        unknown(("inputs", "coordinate"), name, coordinates.iter().map(|coordinate| &*coordinate.name))
    })
}

/// Name without quotes.
fn plain(name: &str) -> String {
    name.replace('"', "")
}

fn unknown<'n>(
    (key, what): (&'static str, &'static str),
    name: &str,
    known: impl Iterator<Item = &'n str>,
) -> ControlProblem {
    let known = known.take(LISTED).collect::<Vec<_>>().join(", ");
    ControlProblem::Unknown { key, what, name: name.to_owned(), known }
}
