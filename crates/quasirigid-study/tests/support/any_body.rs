//! Random bodies as texts of models, and the same bodies in other axes, in other units, and with their parts in another order.

use std::fmt::Write;

use quasirigid_math::random::Random;
use quasirigid_math::rotation::{normalized, to_inertial};
use quasirigid_math::vec3::{cross, norm, scale};

type Vector = [f64; 3];
type Matrix = [Vector; 3];

/// Point on a spring to the carrier.
#[derive(Clone)]
struct Point {
    name: String,
    mass: f64,
    place: Vector,
    stiffness: Matrix,
    damping: Matrix,
}

/// Rod on a hinge with an axis.
#[derive(Clone)]
struct Hinged {
    mass: f64,
    center: Vector,
    inertia: Matrix,
    hinge: Vector,
    axis: Vector,
    stiffness: f64,
    damping: f64,
}

/// Flywheel on friction, or momentum wheel of an angular momentum.
#[derive(Clone)]
struct Turning {
    name: String,
    axis: Vector,
    values: [f64; 2],
}

/// Ball of liquid, with density and kinematic viscosity.
#[derive(Clone)]
struct Ball {
    radius: f64,
    center: Vector,
    values: [f64; 2],
}

/// A random body with a start.
#[derive(Clone)]
pub struct AnyBody {
    /// Kinds of its parts.
    pub kinds: Vec<&'static str>,
    /// Relative difference of two moments of the carrier; zero for equal ones, one for moments apart.
    pub apart: f64,
    mass: f64,
    inertia: Matrix,
    spin: Vector,
    points: Vec<Point>,
    hinged: Vec<Hinged>,
    rotors: Vec<Turning>,
    wheels: Vec<Turning>,
    balls: Vec<Ball>,
}

/// A body told otherwise, with its unit of time in that of the first.
pub struct Told {
    /// Axes, units, or order.
    pub how: &'static str,
    /// The model.
    pub model: String,
    /// Unit of time.
    pub time: f64,
}

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

fn decades(random: &mut Random, low: f64, high: f64) -> f64 {
    10_f64.powf(between(random, low, high))
}

fn pick<T: Copy>(random: &mut Random, list: &[T]) -> T {
    list[(random.bits() % list.len() as u64) as usize]
}

fn any_vector(random: &mut Random) -> Vector {
    [0; 3].map(|_| between(random, -1.0, 1.0))
}

fn any_axis(random: &mut Random) -> Vector {
    let mut axis = [0.0; 3];
    axis[(random.bits() % 3) as usize] = 1.0;
    axis
}

fn diagonal(entries: Vector) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { entries[i] } else { 0.0 }))
}

/// `R A Rᵀ`, symmetric to the last digit.
fn turned(A: Matrix, turn: &impl Fn(Vector) -> Vector) -> Matrix {
    let rows = A.map(turn);
    let columns: Matrix = std::array::from_fn(|j| turn(std::array::from_fn(|i| rows[i][j])));
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (columns[j][i] + columns[i][j])))
}

const CARRIERS: [Vector; 5] =
    [[2.0, 4.0, 4.0], [4.0, 4.0, 6.0], [4.0, 4.0, 4.0], [2.0, 4.0, 5.0], [3.0, 4.5, 5.5]];
const KINDS: [&str; 9] =
    ["mass", "pair", "ring", "stiff", "hinge", "rotor", "tilted rotor", "liquid", "tilted mass"];

impl AnyBody {
    /// A body with one or two parts, in every fourth with a momentum wheel, whose carrier has equal, nearly equal or other moments.
    pub fn draw(random: &mut Random) -> Self {
        let which = (random.bits() % 5) as usize;
        let alike = which < 3;
        let near = if random.unit() < 0.5 { 0.0 } else { decades(random, -13.0, -3.0) };
        let apart = if alike { near } else { 1.0 };
        let mass = between(random, 10.0, 80.0);
        let size = 0.1 * mass * between(random, 0.5, 2.0);
        let mut moments = CARRIERS[which];
        if alike {
            moments = [0, 1, 2].map(|k| moments[k] * (1.0 + near * [0.3, -0.5, 1.0][k]));
        }
        moments.rotate_left((random.bits() % 3) as usize);
        let rate = decades(random, -2.0, 1.0);
        let direction = match random.bits() % 4 {
            0 => [0.1, 0.05, 1.0],
            1 => any_axis(random),
            _ => any_vector(random),
        };
        let mut body = Self {
            kinds: Vec::new(),
            apart,
            mass,
            inertia: diagonal(moments.map(|moment| size * moment)),
            spin: scale(rate / norm(direction), direction),
            points: Vec::new(),
            hinged: Vec::new(),
            rotors: Vec::new(),
            wheels: Vec::new(),
            balls: Vec::new(),
        };
        for _ in 0..pick(random, &[1, 1, 2]) {
            let kind = pick(random, &KINDS);
            body.part(kind, size, rate, random);
        }
        if random.unit() < 0.25 {
            let axis = if random.unit() < 0.6 { any_axis(random) } else { any_vector(random) };
            let momentum = 5.0 * size * rate * decades(random, -1.5, 0.5);
            body.wheels.push(Turning { name: "w".into(), axis, values: [momentum, 0.0] });
            body.kinds.push("wheel");
        }
        body
    }

