//! Frequency response of a body to the harmonics of a free rotation, by modes, with the loss of every dashpot and material.
//! Modes without coupling by losses or rotors are solved one by one, which is cheap and the case of most bodies; otherwise a complex matrix
//! is factored per harmonic.
//! Equations (G6), (G7), docs/theory/11-materials.md; (C10), (C11), docs/theory/13-inside.md.

use nalgebra::{Complex, DMatrix, DVector, Vector3};

use super::harmonics::Harmonic;
use super::loaded_modes::{LoadedMode, loaded_modes};
use crate::math::eigen::NoConvergence;
use crate::math::krylov::dot;
use crate::math::sym3::{self, Sym};
use crate::math::vec3;
use crate::model::impedance;
use crate::model::{Dissipator, FlexibleBody, LiquidMemory, Principal, Rheology, Viscoelastic};

/// Frequency response of a body to periodic loads: its elastic modes with the loss of every dashpot and material, and internal rotors and
/// liquids. (G6), (C10)
///
/// The loads of a free rotation are linear in the six products of the angular velocity, and so is the response.
#[derive(Clone, Debug)]
pub struct Response {
    principal: Principal,
    pub(super) rows: Vec<LoadedMode>,
    /// Mass of the rows, with the body free to recoil.
    mass: DMatrix<f64>,
    pub(super) losses: Vec<Loss>,
    /// Gyroscopic coupling of internal rotors and liquids, per unit of mean angular velocity about each principal axis.
    turning: [DMatrix<f64>; 3],
    /// Liquids whose force at a frequency is known, each with the row of its first axis.
    pub(super) memories: Vec<(usize, LiquidMemory)>,
    pub(super) dissipators: Vec<Dissipator>,
    /// True if mass and losses are diagonal, so that each row is solved alone.
    apart: bool,
}

/// Matrix in the rows with the loss law that multiplies it.
#[derive(Clone, Debug)]
pub(super) struct Loss {
    pub law: Law,
    pub matrix: DMatrix<f64>,
}

#[derive(Clone, Debug)]
pub(super) enum Law {
    /// The factor `iν`.
    Dashpots,
    /// The factor `modulus − 1`.
    Material(Rheology),
}

/// Number of elastic coordinates up to which every mode is kept; a larger body keeps only those that the loads excite at low frequency.
pub(super) const WHOLE: usize = 64;
/// Share of the diagonal below which off-diagonal entries are rounding.
const COUPLING_ROUNDING: f64 = 1e-11;

impl Response {
    /// The response of a body.
    ///
    /// # Errors
    /// [`NoConvergence`] if the eigenvalue solver fails.
    pub fn compute(body: &FlexibleBody) -> Result<Self, NoConvergence> {
        Self::within(body, WHOLE)
    }

    /// Response in every mode of a body of up to `whole` elastic coordinates, of a larger one in the modes that are excited.
    fn within(body: &FlexibleBody, whole: usize) -> Result<Self, NoConvergence> {
        let principal = Principal::compute(body.invariants().J);
        let rows = loaded_modes(body, &principal, whole)?;
        let size = rows.len();
        let in_rows = |times: &dyn Fn(&[f64]) -> Vec<f64>| {
            let images: Vec<Vec<f64>> = rows.iter().map(|row| times(&row.shape)).collect();
            DMatrix::from_fn(size, size, |row, column| dot(&rows[row].shape, &images[column]))
        };
        let inside = !body.cyclic().is_empty();
        let inverse = sym3::inverse(body.invariants().J);
        let recoil = |row: usize, column: usize| vec3::dot(rows[row].h, sym3::times(inverse, rows[column].h));
        let mass = if inside {
            in_rows(&|x| body.mass_times(x)) - DMatrix::from_fn(size, size, recoil)
        } else {
            DMatrix::identity(size, size)
        };
        let dashpots = Loss { law: Law::Dashpots, matrix: in_rows(&|x| body.damping().times(x)) };
        let material = |Viscoelastic { rheology, stiffness }: &Viscoelastic| Loss {
            law: Law::Material(rheology.clone()),
            matrix: in_rows(&|x| stiffness.times(x)),
        };
        let losses: Vec<Loss> = std::iter::once(dashpots)
            .chain(body.viscoelastic().iter().map(material))
            .filter(|loss| loss.matrix.amax() > 0.0)
            .collect();
        let turning = if inside {
            principal.axes.map(|axis| in_rows(&|x| turned(body, axis, x)))
        } else {
            [(); 3].map(|()| DMatrix::zeros(size, size))
        };
        let memories = memories(body, &rows);
        let alone = turning.iter().all(|matrix| matrix.amax() == 0.0) && memories.is_empty();
        let apart = alone && is_diagonal(&mass) && losses.iter().all(|loss| is_diagonal(&loss.matrix));
        let dissipators = body.dissipators().to_vec();
        Ok(Self { principal, rows, mass, losses, turning, memories, dissipators, apart }.without_idle())
    }

