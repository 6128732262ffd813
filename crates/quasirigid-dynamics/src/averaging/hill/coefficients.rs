//! Modal coefficients of Hill's equations: mass, loss, Coriolis and centrifugal matrices of the internal motion at given angular momentum.
//! Kept per component and per product of the angular velocity, so that every polhode and every harmonic reuses them; `J⁻¹` terms are the
//! recoil of the body.
//! Equations (H2), (H3) and (H5), docs/theory/14-spinning-frame.md; (C2) and (C11), docs/theory/13-inside.md.

use nalgebra::{Complex, DMatrix, Vector3};

use super::span::span;
use crate::averaging::loaded_modes::{LoadedMode, loaded_modes_in};
use crate::averaging::response::{Law, Loss, memories, turned};
use crate::math::eigen::NoConvergence;
use crate::math::krylov::dot;
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{self, add, cross, scale};
use crate::model::impedance;
use crate::model::{FlexibleBody, LiquidMemory, Principal, Viscoelastic};

/// Axes of the products xx, yy, zz, yz, zx, xy.
const PRODUCTS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];

/// Coefficients of the internal motion in the spinning frame, in modal coordinates: vibrations, then relaxations and liquids. (H3)
#[derive(Clone, Debug)]
pub(super) struct Coefficients {
    pub principal: Principal,
    pub rows: Vec<LoadedMode>,
    /// Number of vibrations, the first rows.
    pub elastic: usize,
    /// `A'`, the body free to recoil.
    pub mass: DMatrix<f64>,
    /// Dashpots, then materials.
    pub losses: Vec<Loss>,
    /// Liquids whose force at a frequency is known, each with its first row.
    pub memories: Vec<(usize, LiquidMemory)>,
    /// `Y + W` per unit of angular velocity about each principal axis: force per rate. (H2), (C2)
    pub coriolis: [DMatrix<f64>; 3],
    /// `Yᵀ` per unit of angular velocity about each principal axis: generalised momentum per displacement. (H2)
    pub momentum: [DMatrix<f64>; 3],
    /// `N'` per product of the angular velocity. (H3)
    pub centrifugal: [DMatrix<f64>; 6],
    /// First-order change of inertia of each row, body axes.
    pub inertia: Vec<Sym>,
}

impl Coefficients {
    /// The coefficients of a body, in all vibrations of one with up to `whole` elastic coordinates, otherwise in those that
    /// the loads excite.
    ///
    /// # Errors
    /// [`NoConvergence`] if an eigenvalue solver fails.
    pub fn compute(body: &FlexibleBody, whole: usize) -> Result<Self, NoConvergence> {
        let principal = Principal::compute(body.invariants().J);
        let basis = if body.elastic() > whole { Some(span(body, &principal)?) } else { None };
        let rows = loaded_modes_in(body, &principal, |_| basis.clone())?;
        let view = View { body, rows: &rows };
        let elastic = rows.iter().filter(|row| row.square > 0.0).count();
        let turn = sym3::inverse(body.invariants().J);
        let inertia: Vec<Sym> = rows.iter().map(|row| inertia(body, &row.shape)).collect();
        let recoil = |row: usize, column: usize| vec3::dot(rows[row].h, sym3::times(turn, rows[column].h));
        let mass = view.matrix(|x| body.mass_times(x)) - view.entries(recoil);
        let Y = principal.axes.map(|axis| {
            let shift =
                |j: usize, k: usize| vec3::dot(sym3::times(inertia[j], axis), sym3::times(turn, rows[k].h));
            view.matrix(|x| coupled(body, axis, x)) - view.entries(shift)
        });
        let W = principal.axes.map(|axis| view.matrix(|x| turned(body, axis, x)));
        let centrifugal = PRODUCTS.map(|pair| {
            let [a, b] = pair.map(|axis| principal.axes[axis]);
            let half = |a: [f64; 3], b: [f64; 3], j: usize, k: usize| {
                vec3::dot(sym3::times(inertia[j], a), sym3::times(turn, sym3::times(inertia[k], b)))
            };
            let twice = if pair[0] == pair[1] { 0.5 } else { 1.0 };
            let recoil = |j: usize, k: usize| twice * (half(a, b, j, k) + half(b, a, j, k));
            view.matrix(|x| softening(body, [a, b], 2.0 * twice, x)) - view.entries(recoil)
        });
        Ok(Self {
            elastic,
            mass,
            losses: losses(body, &view),
            memories: memories(body, &rows),
            momentum: Y.each_ref().map(DMatrix::transpose),
            coriolis: [0, 1, 2].map(|axis| &Y[axis] + &W[axis]),
            centrifugal,
            inertia,
            principal,
            rows,
        })
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// Sum of matrices weighted by the components or products of the angular velocity.
    pub fn mean<const M: usize>(&self, matrices: &[DMatrix<f64>; M], spin: [f64; M]) -> DMatrix<f64> {
        let zero = DMatrix::zeros(self.size(), self.size());
        matrices.iter().zip(spin).fold(zero, |sum, (matrix, spin)| sum + matrix * spin)
    }

    /// Force of the liquids per rate at the frequency `nu` (rad/s), about a mean angular velocity (rad/s, principal axes). (C11)
    pub fn impedance(&self, nu: f64, mean_spin: [f64; 3]) -> DMatrix<Complex<f64>> {
        let mut force = DMatrix::zeros(self.size(), self.size());
        let spin = Vector3::from(self.principal.vector(mean_spin));
        for (start, memory) in &self.memories {
            let D = impedance(memory, Complex::new(0.0, nu), spin);
            for (i, a) in memory.axes.iter().enumerate() {
                for (j, b) in memory.axes.iter().enumerate() {
                    let [a, b] = [a, b].map(|axis| Vector3::from(*axis).map(Complex::from));
                    force[(start + i, start + j)] += a.dot(&(D * b));
                }
            }
        }
        force
    }

    /// Factor of a loss law at the frequency `nu` (rad/s). In the mean a material that flows without limit is elastic: the strain from
    /// flow is not part of the model. (H5)
    pub fn factor(law: &Law, nu: f64) -> Complex<f64> {
        if nu > 0.0 {
            let [re, im] = law.factor(nu);
            return Complex::new(re, im);
        }
        match law {
            Law::Dashpots => Complex::from(0.0),
            Law::Material(rheology) => {
                let [re, _] = rheology.modulus(f64::MIN_POSITIVE.sqrt());
                Complex::from(if re.is_finite() && re > f64::EPSILON { re - 1.0 } else { 0.0 })
            }
        }
    }
}

/// Projection of a body on its rows.
struct View<'a> {
    body: &'a FlexibleBody,
    rows: &'a [LoadedMode],
}