    /// Adds parts of a kind, of a size and a spin of the body.
    fn part(&mut self, kind: &'static str, size: f64, rate: f64, random: &mut Random) {
        let axis = any_axis(random);
        let frequency = rate * between(random, 12.0, 40.0);
        let zeta = decades(random, -2.5, -0.5);
        let mut point = |place: Vector, share: Vector| {
            let mass = 0.01 * self.mass;
            let stiffness = share.map(|share| mass * frequency * frequency * share);
            let damping = share.map(|share| mass * frequency * zeta * share);
            let name = format!("p{}", self.points.len());
            let [stiffness, damping] = [stiffness, damping].map(diagonal);
            self.points.push(Point { name, mass, place, stiffness, damping });
        };
        match kind {
            "mass" => point(scale(0.5, axis), [1.0; 3]),
            "tilted mass" => point(scale(0.6, any_vector(random)), [1.0; 3]),
            "stiff" => point(scale(0.5, axis), axis.map(|entry| 1.0 + entry)),
            "pair" => [1.0, -1.0].into_iter().for_each(|side| point(scale(0.6 * side, axis), [1.0; 3])),
            "ring" => {
                let first = [axis[2], axis[0], axis[1]];
                let second = cross(axis, first);
                for side in [first, second] {
                    [0.5, -0.5].into_iter().for_each(|radius| point(scale(radius, side), [1.0; 3]));
                }
            }
            "hinge" => {
                let mass = 0.01 * self.mass;
                let stiffness = mass * 0.16 * frequency * frequency;
                self.hinged.push(Hinged {
                    mass,
                    center: scale(0.7, axis),
                    inertia: diagonal([mass * 0.16 / 12.0; 3]),
                    hinge: scale(0.5, axis),
                    axis: [axis[2], axis[0], axis[1]],
                    stiffness,
                    damping: stiffness * zeta / (20.0 * rate),
                });
            }
            "rotor" | "tilted rotor" => {
                let along = if kind == "rotor" { axis } else { any_vector(random) };
                let values = [0.1 * size, 0.1 * size * rate * decades(random, -1.0, 1.5)];
                let name = format!("r{}", self.rotors.len());
                self.rotors.push(Turning { name, axis: along, values });
            }
            _ => {
                let center = if random.unit() < 0.5 { [0.0; 3] } else { scale(0.3, any_vector(random)) };
                let density = 0.005 * self.mass / (4.0 / 3.0 * std::f64::consts::PI * 0.008);
                let values = [density, 0.04 * rate * decades(random, 0.0, 2.0)];
                self.balls.push(Ball { radius: 0.2, center, values });
            }
        }
        self.kinds.push(kind);
    }

    /// The model, then those of the same body in turned and in permuted axes, in other units, and with its parts in another order.
    pub fn told(&self, random: &mut Random) -> [Told; 5] {
        let attitude = normalized([0; 4].map(|_| between(random, -1.0, 1.0)));
        let units = [0; 3].map(|_| decades(random, -3.0, 3.0));
        let told = |how, body: Self, time| Told { how, model: body.model(), time };
        [
            told("as it is", self.clone(), 1.0),
            told("turned", self.turned(|vector| to_inertial(attitude, vector)), 1.0),
            told("permuted", self.turned(|[x, y, z]| [z, x, y]), 1.0),
            told("in other units", self.rescaled(units), units[2]),
            told("in another order", self.reordered(), 1.0),
        ]
    }

