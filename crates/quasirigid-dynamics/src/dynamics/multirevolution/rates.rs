//! Rates per revolution: a flow whose motion over a unit of its independent variable is a revolution exactly, interpolated over the angle in
//! the section.
//! The map of a revolution is near the identity, so that a fixed-point iteration finds the flow; a mean over the revolution, as the method of
//! averaging takes it, would be its first term.
//! Equation (P11), docs/theory/05-propagation.md; multirevolution methods `[@calvo2004]`.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::revolution::{GAUSS, Motion, ROWS, Revolution};
use super::section::Section;
use crate::math::chebyshev::{Chebyshev, NODES};
use crate::math::ode::Checkpoint;
use crate::math::simd::Arithmetic;
use crate::math::vec3::dot;

/// Rates per revolution on pieces of the angle `ψ`, fitted where the motion comes. (P11)
#[derive(Debug)]
pub(super) struct Rates {
    pieces: BTreeMap<(u32, u64), Piece>,
}

/// Piece of the interpolation.
#[derive(Debug)]
enum Piece {
    Fit(Box<Fit>),
    Halved,
    /// Where revolutions are made one by one: next to a separatrix, or where one changes too much.
    Rough,
}

/// Rates on an interval of the angle `ψ`, in the order of [`Revolution::changes`].
#[derive(Clone, Debug)]
pub(super) struct Fit(Chebyshev<ROWS>);

/// Width of a piece that was not halved (rad).
const WIDTH: f64 = 0.25;
/// Halvings allowed.
const DEEPEST: u32 = 30;
/// Share of the last polynomials below which a piece fits.
const FITS: f64 = 1e-12;
/// Noise of a change of the angle, in units of rounding of the angle: what cancels over a revolution leaves it.
const NOISE: f64 = 1e-4;
/// Largest change of the angle over a revolution, relative to the width of a piece; the nodes next to the ends are no nearer to them. None
/// that decays leaves the piece at the axis inwards.
const LARGEST: f64 = 4e-3;
/// Matrix of Gauss' method of order 6.
const STAGES: [[f64; 3]; 3] = [
    [0.138_888_888_888_888_9, -0.035_976_667_524_938_9, 0.009_789_444_015_308_326],
    [0.300_263_194_980_864_6, 0.222_222_222_222_222_2, -0.022_485_417_203_086_815],
    [0.267_988_333_762_469_5, 0.480_421_111_969_383_35, 0.138_888_888_888_888_9],
];
/// Limit of iterations for the flow, and the change of the last one.
const ITERATIONS: usize = 30;
const CONVERGED: f64 = 1e-16;

impl Rates {
    pub fn new() -> Self {
        Self { pieces: BTreeMap::new() }
    }

    /// Rates about an angle; none where revolutions are to be made one by one.
    pub fn at<A: Arithmetic>(&mut self, motion: &Motion<'_, A>, section: &Section, psi: f64) -> Option<&Fit> {
        let mut found = None;
        for depth in 0..=DEEPEST {
            let key = (depth, (psi / width(depth)).floor() as u64);
            let ends = ends(key);
            let piece = self.pieces.entry(key).or_insert_with(|| piece(motion, section, ends, depth));
            match piece {
                Piece::Fit(_) => {
                    found = Some(key);
                    break;
                }
                Piece::Halved => {}
                Piece::Rough => return None,
            }
        }
        match self.pieces.get(&found?) {
            Some(Piece::Fit(fit)) => Some(fit),
            _ => None,
        }
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_count(self.pieces.len() as u64);
        for ((depth, index), piece) in &self.pieces {
            checkpoint.save_count((*depth).into());
            checkpoint.save_count(*index);
            piece.save(checkpoint);
        }
    }

    pub fn load(checkpoint: &mut Checkpoint) -> Option<Self> {
        let mut pieces = BTreeMap::new();
        for _ in 0..checkpoint.load_count()? {
            let depth = u32::try_from(checkpoint.load_count()?).ok().filter(|depth| *depth <= DEEPEST)?;
            let key = (depth, checkpoint.load_count()?);
            pieces.insert(key, Piece::load(checkpoint, ends(key))?);
        }
        Some(Self { pieces })
    }
}

/// Width (rad) of a piece that comes from so many halvings.
fn width(depth: u32) -> f64 {
    WIDTH / f64::from(1 << depth)
}

/// Interval of the piece with a number among those of its width.
fn ends((depth, index): (u32, u64)) -> [f64; 2] {
    [index as f64, index as f64 + 1.0].map(|number| number * width(depth))
}

impl Piece {
    fn save(&self, checkpoint: &mut Checkpoint) {
        match self {
            Self::Halved => checkpoint.save_count(0),
            Self::Rough => checkpoint.save_count(1),
            Self::Fit(fit) => {
                checkpoint.save_count(2);
                fit.0.coefficients().iter().for_each(|row| checkpoint.save_list(row));
            }
        }
    }

