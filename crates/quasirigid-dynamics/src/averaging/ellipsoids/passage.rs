//! Passages of many ellipsoids from one wobble to another: quadratures in pieces, eight pieces in the lanes at a time.
//! Every piece has the same nodes, so that no lane waits for another; a body has as many pieces as its way is long.
//! Equation (A6), docs/theory/10-torque-free.md.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::compliance::Solids;
use super::criteria::EllipsoidCriteria;
use super::power::{Losses, WobbleState, Wobbles};
use super::{EllipsoidLoss, EllipsoidRefusal, Wobble, WobblingEllipsoid};
use crate::math::lanes::{LANES, Lanes};
use crate::math::quadrature::KRONROD;
use crate::math::simd::{Arithmetic, Rounding, Task, dispatch_lanes};
use crate::model::Mode;

/// Passage of an ellipsoid from one wobble to another.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipsoidPassage {
    /// Time (s).
    pub time: f64,
    /// Revolutions about the angular momentum.
    pub revolutions: f64,
    /// Mean power at the start (W).
    pub power: f64,
    /// Estimated error of the quadrature (s).
    pub quadrature_error: f64,
    /// Bound of the relative error of the average. (Q12)
    pub error: f64,
}

/// Place `ξ` below which a wobble is next to the separatrix, where no time is spent: `e^{−24}`.
const SEPARATRIX: f64 = -24.0;
/// Place below which little time is spent, `e^{−10}`, so that one piece is enough.
const NEAR_SEPARATRIX: f64 = -10.0;
/// Longest piece of a way in `ξ` elsewhere.
const PIECE: f64 = 6.0;

/// Passages of ellipsoids from their wobbles at the start to those at the end, in their order. (A6)
///
/// The power is that of the harmonics of the polhode with the static compliance of each ellipsoid, exact for spins far below its
/// frequencies.
///
/// ```
/// use quasirigid::averaging::{EllipsoidLoss, Wobble, WobblingEllipsoid, ellipsoid_passages};
/// use quasirigid::prelude::Rounding;
///
/// let rock = WobblingEllipsoid {
///     semi_axes: [170.0, 130.0, 100.0],
///     density: 2000.0,
///     shear: 5e8,
///     poisson: 0.25,
///     loss: EllipsoidLoss::QualityFactor(100.0),
///     spin: 6e-5,
///     from: Wobble::Nutation(1.0),
///     until: Wobble::Nutation(0.1),
/// };
/// let passages = ellipsoid_passages(&[rock; 3], Rounding::Fastest);
/// assert!(passages[0].as_ref().is_ok_and(|passage| passage.time > 1e12)); // s
/// ```
///
/// # Errors
/// [`EllipsoidRefusal`] in place of a passage: for values and states that no ellipsoid has, and where the average does not hold.
#[must_use]
pub fn ellipsoid_passages(
    bodies: &[WobblingEllipsoid],
    rounding: Rounding,
) -> Vec<Result<EllipsoidPassage, EllipsoidRefusal>> {
    dispatch_lanes(rounding, Passages { bodies })
}

struct Passages<'a> {
    bodies: &'a [WobblingEllipsoid],
}

impl Task for Passages<'_> {
    type Output = Vec<Result<EllipsoidPassage, EllipsoidRefusal>>;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Self::Output {
        let mut ways: Vec<Result<Way, EllipsoidRefusal>> = Vec::with_capacity(self.bodies.len());
        for block in self.bodies.chunks(LANES) {
            prepare::<A>(block, &mut ways);
        }
        let mut pieces = Vec::new();
        for (index, way) in ways.iter().enumerate() {
            if let Ok(way) = way {
                way.pieces(index, &mut pieces);
            }
        }
        // pieces side by side have about as many harmonics
        pieces.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
        for block in pieces.chunks(LANES) {
            follow(self.bodies, block, &mut ways);
        }
        ways.into_iter().map(|way| way?.passage()).collect()
    }
}

/// Way of one body, with the sums over its pieces.
#[derive(Clone, Copy, Debug)]
struct Way {
    body: Prepared,
    from: Place,
    until: Place,
    criteria: EllipsoidCriteria,
    sums: EllipsoidPassage,
}