    fn turned(&self, turn: impl Fn(Vector) -> Vector) -> Self {
        let mut body = self.clone();
        body.inertia = turned(body.inertia, &turn);
        body.spin = turn(body.spin);
        for point in &mut body.points {
            point.place = turn(point.place);
            point.stiffness = turned(point.stiffness, &turn);
            point.damping = turned(point.damping, &turn);
        }
        for hinged in &mut body.hinged {
            [hinged.center, hinged.hinge, hinged.axis] =
                [hinged.center, hinged.hinge, hinged.axis].map(&turn);
            hinged.inertia = turned(hinged.inertia, &turn);
        }
        body.rotors.iter_mut().chain(&mut body.wheels).for_each(|own| own.axis = turn(own.axis));
        body.balls.iter_mut().for_each(|ball| ball.center = turn(ball.center));
        body
    }

    fn rescaled(&self, [length, mass, time]: [f64; 3]) -> Self {
        let (inertia, momentum) = (mass * length * length, mass * length * length / time);
        let times = |factor: f64| move |matrix: Matrix| matrix.map(|row| scale(factor, row));
        let mut body = self.clone();
        body.mass *= mass;
        body.inertia = times(inertia)(body.inertia);
        body.spin = scale(time.recip(), body.spin);
        for point in &mut body.points {
            point.mass *= mass;
            point.place = scale(length, point.place);
            point.stiffness = times(mass / (time * time))(point.stiffness);
            point.damping = times(mass / time)(point.damping);
        }
        for hinged in &mut body.hinged {
            hinged.mass *= mass;
            [hinged.center, hinged.hinge] = [hinged.center, hinged.hinge].map(|at| scale(length, at));
            hinged.inertia = times(inertia)(hinged.inertia);
            hinged.stiffness *= momentum / time;
            hinged.damping *= momentum;
        }
        body.rotors
            .iter_mut()
            .for_each(|own| own.values = [own.values[0] * inertia, own.values[1] * momentum]);
        body.wheels.iter_mut().for_each(|own| own.values[0] *= momentum);
        for ball in &mut body.balls {
            ball.radius *= length;
            ball.center = scale(length, ball.center);
            ball.values = [ball.values[0] * mass / length.powi(3), ball.values[1] * length * length / time];
        }
        body
    }

    fn reordered(&self) -> Self {
        let mut body = self.clone();
        body.points.reverse();
        body.hinged.reverse();
        body.rotors.reverse();
        body.balls.reverse();
        body
    }

    /// Text of the model.
    fn model(&self) -> String {
        let mut text = format!(
            "[body]\nname = \"b\"\n[carrier]\nmass = {:?}\ncenter_of_mass = [0, 0, 0]\ninertia = {:?}\n",
            self.mass, self.inertia
        );
        let mut add = |part: std::fmt::Arguments| text.write_fmt(part).unwrap();
        for Point { name, mass, place, .. } in &self.points {
            add(format_args!("[[point]]\nname = \"{name}\"\nmass = {mass:?}\nposition = {place:?}\n"));
        }
        for Point { name, stiffness, damping, .. } in &self.points {
            let ends = format!("from = \"{name}\"\nto = \"carrier\"");
            add(format_args!("[[spring]]\n{ends}\nstiffness = {stiffness:?}\ndamping = {damping:?}\n"));
        }
        for (k, Hinged { mass, center, inertia, hinge, axis, stiffness, damping }) in
            self.hinged.iter().enumerate()
        {
            add(format_args!(
                "[[hinged]]\nname = \"h{k}\"\nmass = {mass:?}\ncenter_of_mass = {center:?}\ninertia = {inertia:?}\nhinge = {hinge:?}\n\
                 axes = [{axis:?}]\nstiffness = {stiffness:?}\ndamping = {damping:?}\n"
            ));
        }
        for Turning { name, axis, values: [inertia, friction] } in &self.rotors {
            let values = format!("inertia = {inertia:?}\nfriction = {friction:?}");
            add(format_args!("[[rotor]]\nname = \"{name}\"\naxis = {axis:?}\n{values}\n"));
        }
        for (k, Ball { radius, center, values: [density, viscosity] }) in self.balls.iter().enumerate() {
            add(format_args!(
                "[[cavity]]\nname = \"c{k}\"\nshape = \"sphere\"\nradius = {radius:?}\ncenter = {center:?}\ndensity = {density:?}\n\
                 kinematic_viscosity = {viscosity:?}\n"
            ));
        }
        for Turning { name, axis, values: [momentum, _] } in &self.wheels {
            add(format_args!("[[wheel]]\nname = \"{name}\"\naxis = {axis:?}\nmomentum = {momentum:?}\n"));
        }
        add(format_args!("[initial]\nangular_velocity = {:?}\n", self.spin));
        text
    }
}