impl View<'_> {
    fn entries(&self, entry: impl Fn(usize, usize) -> f64) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows.len(), self.rows.len(), entry)
    }

    /// Projects a matrix on the rows, from its products with vectors over all coordinates.
    fn matrix(&self, times: impl Fn(&[f64]) -> Vec<f64>) -> DMatrix<f64> {
        let images: Vec<Vec<f64>> = self.rows.iter().map(|row| times(&row.shape)).collect();
        self.entries(|row, column| dot(&self.rows[row].shape, &images[column]))
    }
}

fn losses(body: &FlexibleBody, view: &View) -> Vec<Loss> {
    let dashpots = Loss { law: Law::Dashpots, matrix: view.matrix(|x| view.body.damping().times(x)) };
    let material = |Viscoelastic { rheology, stiffness }: &Viscoelastic| Loss {
        law: Law::Material(rheology.clone()),
        matrix: view.matrix(|x| stiffness.times(x)),
    };
    std::iter::once(dashpots).chain(body.viscoelastic().iter().map(material)).collect()
}

/// `Σ x_j J_j`.
fn inertia(body: &FlexibleBody, x: &[f64]) -> Sym {
    let parts = body.invariants().J1.iter().zip(x).take(body.elastic());
    parts.fold([0.0; 6], |mut sum, (J, x)| {
        sum.iter_mut().zip(J).for_each(|(sum, entry)| *sum += x * entry);
        sum
    })
}

/// First moment `Σ x_j S_j` of the elastic coordinates.
fn moment(body: &FlexibleBody, x: &[f64]) -> [f64; 3] {
    let parts = body.invariants().S.iter().zip(x).take(body.elastic());
    parts.fold([0.0; 3], |sum, (S, x)| add(sum, scale(*x, *S)))
}

/// `e·Z x` on the elastic coordinates, with the translation of a free body eliminated. (S6)
pub(super) fn coupled(body: &FlexibleBody, axis: [f64; 3], x: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; x.len()];
    let invariants = body.invariants();
    for (j, k, pair) in invariants.pairs.iter().take_while(|(j, ..)| *j < body.elastic()) {
        force[j] += vec3::dot(axis, pair.Z) * x[k];
    }
    if let Some(per_mass) = body.translation() {
        let turned = scale(-per_mass, cross(moment(body, x), axis));
        let elastic = force.iter_mut().zip(&invariants.S).take(body.elastic());
        elastic.for_each(|(force, S)| *force += vec3::dot(*S, turned));
    }
    force
}

/// `factor · a·J_jk b x_k`, with the translation of a free body eliminated. (S6)
pub(super) fn softening(body: &FlexibleBody, [a, b]: [[f64; 3]; 2], factor: f64, x: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; x.len()];
    let invariants = body.invariants();
    for (j, k, pair) in invariants.pairs.iter().take_while(|(j, ..)| *j < body.elastic()) {
        force[j] += factor * vec3::dot(a, sym3::times(pair.J2, b)) * x[k];
    }
    if let Some(per_mass) = body.translation() {
        let s = moment(body, x);
        let across = scale(-0.5, add(scale(vec3::dot(s, b), a), scale(vec3::dot(s, a), b)));
        let change = scale(-per_mass * factor, add(scale(vec3::dot(a, b), s), across));
        let elastic = force.iter_mut().zip(&invariants.S).take(body.elastic());
        elastic.for_each(|(force, S)| *force += vec3::dot(*S, change));
    }
    force
}