    /// Principal moments and axes of the frozen body.
    #[must_use]
    pub fn principal(&self) -> &Principal {
        &self.principal
    }

    /// Frequencies (rad/s) of the modes that a free rotation excites, the body free to recoil, each with the name of the
    /// coordinate that has the largest share in it; ascending.
    pub fn frequencies(&self) -> impl Iterator<Item = (f64, &str)> {
        self.elastic().map(|row| (row.square.sqrt(), row.name.as_str()))
    }

    /// Static compliance on the products xx, yy, zz, yz, zx, xy, in principal axes: `½ mᵀSm` is the elastic energy (J) at
    /// the products `m` (rad²/s²) of a slow rotation. (G6)
    #[must_use]
    pub fn static_compliance(&self) -> [[f64; 6]; 6] {
        let mut sum = [[0.0; 6]; 6];
        for LoadedMode { square, load, .. } in self.elastic() {
            for (row, a) in sum.iter_mut().zip(load) {
                row.iter_mut().zip(load).for_each(|(entry, b)| *entry += a * b / square);
            }
        }
        sum
    }

    fn elastic(&self) -> impl Iterator<Item = &LoadedMode> {
        self.rows.iter().filter(|row| row.square > 0.0)
    }

    /// Mean power (W) that a harmonic takes from a rotation with this mean angular velocity (rad/s, principal axes): `2ν` times minus the
    /// imaginary part of `f̄ᵀx`, with the load `f` and the response `x`. (G7), (C10)
    pub(super) fn power(&self, harmonic: &Harmonic, mean_spin: [f64; 3]) -> f64 {
        let loads = self.loads(harmonic);
        let lost: f64 = if self.apart {
            let lost = |(load, stiffness): (&Complex<f64>, Complex<f64>)| {
                load.norm_sqr() * stiffness.im / stiffness.norm_sqr()
            };
            loads.iter().zip(self.stiffness_apart(harmonic.frequency)).map(lost).sum()
        } else {
            self.answer_coupled(harmonic.frequency, mean_spin, &loads)
                .map_or(0.0, |answer| -loads.dotc(&answer).im)
        };
        2.0 * harmonic.frequency * lost
    }

    /// Response of each row to a harmonic.
    pub(super) fn answer(&self, harmonic: &Harmonic, mean_spin: [f64; 3]) -> Vec<Complex<f64>> {
        let loads = self.loads(harmonic);
        if self.apart {
            return loads
                .iter()
                .zip(self.stiffness_apart(harmonic.frequency))
                .map(|(f, stiffness)| f / stiffness)
                .collect();
        }
        let answer = self.answer_coupled(harmonic.frequency, mean_spin, &loads);
        answer.unwrap_or_else(|| DVector::zeros(loads.len())).as_slice().to_vec()
    }

    /// Displacement of the coordinates from a response of the rows.
    pub(super) fn displacement(&self, answer: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let size = self.rows.first().map_or(0, |row| row.shape.len());
        let mut moved = vec![Complex::from(0.0); size];
        for (row, share) in self.rows.iter().zip(answer) {
            moved.iter_mut().zip(&row.shape).for_each(|(moved, shape)| *moved += share * *shape);
        }
        moved
    }

    fn loads(&self, harmonic: &Harmonic) -> DVector<Complex<f64>> {
        let [real, imaginary] = &harmonic.products;
        let part = |load: &Sym, products: &Sym| load.iter().zip(products).map(|(a, b)| a * b).sum::<f64>();
        let load =
            |i: usize, _| Complex::new(part(&self.rows[i].load, real), part(&self.rows[i].load, imaginary));
        DVector::from_fn(self.rows.len(), load)
    }

    /// Dynamic stiffness of each row where rows are uncoupled.
    fn stiffness_apart(&self, frequency: f64) -> impl Iterator<Item = Complex<f64>> {
        let factors: Vec<[f64; 2]> = self.losses.iter().map(|loss| loss.law.factor(frequency)).collect();
        self.rows.iter().enumerate().map(move |(i, row)| {
            let mut stiffness = Complex::from(row.square - frequency * frequency);
            for (loss, [re, im]) in self.losses.iter().zip(&factors) {
                stiffness += loss.matrix[(i, i)] * Complex::new(*re, *im);
            }
            stiffness
        })
    }

    fn answer_coupled(
        &self,
        frequency: f64,
        mean_spin: [f64; 3],
        loads: &DVector<Complex<f64>>,
    ) -> Option<DVector<Complex<f64>>> {
        self.stiffness(frequency, mean_spin).lu().solve(loads)
    }

