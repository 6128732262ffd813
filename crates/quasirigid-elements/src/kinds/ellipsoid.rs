//! Homogeneous elastic ellipsoid: a whole body from displacements that are polynomials of first and third degree.
//! A rotation loads it linearly in the position, so its static response lies in this space exactly and no mesh is needed.
//! Equations (G2) to (G4), docs/theory/11-materials.md.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use crate::contribution::BuildOptions;
use crate::contribution::{SingleElementBody, WholeBody};
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, at};
use crate::material::Material;
use crate::math::sparse::SparseRows;
use crate::math::sym3::Sym;
use crate::model::moment;
use crate::model::{Coordinate, FlexibleBody, Invariants, Marker, Pair, Rheology};
use crate::number;
use crate::structure::Block;
use crate::visual::ellipsoid;
use crate::{Assembly, Incomplete, PartReduction, Visual};

/// A homogeneous triaxial ellipsoid, elastic throughout: a body without a carrier. (G2)–(G4)
///
/// The body frame is the Tisserand frame: the displacement has neither linear nor angular momentum. The displacements are all those of
/// first and third degree in the position, 36 coordinates; the loads of a free rotation deform a homogeneous ellipsoid in just such a
/// shape, so the static response is exact.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Unique name.
    pub name: String,
    /// Semi-axes (m) along x, y, z of the file's frame.
    pub semi_axes: [f64; 3],
    /// Centre (m), in the file's frame.
    pub center: [f64; 3],
    /// Material of the solid.
    pub material: Material,
}

/// `factor · ξ^i η^j ζ^k` along an axis, where `ξ, η, ζ` are the coordinates over the semi-axes.
#[derive(Clone, Copy)]
struct Term {
    axis: usize,
    exponents: [usize; 3],
    factor: f64,
}

/// A displacement field (m) per unit of its coordinate (m).
struct Shape {
    terms: Vec<Term>,
    name: String,
}

/// Products of odd numbers, `(2n − 1)!!`.
const ODD: [f64; 6] = [1.0, 1.0, 3.0, 15.0, 105.0, 945.0];

impl Ellipsoid {
    /// Flexible body of the ellipsoid.
    fn body(&self, place: ElementId) -> Result<FlexibleBody, ElementError> {
        self.check_values(place)?;
        let shapes = self.shapes();
        let coordinate =
            |shape: &Shape| Coordinate { name: format!("\"{}\" {}", self.name, shape.name), unit: "m" };
        let whole = SingleElementBody {
            place,
            center: self.center,
            invariants: self.invariants(&shapes),
            block: self.block(&shapes),
            coordinates: shapes.iter().map(coordinate).collect(),
            markers: (0..3).map(|axis| self.tip(axis, &shapes)).collect(),
        };
        whole.body()
    }

    /// First error among the values of the ellipsoid.
    fn check_values(&self, place: ElementId) -> Result<(), ElementError> {
        self.semi_axes
            .iter()
            .try_for_each(|axis| number::positive(*axis))
            .map_err(at(place, Field::SEMI_AXES))?;
        number::finite(&self.center).map_err(at(place, Field::CENTER))?;
        self.material.check(place)
    }

