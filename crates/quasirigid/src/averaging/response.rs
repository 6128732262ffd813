use nalgebra::{Complex, DMatrix};

use crate::math::eigen::{Dense, NoConvergence, modes};
use crate::math::krylov::dot;
use crate::math::span::{Span, largest};
use crate::math::sym::{self, Sym};
use crate::model::{FlexibleBody, Lossy, Principal, Rheology};

/// Answer of a body to periodic loads: its elastic modes with the loss of every dashpot and material, and the relaxations of
/// rotors and liquids. (G6), (C10)
///
/// The loads of a free rotation are linear in the six products of the spin, so the answer at a frequency is a symmetric
/// 6×6 compliance on these products, in principal axes.
#[derive(Clone, Debug)]
pub struct Response {
    principal: Principal,
    modes: Vec<Mode>,
    /// Modal masses: elastic modes and relaxations share some where the body recoils from both.
    mass: DMatrix<f64>,
    losses: Vec<Loss>,
    /// Whether mass and losses act on each mode alone.
    apart: bool,
}

/// An elastic mode or a relaxation, of unit modal mass.
#[derive(Clone, Debug)]
struct Mode {
    /// Square of its frequency (rad²/s²); zero of a relaxation.
    square: f64,
    /// Load by xx, yy, zz, yz, zx, xy.
    load: Sym,
    /// Coordinate with the largest share.
    name: String,
}

/// A matrix in the modes that a loss law multiplies.
#[derive(Clone, Debug)]
struct Loss {
    law: Law,
    matrix: DMatrix<f64>,
}

#[derive(Clone, Debug)]
enum Law {
    /// The factor `iν`.
    Dashpots,
    /// The factor `modulus − 1`.
    Material(Rheology),
}

/// Power that a harmonic of unit frequency takes: minus the imaginary part of the compliance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Uptake {
    /// Over xx, yy, zz, as the entries xx, yy, zz, yz, zx, xy of a symmetric matrix.
    pub normal: Sym,
    /// Of yz, zx, xy alone.
    pub shear: [f64; 3],
}

/// Coordinates up to which every mode is kept; of a larger body only those that the loads excite at low frequency.
const WHOLE: usize = 64;
/// Off-diagonal entries below this share of the diagonal are rounding.
const ROUNDING: f64 = 1e-11;

impl Response {
    /// The response of a body.
    ///
    /// # Errors
    /// [`NoConvergence`] if the eigenvalue solver fails.
    pub fn of(body: &FlexibleBody) -> Result<Self, NoConvergence> {
        Self::within(body, WHOLE)
    }

    /// The response in every mode of a body of up to `whole` elastic coordinates, of a larger one in those that are excited.
    fn within(body: &FlexibleBody, whole: usize) -> Result<Self, NoConvergence> {
        let principal = Principal::of(body.invariants().J);
        let loads = loads(body, &principal);
        let vibrations = vibrations(body, &loads, whole)?;
        let shapes: Vec<Shape> = vibrations.into_iter().chain(relaxations(body)?).collect();
        let mode = |Shape { square, x }: &Shape| Mode {
            square: *square,
            load: loads.iter().zip(x).fold([0.0; 6], |mut sum, (load, x)| {
                sum.iter_mut().zip(load).for_each(|(sum, load)| *sum += x * load);
                sum
            }),
            name: largest(x).map_or_else(String::new, |row| body.coordinates()[row].name.clone()),
        };
        let in_modes = |times: &dyn Fn(&[f64]) -> Vec<f64>| {
            let images: Vec<Vec<f64>> = shapes.iter().map(|shape| times(&shape.x)).collect();
            DMatrix::from_fn(shapes.len(), shapes.len(), |row, column| dot(&shapes[row].x, &images[column]))
        };
        let mass = in_modes(&|x| body.recoiling_mass_times(x));
        let dashpots = Loss { law: Law::Dashpots, matrix: in_modes(&|x| body.damping().times(x)) };
        let material = |Lossy { rheology, stiffness }: &Lossy| Loss {
            law: Law::Material(rheology.clone()),
            matrix: in_modes(&|x| stiffness.times(x)),
        };
        let losses: Vec<Loss> = std::iter::once(dashpots)
            .chain(body.lossy().iter().map(material))
            .filter(|loss| loss.matrix.amax() > 0.0)
            .collect();
        let apart = is_diagonal(&mass) && losses.iter().all(|loss| is_diagonal(&loss.matrix));
        let modes = shapes.iter().map(mode).collect();
        Ok(Self { principal, modes, mass, losses, apart }.without_idle())
    }