    /// `C − ν²M + iνB − iν ω̄·W`, with the moduli of materials and the forces of liquids. (C10), (C11)
    fn stiffness(&self, frequency: f64, mean_spin: [f64; 3]) -> DMatrix<Complex<f64>> {
        let mut stiffness = self.mass.map(|mass| Complex::from(-frequency * frequency * mass));
        for (i, row) in self.rows.iter().enumerate() {
            stiffness[(i, i)] += row.square;
        }
        for Loss { law, matrix } in &self.losses {
            let [re, im] = law.factor(frequency);
            stiffness += matrix.map(|entry| Complex::new(re, im) * entry);
        }
        for (matrix, spin) in self.turning.iter().zip(mean_spin) {
            stiffness += matrix.map(|entry| Complex::new(0.0, -frequency * spin * entry));
        }
        for (start, memory) in &self.memories {
            let force = self.memory_force(memory, frequency, mean_spin);
            let mut own = stiffness.view_mut((*start, *start), force.shape());
            own += force;
        }
        stiffness
    }

    /// Force of a liquid between its axes per displacement. (C11)
    pub(super) fn memory_force(
        &self,
        memory: &LiquidMemory,
        frequency: f64,
        mean_spin: [f64; 3],
    ) -> DMatrix<Complex<f64>> {
        let spin = (0..3)
            .fold(Vector3::zeros(), |sum, i| sum + mean_spin[i] * Vector3::from(self.principal.axes[i]));
        let s = Complex::new(0.0, frequency);
        let force = impedance(memory, s, spin);
        let axis = |i: usize| Vector3::from(memory.axes[i]).map(Complex::from);
        let count = memory.axes.len();
        DMatrix::from_fn(count, count, |i, j| s * axis(i).dot(&(force * axis(j))))
    }

    /// Drops the vibrations that no load excites, where all rows are uncoupled.
    fn without_idle(mut self) -> Self {
        if !self.apart {
            return self;
        }
        let energy = |row: &LoadedMode| row.load.iter().map(|load| load * load / row.square).sum::<f64>();
        let largest = self.elastic().map(energy).fold(0.0, f64::max);
        let significant =
            |row: &LoadedMode| row.square == 0.0 || energy(row) > COUPLING_ROUNDING.powi(2) * largest;
        let kept: Vec<usize> = (0..self.rows.len()).filter(|i| significant(&self.rows[*i])).collect();
        let part = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
        self.rows = kept.iter().map(|i| self.rows[*i].clone()).collect();
        self.mass = part(&self.mass);
        self.turning = self.turning.each_ref().map(part);
        self.losses.iter_mut().for_each(|loss| loss.matrix = part(&loss.matrix));
        self
    }
}

impl Law {
    /// Factor at a frequency `ν > 0` (rad/s): real and imaginary part.
    pub(super) fn factor(&self, frequency: f64) -> [f64; 2] {
        match self {
            Self::Dashpots => [0.0, frequency],
            Self::Material(rheology) => {
                let [re, im] = rheology.modulus(frequency);
                [re - 1.0, im]
            }
        }
    }
}

/// `e·W x` of the cyclic coordinates. (C2)
pub(super) fn turned(body: &FlexibleBody, axis: [f64; 3], x: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; x.len()];
    let cyclic = body.cyclic();
    for j in cyclic.clone() {
        for (k, pair) in body.invariants().pairs.row(j).filter(|(k, _)| cyclic.contains(k)) {
            force[j] += vec3::dot(axis, pair.Z) * x[k];
        }
    }
    force
}

/// Liquids with rows of their own: the last rows, in their order.
pub(super) fn memories(body: &FlexibleBody, rows: &[LoadedMode]) -> Vec<(usize, LiquidMemory)> {
    let count: usize = body.memories().iter().map(|memory| memory.axes.len()).sum();
    let mut next = rows.len() - count;
    let place = |memory: &LiquidMemory| {
        let start = next;
        next += memory.axes.len();
        (start, memory.clone())
    };
    body.memories().iter().map(place).collect()
}

fn is_diagonal(matrix: &DMatrix<f64>) -> bool {
    let size = matrix.nrows();
    (0..size).all(|i| {
        (0..size).all(|j| {
            i == j
                || matrix[(i, j)].powi(2)
                    <= COUPLING_ROUNDING.powi(2) * matrix[(i, i)].abs() * matrix[(j, j)].abs()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::averaging::{FreeRotation, MeanPower};
    use crate::problems::ring_of_points;

    /// The error of the projection is of the fourth power of spin over elastic frequency.
    #[test]
    fn excited_modes_take_the_power_of_all() {
        let body = ring_of_points(30).body().unwrap();
        let [whole, few] = [usize::MAX, 0].map(|whole| Response::within(&body, whole).unwrap());
        assert!(few.rows.len() < 60, "{}", few.rows.len());
        assert!(whole.rows.len() == 90 || whole.apart, "{}", whole.rows.len());
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