    fn load(checkpoint: &mut Checkpoint, ends: [f64; 2]) -> Option<Self> {
        match checkpoint.load_count()? {
            0 => Some(Self::Halved),
            1 => Some(Self::Rough),
            2 => {
                let mut rows = [[0.0; NODES]; ROWS];
                rows.iter_mut().try_for_each(|row| checkpoint.load_into(row))?;
                Some(Self::Fit(Box::new(Fit(Chebyshev::of(ends, rows)))))
            }
            _ => None,
        }
    }
}

fn piece<A: Arithmetic>(motion: &Motion<'_, A>, section: &Section, ends: [f64; 2], depth: u32) -> Piece {
    let nodes = Chebyshev::<ROWS>::nodes(ends);
    let halved = if depth < DEEPEST { Piece::Halved } else { Piece::Rough };
    let Some(map) =
        nodes.iter().map(|psi| motion.revolution(section, *psi, |_, _| ())).collect::<Option<Vec<_>>>()
    else {
        return halved;
    };
    let inwards = |revolution: &Revolution| ends[0] == 0.0 && revolution.growth <= 0.0;
    let large = |(psi, revolution): (&f64, &Revolution)| {
        !inwards(revolution) && psi * revolution.growth.abs() > LARGEST * (ends[1] - ends[0])
    };
    let count = nodes.iter().zip(&map).filter(|node| large(*node)).count();
    if count > 0 {
        return if count == NODES { Piece::Rough } else { halved };
    }
    // a change of the angle or the energy below this share of a unit of rounding is noise
    let (first, unit) = (&map[0].sums, NOISE * f64::EPSILON);
    let noise = [unit, 0.0, 0.0, 0.0, unit * section.G * first.angle / first.time, 0.0];
    let fits = |rates: &Chebyshev<ROWS>| {
        rates.tails().iter().zip(noise).all(|([tail, largest], noise)| *tail <= (FITS * largest).max(noise))
    };
    let changes = changes(&map);
    if !fits(&Chebyshev::through(ends, &changes)) {
        return halved;
    }
    let rates = flow(ends, &nodes, &changes);
    if fits(&rates) { Piece::Fit(Box::new(Fit(rates))) } else { halved }
}

/// Changes over a revolution from each node, with a precession that is continuous from node to node: what it lacks to the angle turned about the
/// angular momentum is the solid angle of the circuit.
fn changes(map: &[Revolution]) -> [[f64; ROWS]; NODES] {
    let mut solid = 0.0;
    std::array::from_fn(|k| {
        let lacking = map[k].sums.about - map[k].precession;
        solid = lacking - TAU * ((lacking - solid) / TAU).round();
        let [growth, time, _, dissipated, energy_change, angle] = map[k].changes();
        [growth, time, map[k].sums.about - solid, dissipated, energy_change, angle]
    })
}

/// The flow whose motion over a unit of its variable makes these changes. (P11)
fn flow(ends: [f64; 2], nodes: &[f64; NODES], changes: &[[f64; ROWS]; NODES]) -> Chebyshev<ROWS> {
    let mut values = *changes;
    for _ in 0..ITERATIONS {
        let fit = Fit(Chebyshev::through(ends, &values));
        let mut largest: f64 = 0.0;
        for ((value, change), psi) in values.iter_mut().zip(changes).zip(nodes) {
            let made = fit.over_a_revolution(*psi);
            for ((value, change), made) in value.iter_mut().zip(change).zip(made) {
                let gap = change - made;
                *value += gap;
                largest = largest.max(gap.abs() / change.abs().max(f64::MIN_POSITIVE));
            }
        }
        if largest < CONVERGED {
            break;
        }
    }
    Chebyshev::through(ends, &values)
}

impl Fit {
    /// The interval (rad).
    pub fn ends(&self) -> [f64; 2] {
        self.0.ends()
    }

    /// Whether an angle is on the interval.
    pub fn holds(&self, psi: f64) -> bool {
        let [start, end] = self.ends();
        (start..=end).contains(&psi)
    }

    /// Sizes of the rates on the interval.
    pub fn largest(&self) -> [f64; ROWS] {
        self.0.tails().map(|[_, largest]| largest)
    }

    /// Rates per revolution at an angle that differs from `psi` by a change of its logarithm. The distance from the end is kept apart: near a
    /// separatrix the last digit of the angle matters.
    pub fn at(&self, psi: f64, growth: f64) -> [f64; ROWS] {
        self.0.at_distance((psi - self.ends()[0]) + psi * growth.exp_m1())
    }

    /// Changes that the flow makes over a revolution: Gauss' method of order 6, by iteration.
    fn over_a_revolution(&self, psi: f64) -> [f64; ROWS] {
        let mut stages = [self.at(psi, 0.0); 3];
        for _ in 0..6 {
            let slopes = stages.map(|rates| rates[0]);
            stages = STAGES.map(|row| self.at(psi, dot(row, slopes)));
        }
        std::array::from_fn(|row| {
            GAUSS.iter().zip(stages).map(|((_, weight), rates)| weight * rates[row]).sum()
        })
    }
}