    /// Principal moments and axes of the frozen body.
    #[must_use]
    pub fn principal(&self) -> &Principal {
        &self.principal
    }

    /// Frequencies (rad/s) of the modes that a free rotation excites, the body free to recoil, each with the name of the
    /// coordinate that has the largest share in it; ascending.
    pub fn frequencies(&self) -> impl Iterator<Item = (f64, &str)> {
        self.elastic().map(|mode| (mode.square.sqrt(), mode.name.as_str()))
    }

    /// Static compliance on the products xx, yy, zz, yz, zx, xy, in principal axes: `½ mᵀSm` is the elastic energy (J) at
    /// the products `m` (rad²/s²) of a slow rotation. (G6)
    #[must_use]
    pub fn static_compliance(&self) -> [[f64; 6]; 6] {
        let mut sum = [[0.0; 6]; 6];
        for Mode { square, load, .. } in self.elastic() {
            for (row, a) in sum.iter_mut().zip(load) {
                row.iter_mut().zip(load).for_each(|(entry, b)| *entry += a * b / square);
            }
        }
        sum
    }

    fn elastic(&self) -> impl Iterator<Item = &Mode> {
        self.modes.iter().filter(|mode| mode.square > 0.0)
    }

    /// What a harmonic of this frequency (rad/s) takes.
    pub(super) fn uptake(&self, frequency: f64) -> Uptake {
        if self.apart { self.uptake_apart(frequency) } else { self.uptake_coupled(frequency) }
    }

    fn uptake_apart(&self, frequency: f64) -> Uptake {
        let factors: Vec<[f64; 2]> = self.losses.iter().map(|loss| loss.law.factor(frequency)).collect();
        let mut uptake = Uptake::default();
        for (i, Mode { square, load, .. }) in self.modes.iter().enumerate() {
            let mut stiffness = [square - frequency * frequency, 0.0];
            for (loss, factor) in self.losses.iter().zip(&factors) {
                let share = loss.matrix[(i, i)];
                stiffness[0] += share * factor[0];
                stiffness[1] += share * factor[1];
            }
            let lost = stiffness[1] / (stiffness[0].powi(2) + stiffness[1].powi(2));
            uptake.add(load, load, lost);
        }
        uptake
    }

    fn uptake_coupled(&self, frequency: f64) -> Uptake {
        let size = self.modes.len();
        let mut stiffness = DMatrix::from_fn(size, size, |row, column| {
            let square = if row == column { self.modes[row].square } else { 0.0 };
            Complex::from(square - frequency * frequency * self.mass[(row, column)])
        });
        for Loss { law, matrix } in &self.losses {
            let [re, im] = law.factor(frequency);
            stiffness += matrix.map(|entry| Complex::new(re, im) * entry);
        }
        let loads = DMatrix::from_fn(size, 6, |row, column| Complex::from(self.modes[row].load[column]));
        let mut uptake = Uptake::default();
        let Some(answer) = stiffness.lu().solve(&loads) else {
            return uptake;
        };
        for (row, mode) in self.modes.iter().enumerate() {
            let lost: Sym = std::array::from_fn(|column| -answer[(row, column)].im);
            uptake.add(&mode.load, &lost, 1.0);
        }
        uptake
    }