/// A body with its principal moments (kg·m²), ascending, its compliance about them, and its angular momentum (N·m·s).
#[derive(Clone, Copy, Debug)]
struct Prepared {
    moments: [f64; 3],
    squares: [[f64; 3]; 3],
    products: [f64; 3],
    angular_momentum: f64,
}

/// A mode and a place `ξ` in it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    mode: Mode,
    xi: f64,
}

/// A piece of a way, within one mode.
#[derive(Clone, Copy, Debug)]
struct Piece {
    way: usize,
    mode: Mode,
    ends: [f64; 2],
    /// Whether the way starts or ends with this piece.
    outer: [bool; 2],
}

/// Prepares eight bodies.
#[inline(always)]
fn prepare<A: Arithmetic>(block: &[WobblingEllipsoid], ways: &mut Vec<Result<Way, EllipsoidRefusal>>) {
    let ordered: [[usize; 3]; LANES] = std::array::from_fn(|lane| order(of(block, lane).semi_axes));
    let mut solids = Solids {
        semi_axes: [Lanes::splat(1.0); 3],
        density: Lanes::splat(1.0),
        shear: Lanes::splat(1.0),
        poisson: Lanes::splat(0.0),
    };
    for lane in 0..LANES {
        let body = of(block, lane);
        for axis in 0..3 {
            solids.semi_axes[axis].0[lane] = body.semi_axes[ordered[lane][axis]];
        }
        (solids.density.0[lane], solids.shear.0[lane]) = (body.density, body.shear);
        solids.poisson.0[lane] = body.poisson;
    }
    let compliance = solids.compliance::<A>();
    let moments = solids.moments();
    for (lane, body) in block.iter().enumerate() {
        let prepared = Prepared {
            moments: moments.map(|moment| moment.0[lane]),
            squares: compliance.squares.map(|row| row.map(|entry| entry.0[lane])),
            products: compliance.products.map(|entry| entry.0[lane]),
            angular_momentum: body.spin * moments[2].0[lane],
        };
        ways.push(checked(body).and_then(|()| way(body, prepared)));
    }
}

/// The body of a lane; the last one again in lanes that would be idle.
fn of(block: &[WobblingEllipsoid], lane: usize) -> &WobblingEllipsoid {
    &block[lane.min(block.len() - 1)]
}

/// Order of the semi-axes in which the moments about them ascend.
fn order(semi_axes: [f64; 3]) -> [usize; 3] {
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| semi_axes[*j].total_cmp(&semi_axes[*i]));
    order
}

/// Refuses numbers that no ellipsoid has.
fn checked(body: &WobblingEllipsoid) -> Result<(), EllipsoidRefusal> {
    let [a, b, c] = body.semi_axes;
    let (loss, number) = match body.loss {
        EllipsoidLoss::QualityFactor(factor) => ("the quality factor", factor),
        EllipsoidLoss::KelvinVoigt(time) => ("the time of the material", time),
    };
    let positive = [
        ("a semi-axis", a),
        ("a semi-axis", b),
        ("a semi-axis", c),
        ("the density", body.density),
        ("the shear modulus", body.shear),
        ("the spin", body.spin),
        (loss, number),
    ];
    if let Some(&(name, value)) = positive.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
        return Err(EllipsoidRefusal::NotPositive { name, value });
    }
    if let EllipsoidLoss::QualityFactor(value) = body.loss
        && value < 1.0
    {
        return Err(EllipsoidRefusal::Quality { value });
    }
    if !(body.poisson > -1.0 && body.poisson < 0.5) {
        return Err(EllipsoidRefusal::Poisson { value: body.poisson });
    }
    Ok(())
}

