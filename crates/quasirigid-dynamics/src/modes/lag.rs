//! Lag of the internal coordinates behind a motion of the direction of spin, exact at any eigenvalue. (M14)

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Vector3};

use super::spectrum::Eigenmotion;
use super::unknowns::Unknowns;
use crate::model::{FlexibleBody, SpinCoefficients, Viscoelastic, impedance};

type C = Complex<f64>;

/// Equations of the internal coordinates at a given motion of the body: those of the elastic ones, and of the rates of cyclic ones, among them
/// liquids by their impedance. (M14)
pub(super) struct Lag<'a> {
    unknowns: Unknowns<'a>,
    /// Steady spin (rad/s).
    omega: Vector3<f64>,
    /// Angular momentum per rate, one unknown per row: coordinates, then angles of liquids.
    h: DMatrix<C>,
    /// Change of the angular momentum with each elastic coordinate.
    slopes: DMatrix<C>,
    mass: DMatrix<C>,
    /// `B + G`.
    velocity: DMatrix<C>,
    /// `C − N` of the elastic coordinates.
    stiffness: DMatrix<C>,
    materials: Vec<(&'a Viscoelastic, DMatrix<C>)>,
    /// Static displacements per angular velocity.
    still: DMatrix<C>,
}

/// Response to a motion `e^{λt}` per angular velocity.
pub(super) struct Lagging {
    /// Eigenvalue (1/s).
    pub lambda: C,
    /// Angular momentum per rate of the angular velocity, `L(λ)` (kg·m²·s).
    pub momentum: Matrix3<C>,
    /// Elastic displacements, and what they lag behind those in balance, over `λ`.
    displaced: DMatrix<C>,
    late: DMatrix<C>,
    /// Displacements of the cyclic coordinates, and angles of liquids.
    turned: DMatrix<C>,
}

/// Number of coordinates up to which the response is found.
const MAX_COORDINATES: usize = 150;