    /// Without the vibrations that no load reaches, where all modes are apart.
    fn without_idle(mut self) -> Self {
        if !self.apart {
            return self;
        }
        let energy = |mode: &Mode| mode.load.iter().map(|load| load * load / mode.square).sum::<f64>();
        let largest = self.elastic().map(energy).fold(0.0, f64::max);
        let alive = |mode: &Mode| mode.square == 0.0 || energy(mode) > ROUNDING.powi(2) * largest;
        let kept: Vec<usize> = (0..self.modes.len()).filter(|i| alive(&self.modes[*i])).collect();
        let part = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
        self.modes = kept.iter().map(|i| self.modes[*i].clone()).collect();
        self.mass = part(&self.mass);
        self.losses.iter_mut().for_each(|loss| loss.matrix = part(&loss.matrix));
        self
    }
}

impl Law {
    fn factor(&self, frequency: f64) -> [f64; 2] {
        match self {
            Self::Dashpots => [0.0, frequency],
            Self::Material(rheology) => {
                let [re, im] = rheology.modulus(frequency);
                [re - 1.0, im]
            }
        }
    }
}

impl Uptake {
    /// Adds the outer product of a load and an answer to it.
    fn add(&mut self, load: &Sym, answer: &Sym, factor: f64) {
        let pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];
        for (entry, (a, b)) in self.normal.iter_mut().zip(pairs) {
            *entry += 0.5 * factor * (load[a] * answer[b] + load[b] * answer[a]);
        }
        for (entry, i) in self.shear.iter_mut().zip(3..) {
            *entry += factor * load[i] * answer[i];
        }
    }

    /// Mean power of a harmonic: `2ν m*Um`, with the real and imaginary parts of `m`. (G7)
    pub fn power(&self, frequency: f64, [real, imaginary]: &[[f64; 6]; 2]) -> f64 {
        let stretching = |m: &[f64; 6]| {
            let normal = [m[0], m[1], m[2]];
            sym::dot(normal, sym::times(self.normal, normal))
        };
        let shearing: f64 =
            (0..3).map(|i| self.shear[i] * (real[i + 3].powi(2) + imaginary[i + 3].powi(2))).sum();
        2.0 * frequency * (stretching(real) + shearing)
    }
}

/// Loads of a free rotation on each coordinate, by the products xx, yy, zz, yz, zx, xy of the spin in principal axes:
/// `½ω·J_jω − h_j·ω̇` with Euler's `ω̇`. (G5)
fn loads(body: &FlexibleBody, principal: &Principal) -> Vec<Sym> {
    let Principal { moments: [I1, I2, I3], axes } = principal;
    let euler = [(I2 - I3) / I1, (I3 - I1) / I2, (I1 - I2) / I3];
    let invariants = body.invariants();
    let load = |(J, h): (&Sym, &[f64; 3])| -> Sym {
        let turned = axes.map(|axis| sym::times(*J, axis));
        let entry = |a: usize, b: usize| sym::dot(axes[a], turned[b]);
        let recoil = [0, 1, 2].map(|i| euler[i] * sym::dot(axes[i], *h));
        [
            0.5 * entry(0, 0),
            0.5 * entry(1, 1),
            0.5 * entry(2, 2),
            entry(1, 2) - recoil[0],
            entry(2, 0) - recoil[1],
            entry(0, 1) - recoil[2],
        ]
    };
    invariants.J1.iter().zip(&invariants.h).map(load).collect()
}

/// A mode as a vector over all coordinates, with the square of its frequency.
struct Shape {
    square: f64,
    x: Vec<f64>,
}