    /// The 36 shapes: three stretches, three shears without angular momentum, and thirty cubic ones, each less the rotation that it
    /// contains. (G3)
    fn shapes(&self) -> Vec<Shape> {
        let mut shapes = Vec::with_capacity(36);
        for axis in 0..3 {
            let mut exponents = [0; 3];
            exponents[axis] = 1;
            shapes.push(Shape {
                terms: vec![Term { axis, exponents, factor: 1.0 }],
                name: format!("stretch {}", letter(axis)),
            });
        }
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let [b, c] = [next, last].map(|i| self.semi_axes[i]);
            let [mut first, mut second] = [[0; 3]; 2];
            first[last] = 1;
            second[next] = 1;
            let terms = vec![
                Term { axis: next, exponents: first, factor: b / (b + c) },
                Term { axis: last, exponents: second, factor: c / (b + c) },
            ];
            shapes.push(Shape { terms, name: format!("shear {}{}", letter(next), letter(last)) });
        }
        for axis in 0..3 {
            for exponents in crate::math::polynomial::monomial::exponents(3) {
                let cubic = Term { axis, exponents, factor: 1.0 };
                let mut terms = vec![cubic];
                terms.extend(self.rotation_in(cubic));
                shapes.push(Shape { terms, name: format!("{} as {}", letter(axis), monomial(exponents)) });
            }
        }
        shapes
    }

    /// Rotation that cancels the angular momentum of a displacement.
    fn rotation_in(&self, term: Term) -> Vec<Term> {
        let h = moment::cross(&self.moment(&self.position(), &[term]));
        let about = |axis: usize| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let [b, c] = [next, last].map(|i| self.semi_axes[i]);
            let turn = -h[axis] / (self.second_moment(next) + self.second_moment(last));
            let [mut first, mut second] = [[0; 3]; 2];
            first[last] = 1;
            second[next] = 1;
            [
                Term { axis: next, exponents: first, factor: -turn * c },
                Term { axis: last, exponents: second, factor: turn * b },
            ]
        };
        (0..3).filter(|axis| h[*axis] != 0.0).flat_map(about).collect()
    }

    fn invariants(&self, shapes: &[Shape]) -> Invariants {
        let position = self.position();
        let J: Sym = moment::inertia(&self.moment(&position, &position)).map(|entry| 0.5 * entry);
        let still = vec![[0.0; 3]; shapes.len()];
        let first = |shape: &Shape| moment::inertia(&self.moment(&position, &shape.terms));
        let mut pairs: Vec<(usize, usize, Pair)> = Vec::new();
        for (j, a) in shapes.iter().enumerate() {
            for (k, b) in shapes.iter().enumerate().skip(j) {
                let W = self.moment(&a.terms, &b.terms);
                if W != Matrix3::zeros() {
                    pairs.push((j, k, moment::straight_pair(&W)));
                    if j < k {
                        pairs.push((k, j, moment::straight_pair(&W.transpose())));
                    }
                }
            }
        }
        Invariants {
            mass: self.material.density * self.volume(),
            J,
            S: still.clone(),
            h: still,
            J1: shapes.iter().map(first).collect(),
            pairs: SparseRows::sum(shapes.len(), pairs),
        }
    }

    /// Stiffness over all shapes. (G4)
    fn block(&self, shapes: &[Shape]) -> Block {
        let energy = |a: &Shape, b: &Shape| {
            a.terms.iter().flat_map(|x| b.terms.iter().map(|y| self.strain(x, y))).sum::<f64>()
        };
        let mut stiffness = vec![vec![0.0; shapes.len()]; shapes.len()];
        for (j, a) in shapes.iter().enumerate() {
            for (k, b) in shapes.iter().enumerate().skip(j) {
                stiffness[j][k] = energy(a, b);
                stiffness[k][j] = stiffness[j][k];
            }
        }
        Block {
            name: self.name.clone(),
            columns: (0..shapes.len()).collect(),
            stiffness,
            damping: Vec::new(),
            rheology: self.material.rheology.clone(),
        }
    }

    /// Elastic energy of two displacements, `∫ (λ div u div v + 2G ε(u):ε(v)) dV`. (G4)
    fn strain(&self, a: &Term, b: &Term) -> f64 {
        let (shear, lame) = (self.material.shear(), self.material.lame());
        let same = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let mut energy = 0.0;
        for l in 0..3 {
            for m in 0..3 {
                let weight = lame * same(a.axis, l) * same(b.axis, m)
                    + shear * (same(a.axis, b.axis) * same(l, m) + same(a.axis, m) * same(b.axis, l));
                if weight != 0.0
                    && let (Some(du), Some(dv)) = (self.slope(a, l), self.slope(b, m))
                {
                    energy += weight * du.factor * dv.factor * self.integral(du.exponents, dv.exponents);
                }
            }
        }
        energy
    }

    /// Derivative of a term along an axis.
    fn slope(&self, term: &Term, along: usize) -> Option<Term> {
        let power = term.exponents[along];
        let mut exponents = term.exponents;
        exponents[along] = power.checked_sub(1)?;
        Some(Term { exponents, factor: term.factor * power as f64 / self.semi_axes[along], ..*term })
    }

    /// The place of a mass element as a field.
    fn position(&self) -> Vec<Term> {
        let along = |axis: usize| {
            let mut exponents = [0; 3];
            exponents[axis] = 1;
            Term { axis, exponents, factor: self.semi_axes[axis] }
        };
        (0..3).map(along).collect()
    }

    /// `∫ u vᵀ dm`.
    fn moment(&self, u: &[Term], v: &[Term]) -> Matrix3<f64> {
        let mut W = Matrix3::zeros();
        for a in u {
            for b in v {
                W[(a.axis, b.axis)] +=
                    self.material.density * a.factor * b.factor * self.integral(a.exponents, b.exponents);
            }
        }
        W
    }

    /// `∫ x² dm` along an axis.
    fn second_moment(&self, axis: usize) -> f64 {
        self.material.density * self.volume() * self.semi_axes[axis].powi(2) / 5.0
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.semi_axes.iter().product::<f64>()
    }

    /// `∫ ξ^i η^j ζ^k dV` for the sum of two lists of exponents: `4π abc ∏(i−1)!!/(i+j+k+3)!!`, zero for an odd one.
    fn integral(&self, first: [usize; 3], second: [usize; 3]) -> f64 {
        let exponents = [0, 1, 2].map(|i| first[i] + second[i]);
        if exponents.iter().any(|power| power % 2 == 1) {
            return 0.0;
        }
        let odd: f64 = exponents.iter().map(|power| ODD[power / 2]).product();
        let all = ODD[exponents.iter().sum::<usize>() / 2 + 2];
        4.0 * PI * self.semi_axes.iter().product::<f64>() * odd / all
    }

    /// The end of a semi-axis.
    fn tip(&self, axis: usize, shapes: &[Shape]) -> Marker {
        let mut place = [0.0; 3];
        place[axis] = self.semi_axes[axis];
        let moved = |shape: &Shape| self.displaced(shape, place);
        Marker {
            name: format!("{} along {}", self.name, letter(axis)),
            position: place,
            shapes: shapes.iter().map(moved).enumerate().collect(),
            rotations: Vec::new(),
            curvature: Vec::new(),
            carried: None,
        }
    }

    /// Surface of the ellipsoid.
    fn visual(&self, id: ElementId) -> Visual {
        let shapes = self.shapes();
        let surface = ellipsoid(Vector3::zeros(), Matrix3::identity(), self.semi_axes.into());
        Visual::surface((id, &self.name), surface, |place| {
            shapes.iter().map(|shape| self.displaced(shape, place)).enumerate().collect()
        })
    }

    /// Displacement of a place (m from the centre) per unit of a coordinate.
    fn displaced(&self, shape: &Shape, place: [f64; 3]) -> [f64; 3] {
        let power = |term: &Term| -> f64 {
            (0..3)
                .map(|axis| (place[axis] / self.semi_axes[axis]).powi(term.exponents[axis] as i32))
                .product()
        };
        let moved =
            |sum: Vector3<f64>, term: &Term| sum + term.factor * power(term) * Vector3::ith(term.axis, 1.0);
        shape.terms.iter().fold(Vector3::zeros(), moved).into()
    }

    /// Pressure of self-gravity at the centre of the sphere of equal volume (Pa).
    #[must_use]
    pub fn central_pressure(&self) -> f64 {
        const GRAVITATION: f64 = 6.6743e-11;
        let square = self.semi_axes.iter().product::<f64>().cbrt().powi(2);
        2.0 / 3.0 * PI * GRAVITATION * self.material.density * self.material.density * square
    }
}

fn letter(axis: usize) -> char {
    ['x', 'y', 'z'][axis]
}

fn monomial(exponents: [usize; 3]) -> String {
    (0..3).flat_map(|axis| std::iter::repeat_n(letter(axis), exponents[axis])).collect()
}

impl Element for Ellipsoid {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        self.check_values(id).err().into_iter().collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        vec![Incomplete::Ellipsoids]
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        vec![&mut self.material.rheology]
    }

    fn homogeneous(&self) -> Option<&Material> {
        Some(&self.material)
    }

    fn whole(
        &self,
        id: ElementId,
        _: PartReduction,
        asked: BuildOptions,
    ) -> Result<Option<WholeBody>, ElementError> {
        let body = self.body(id)?;
        let visuals = if asked.visuals { vec![self.visual(id)] } else { Vec::new() };
        Ok(Some(WholeBody { body, condensation: None, resolution: None, visuals }))
    }
}