impl<'a> Lag<'a> {
    /// None of large bodies.
    pub fn of(body: &'a FlexibleBody, coefficients: &SpinCoefficients, omega: Vector3<f64>) -> Option<Self> {
        let SpinCoefficients { mass, slopes, gyroscopic, centrifugal, .. } = coefficients;
        let unknowns = Unknowns::exact(body);
        let (n, elastic) = (unknowns.size - 3, body.elastic());
        if n > MAX_COORDINATES {
            return None;
        }
        let block = |list: &[[f64; 3]]| DMatrix::from_fn(list.len(), 3, |j, axis| C::from(list[j][axis]));
        let h: Vec<[f64; 3]> = unknowns.couplings(coefficients).map(|(h, _)| h).collect();
        let mut velocity = DMatrix::zeros(n, n);
        let mut own = DMatrix::zeros(n, n);
        let place = |j: usize| unknowns.kept.iter().position(|kept| *kept == j);
        for (row, j) in unknowns.kept.iter().enumerate() {
            for (column, k) in unknowns.kept.iter().enumerate() {
                velocity[(row, column)] = C::from(gyroscopic.at(*j, *k));
                own[(row, column)] = C::from(mass.at(*j, *k));
            }
        }
        for (j, k, B) in body.damping().iter() {
            if let Some((row, column)) = place(j).zip(place(k)) {
                velocity[(row, column)] += B;
            }
        }
        let within = |j: usize, k: usize| j < elastic && k < elastic;
        let mut stiffness = DMatrix::from_fn(elastic, elastic, |j, k| C::from(-centrifugal.at(j, k)));
        for (j, k, C) in body.stiffness().iter().filter(|(j, k, _)| within(*j, *k)) {
            stiffness[(j, k)] += C;
        }
        let material = |viscoelastic: &'a Viscoelastic| {
            let mut own = DMatrix::zeros(elastic, elastic);
            for (j, k, C) in viscoelastic.stiffness.iter().filter(|(j, k, _)| within(*j, *k)) {
                own[(j, k)] += C::from(*C);
            }
            (viscoelastic, own)
        };
        let slopes = block(&slopes[..elastic]);
        let still = if elastic > 0 { stiffness.clone().lu().solve(&slopes)? } else { slopes.clone() };
        Some(Self {
            omega,
            h: block(&h),
            slopes,
            mass: own,
            velocity,
            stiffness,
            materials: body.viscoelastic().iter().map(material).collect(),
            still,
            unknowns,
        })
    }

    /// True if a material or a liquid depends on the frequency by a law of its own.
    pub fn has_memory(&self) -> bool {
        self.unknowns.nonlinear
    }

    /// Second variation of the energy that a motion has beside that of its angular momentum alone, `½[dᴴ(C−N)d + q̇ᴴAq̇ − |λ|²(Lω)ᴴS⁻¹Lω]`, with
    /// `S = ∂K/∂ω`, and the power that dashpots take. No term in it is a small difference. (M15)
    pub fn energy_and_power(
        &self,
        lagging: &Lagging,
        motion: &Eigenmotion,
        inverse: &Matrix3<f64>,
    ) -> [f64; 2] {
        let delta = Vector3::from(motion.delta);
        let behind = &lagging.late * delta * lagging.lambda;
        let rate = DVector::from_column_slice(&motion.rate);
        let turned = lagging.momentum * delta;
        let form = |x: &DVector<C>, matrix: &DMatrix<C>| (x.adjoint() * matrix * x)[(0, 0)].re;
        let carried =
            (turned.adjoint() * inverse.map(C::from) * turned)[(0, 0)].re * lagging.lambda.norm_sqr();
        let energy = form(&behind, &self.stiffness) + form(&rate, &self.mass) - carried;
        [0.5 * energy, form(&rate, &self.velocity)]
    }

    /// Response at an eigenvalue that is not zero; none where it has no finite value, as for a cyclic coordinate without friction at rest.
    ///
    /// The static part is split off before the division by `λ`, so that no digit is lost however slow the motion is.
    pub fn at(&self, lambda: C) -> Option<Lagging> {
        let (n, elastic) = (self.h.nrows(), self.still.nrows());
        let mut dynamic = &self.mass * lambda + &self.velocity;
        for (start, memory) in &self.unknowns.memories {
            let Z = impedance(memory, lambda, self.omega);
            let axes = memory.axes.iter().map(|axis| Vector3::from(*axis).map(C::from));
            for (i, a) in axes.clone().enumerate() {
                let entries = axes.clone().map(|b| a.dot(&(Z * b)));
                entries.enumerate().for_each(|(j, entry)| dynamic[(start + i, start + j)] += entry);
            }
        }
        let mut equations = dynamic.clone();
        let mut displaced = equations.columns_mut(0, elastic);
        displaced *= lambda;
        let mut own = equations.view_mut((0, 0), (elastic, elastic));
        own += &self.stiffness;
        let mut load = -(&self.h + dynamic.columns(0, elastic) * &self.still);
        for (viscoelastic, stiffness) in &self.materials {
            let [re, im] = viscoelastic.rheology.continued([lambda.re, lambda.im]);
            let factor = C::new(re - 1.0, im);
            own += stiffness * factor;
            let mut loaded = load.rows_mut(0, elastic);
            loaded -= stiffness * &self.still * (factor / lambda);
        }
        let late = if n > 0 { equations.lu().solve(&load)? } else { load };
        let turned = late.rows(elastic, n - elastic).into_owned();
        let late = late.rows(0, elastic).into_owned();
        let displaced = &self.still + &late * lambda;
        let momentum = self.slopes.transpose() * &late
            + self.h.rows(0, elastic).transpose() * &displaced
            + self.h.rows(elastic, n - elastic).transpose() * &turned;
        let momentum = momentum.fixed_view::<3, 3>(0, 0).into_owned();
        let finite = momentum.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite());
        finite.then_some(Lagging { lambda, momentum, displaced, late, turned })
    }
}

impl Lagging {
    /// The same displacements in a motion without a rate.
    pub fn standing(self) -> Self {
        Self { lambda: C::from(0.0), ..self }
    }

    /// Motion of all coordinates with a change of the angular velocity.
    pub fn motion(&self, lag: &Lag, delta: Vector3<C>) -> Eigenmotion {
        let mut x: Vec<C> = delta.iter().copied().collect();
        x.extend((&self.displaced * delta).iter().chain((&self.turned * delta).iter()));
        let angles = x[3 + lag.unknowns.kept.len()..].to_vec();
        Eigenmotion { angles, ..lag.unknowns.motion(&(self.lambda, x)) }
    }
}