/// Elastic modes with what turns inside locked: all, or of a body of more coordinates those that the loads excite.
fn vibrations(body: &FlexibleBody, loads: &[Sym], whole: usize) -> Result<Vec<Shape>, NoConvergence> {
    let elastic = 0..body.elastic();
    let span = (elastic.len() > whole).then(|| excited(body, loads));
    let (A, C) = match &span {
        None => (
            body.recoiling_mass_matrix().block(elastic.clone()),
            Dense::of(&body.stiffness().block(elastic.clone())),
        ),
        Some(span) => {
            (span.projected(|x| body.recoiling_mass_times(x)), span.projected(|x| body.stiffness().times(x)))
        }
    };
    let found = modes(&A, &C)?;
    let shape = |(mode, frequency): (usize, &f64)| {
        let shares: Vec<f64> = (0..A.size()).map(|row| found.shapes.at(row, mode)).collect();
        let mut x = span.as_ref().map_or(shares.clone(), |span| span.combined(&shares));
        x.resize(body.coordinates().len(), 0.0);
        Shape { square: frequency * frequency, x }
    };
    Ok(found.frequencies.iter().enumerate().map(shape).collect())
}

/// Relaxations of the cyclic coordinates, elastic ones held and the body free to recoil. (C7)
fn relaxations(body: &FlexibleBody) -> Result<Vec<Shape>, NoConvergence> {
    let cyclic = body.cyclic();
    if cyclic.is_empty() {
        return Ok(Vec::new());
    }
    let A = body.recoiling_mass_matrix().block(cyclic.clone());
    let found = modes(&A, &Dense::of(&body.damping().block(cyclic.clone())))?;
    let shape = |mode: usize| {
        let mut x = vec![0.0; cyclic.start];
        x.extend((0..cyclic.len()).map(|row| found.shapes.at(row, mode)));
        Shape { square: 0.0, x }
    };
    Ok((0..cyclic.len()).map(shape).collect())
}

/// Vectors that span the answers to the loads up to the second power of the frequency.
fn excited(body: &FlexibleBody, loads: &[Sym]) -> Span {
    let softened = |mut x: Vec<f64>| {
        body.solve_stiffness(&mut x, 1);
        x
    };
    let first: Vec<Vec<f64>> = (0..6).map(|i| softened(loads.iter().map(|load| load[i]).collect())).collect();
    let after = |x: &Vec<f64>| {
        let mass = std::iter::once(body.recoiling_mass_times(x));
        let damping = std::iter::once(body.damping().times(x));
        let materials = body.lossy().iter().map(|part| part.stiffness.times(x));
        mass.chain(damping).chain(materials).map(softened).collect::<Vec<_>>()
    };
    let second: Vec<Vec<f64>> = first.iter().flat_map(after).collect();
    let third: Vec<Vec<f64>> = second.iter().flat_map(after).collect();
    Span::orthonormal([first, second, third].concat(), |x| body.stiffness().times(x))
}

fn is_diagonal(matrix: &DMatrix<f64>) -> bool {
    let size = matrix.nrows();
    (0..size).all(|i| {
        (0..size).all(|j| {
            i == j || matrix[(i, j)].powi(2) <= ROUNDING.powi(2) * matrix[(i, i)].abs() * matrix[(j, j)].abs()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::averaging::{FreeRotation, MeanPower};
    use crate::problems::ring_of_points;

    /// What the projection leaves out is of the fourth power of spin over elastic frequency.
    #[test]
    fn excited_modes_take_the_power_of_all() {
        let body = ring_of_points(30).body().unwrap();
        let [whole, few] = [usize::MAX, 0].map(|whole| Response::within(&body, whole).unwrap());
        assert!(few.modes.len() < 60, "{}", few.modes.len());
        assert!(whole.modes.len() == 90 || whole.apart, "{}", whole.modes.len());
        let slowest = whole.frequencies().next().unwrap().0;
        let gaps = [0.2, 0.1].map(|share| {
            let [I1, .., I3] = whole.principal.moments;
            let G = share * slowest * I1;
            let motion = FreeRotation::at_ratio(whole.principal.moments, G, 0.5 * (I1 / I3 + 1.0));
            (few.mean_power(&motion) / whole.mean_power(&motion) - 1.0).abs()
        });
        assert!(gaps[0] < 1e-4 && gaps[1] < 0.1 * gaps[0].max(1e-11), "{gaps:?}");
    }
}