fn way(body: &WobblingEllipsoid, prepared: Prepared) -> Result<Way, EllipsoidRefusal> {
    let moments = prepared.moments;
    let numbers = moments.iter().chain(prepared.squares.as_flattened()).chain(&prepared.products);
    if !numbers.chain([&prepared.angular_momentum]).all(|number| number.is_normal()) {
        return Err(EllipsoidRefusal::OutOfRange);
    }
    let [from, until] = [place(moments, body.from)?, place(moments, body.until)?];
    if until.along() < from.along() {
        return Err(EllipsoidRefusal::Behind);
    }
    let largest = prepared.squares.as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let [short, long] = [until.mode == Mode::ShortAxis, from.mode == Mode::LongAxis];
    let criteria = EllipsoidCriteria::before(body, moments, largest, short, long);
    criteria.judge()?;
    let sums =
        EllipsoidPassage { time: 0.0, revolutions: 0.0, power: 0.0, quadrature_error: 0.0, error: 0.0 };
    Ok(Way { body: prepared, from, until, criteria, sums })
}

/// Place of a wobble of a body with these moments, by functions that are the same on every machine.
fn place(moments: [f64; 3], wobble: Wobble) -> Result<Place, EllipsoidRefusal> {
    let [I1, I2, I3] = moments;
    let refused = EllipsoidRefusal::NoState { wobble, least: I1 / I3 };
    let (mode, xi) = match wobble {
        Wobble::Nutation(_) if !Mode::ShortAxis.exists(moments) => return Err(EllipsoidRefusal::NoShortAxis),
        Wobble::Nutation(angle) if angle > 0.0 && angle < FRAC_PI_2 => {
            (Mode::ShortAxis, libm::log(I2 / I3) - 2.0 * libm::log(libm::tan(angle)))
        }
        Wobble::Ratio(ratio) if ratio * I3 >= I2 && ratio < 1.0 => {
            (Mode::ShortAxis, libm::log((ratio * I3 - I2) / (I3 * (1.0 - ratio))))
        }
        Wobble::Ratio(ratio) if ratio * I3 < I2 && ratio * I3 > I1 => {
            (Mode::LongAxis, libm::log((I2 - ratio * I3) / (ratio * I3 - I1)))
        }
        _ => return Err(refused),
    };
    Ok(Place { mode, xi: xi.max(SEPARATRIX) })
}

impl Place {
    /// Place on the way from the axis of least inertia through the separatrix, 0, to that of greatest.
    fn along(self) -> f64 {
        match self.mode {
            Mode::ShortAxis => self.xi - SEPARATRIX,
            Mode::LongAxis => SEPARATRIX - self.xi,
        }
    }
}

impl Way {
    /// Pieces of the way within each mode.
    fn pieces(&self, way: usize, pieces: &mut Vec<Piece>) {
        let first = pieces.len();
        let mut within = |mode, from: f64, until: f64| {
            let passes = (from - NEAR_SEPARATRIX) * (until - NEAR_SEPARATRIX) < 0.0;
            let cuts = if passes { vec![from, NEAR_SEPARATRIX, until] } else { vec![from, until] };
            for [from, until] in cuts.array_windows() {
                let near = from.max(*until) <= NEAR_SEPARATRIX;
                let count = if near { 1.0 } else { ((until - from).abs() / PIECE).ceil().max(1.0) };
                for i in 0..count as usize {
                    let end = |i: usize| from + (until - from) * i as f64 / count;
                    pieces.push(Piece { way, mode, ends: [end(i), end(i + 1)], outer: [false; 2] });
                }
            }
        };
        match [self.from.mode, self.until.mode] {
            [Mode::LongAxis, Mode::ShortAxis] => {
                within(Mode::LongAxis, self.from.xi, SEPARATRIX);
                within(Mode::ShortAxis, SEPARATRIX, self.until.xi);
            }
            [mode, _] => within(mode, self.from.xi, self.until.xi),
        }
        let last = pieces.len() - 1;
        pieces[first].outer[0] = true;
        pieces[last].outer[1] = true;
    }

    fn passage(self) -> Result<EllipsoidPassage, EllipsoidRefusal> {
        self.criteria.judge()?;
        let passage = EllipsoidPassage { error: self.criteria.error(), ..self.sums };
        let EllipsoidPassage { time, revolutions, power, quadrature_error, error } = passage;
        let known = [time, revolutions, quadrature_error, error].iter().all(|number| number.is_finite());
        if known && power.is_normal() { Ok(passage) } else { Err(EllipsoidRefusal::OutOfRange) }
    }
}

/// Adds eight pieces to the sums of their ways.
#[inline(always)]
fn follow(bodies: &[WobblingEllipsoid], block: &[Piece], ways: &mut [Result<Way, EllipsoidRefusal>]) {
    let piece = |lane: usize| block[lane.min(block.len() - 1)];
    let wobbles = gather(bodies, &piece, ways);
    let (mut middle, mut half) = (Lanes::splat(0.0), Lanes::splat(0.0));
    for lane in 0..LANES {
        let [from, until] = piece(lane).ends;
        (middle.0[lane], half.0[lane]) = (0.5 * (from + until), 0.5 * (until - from));
    }
    let zero = Lanes::splat(0.0);
    let (mut time, mut coarse, mut revolutions) = (zero, zero, zero);
    for [node, weight, in_coarse] in KRONROD {
        for side in [-node, node] {
            let at = wobbles.at(middle + half * Lanes::splat(side));
            let slowness = at.energy_slope / at.power;
            time = time + Lanes::splat(weight) * slowness;
            coarse = coarse + Lanes::splat(in_coarse) * slowness;
            revolutions = revolutions + Lanes::splat(weight) * slowness * at.revolution;
            if node == 0.0 {
                break;
            }
        }
    }
    let ends = block.iter().any(|piece| piece.outer != [false; 2]);
    let at_ends = ends.then(|| [wobbles.at(middle - half), wobbles.at(middle + half)]);
    for (lane, piece) in block.iter().enumerate() {
        let Ok(way) = &mut ways[piece.way] else { continue };
        // a piece of the long-axis mode runs towards its separatrix, against ξ
        let length = half.0[lane].abs();
        way.sums.time += length * time.0[lane];
        way.sums.revolutions += length * revolutions.0[lane] / TAU;
        way.sums.quadrature_error += length * (time.0[lane] - coarse.0[lane]).abs();
        if let Some(at_ends) = &at_ends {
            way.see(at_ends, lane, piece, bodies[piece.way].loss);
        }
    }
}

impl Way {
    /// Takes the ends of the way into account.
    fn see(&mut self, ends: &[WobbleState; 2], lane: usize, piece: &Piece, loss: EllipsoidLoss) {
        for (at, outer) in ends.iter().zip(piece.outer) {
            if outer {
                self.criteria.add(at, lane, loss);
            }
        }
        if piece.outer[0] {
            self.sums.power = ends[0].power.0[lane];
        }
    }
}

/// Bodies of eight pieces, axes by their part in the motion.
#[inline(always)]
fn gather(
    bodies: &[WobblingEllipsoid],
    piece: &impl Fn(usize) -> Piece,
    ways: &[Result<Way, EllipsoidRefusal>],
) -> Wobbles {
    let zero = Lanes::splat(0.0);
    let losses = Losses { time: zero, inverse_quality: zero };
    let mut wobbles = Wobbles {
        moments: [zero; 3],
        angular_momentum: zero,
        squares: [[zero; 3]; 3],
        products: [zero; 3],
        losses,
    };
    for lane in 0..LANES {
        let Piece { way, mode, .. } = piece(lane);
        let Ok(Way { body, .. }) = &ways[way] else { continue };
        // axes that are circled, middle, other
        let axes = if mode == Mode::ShortAxis { [2, 1, 0] } else { [0, 1, 2] };
        wobbles.angular_momentum.0[lane] = body.angular_momentum;
        for i in 0..3 {
            wobbles.moments[i].0[lane] = body.moments[axes[i]];
            // the product of the two other axes
            wobbles.products[i].0[lane] = body.products[axes[i]];
            for j in 0..3 {
                wobbles.squares[i][j].0[lane] = body.squares[axes[i]][axes[j]];
            }
        }
        match bodies[way].loss {
            EllipsoidLoss::QualityFactor(factor) => wobbles.losses.inverse_quality.0[lane] = factor.recip(),
            EllipsoidLoss::KelvinVoigt(time) => wobbles.losses.time.0[lane] = time,
        }
    }
    wobbles
}
