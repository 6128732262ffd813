use nalgebra::{Matrix3, Vector3};

use crate::contribution::Attachment;
use crate::contribution::{Field as Shape, Piece};
use crate::math::expression::Expression;
use crate::math::sparse::SparseRows;
use crate::model::{Carried, Coordinate, CurvedPaths, Drive, Follower, Gimbal, Pair};

/// A rigid piece placed on the body, with the coordinates that move it.
pub(crate) struct MovingBody {
    /// Mass and moments about the base.
    pub piece: Piece,
    /// Place of the base (m), in the file's frame.
    pub base: Vector3<f64>,
    /// Map of the places on the piece to those from the base without displacements: the identity but of pieces that are turned or whose places
    /// are shares of a length.
    pub pose: Matrix3<f64>,
    /// One shape per coordinate, outermost first.
    pub shapes: Vec<Shape>,
    /// Curvature of the path of each pair of coordinates, `G_jk`.
    pub curvature: Vec<Vec<Shape>>,
    /// Hinge axes about which the piece rotates, outermost first; none of a material point, which has no orientation.
    pub axes: Vec<Vector3<f64>>,
    /// Whether places on it have an orientation, that of the carrier where it does not rotate.
    pub oriented: bool,
    /// Name and unit of each coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Place watched on the piece: its name, and its position from the base.
    pub marker: (String, Vector3<f64>),
    /// Other places on the piece at which springs and forces may act.
    pub places: Vec<(String, Vector3<f64>)>,
    /// Law of its only coordinate, where a drive moves it. (T7)
    pub law: Option<Expression>,
}

/// Second moment along a line, as a share of the whole, and first moment, as a share of its size, below which no mass is off the hinge
/// along the line: rounding.
const FLAT: [f64; 2] = [1e-15, 1e-14];

impl MovingBody {
    /// The piece locked at an angle (rad) about the only axis of its hinge.
    pub fn locked(self, angle: f64) -> Self {
        let axis = self.axes.first().map_or(Matrix3::zeros(), |axis| axis.cross_matrix());
        let pose = Matrix3::identity() + angle.sin() * axis + (1.0 - angle.cos()) * axis * axis;
        Self {
            pose,
            shapes: Vec::new(),
            curvature: Vec::new(),
            axes: Vec::new(),
            oriented: angle == 0.0, // what turns with a place elsewhere would have to be turned here (F22)
            coordinates: Vec::new(),
            law: None,
            ..self
        }
    }

    /// First moment (kg·m) about the origin of the file's frame.
    pub fn first_moment(&self) -> Vector3<f64> {
        self.piece.mass * self.base + self.pose * self.piece.first
    }

    /// Drive of its coordinate, with its coordinates numbered from `start`. (T7)
    pub fn drive(&self, start: usize) -> Option<Drive> {
        let law = self.law.clone()?;
        Some(Drive { name: self.marker.0.clone(), coordinate: start, law })
    }

    /// Axes of the hinge of the piece, with its coordinates numbered from `start`; none of a piece that does not rotate.
    fn gimbal(&self, start: usize) -> Option<Gimbal> {
        let axes = self.axes.iter().enumerate().map(|(j, axis)| (start + j, (*axis).into()));
        (!self.axes.is_empty()).then(|| Gimbal { axes: axes.collect() })
    }

    /// Fields `Ψ_e = L^e s` that with the coordinates hold every rotation of the mass, and the matrices `W^e` of their amplitudes. (I12)
    fn rotations(&self) -> Vec<(Shape, Matrix3<f64>)> {
        if let [axis] = self.axes.as_slice() {
            let [once, twice] = [axis.cross_matrix(), axis.cross_matrix() * axis.cross_matrix()];
            return [once, twice].map(|L| (Shape::linear(L), 0.5 * L)).to_vec();
        }
        let eigen = self.piece.second.symmetric_eigen();
        let lines =
            eigen.eigenvectors.column_iter().zip(eigen.eigenvalues.iter()).filter(|(line, moment)| {
                **moment > FLAT[0] * self.piece.second.trace()
                    || line.dot(&self.piece.first).abs() > FLAT[1] * self.piece.first.norm()
            });
        let fields =
            lines.flat_map(|(line, _)| (0..3).map(move |axis| Vector3::ith(axis, 1.0) * line.transpose()));
        fields.map(|L| (Shape::linear(L), L)).collect()
    }

    /// Replaces the second order of the paths of the piece by the fields of its rotation, in a body on straight paths about a pole. (I12)
    pub fn turn(&self, pole: Vector3<f64>, start: usize, paths: &mut CurvedPaths) {
        let Some(gimbal) = self.gimbal(start) else { return };
        let (rho, still) = (self.position(pole), Shape::constant(Vector3::zeros()));
        let (fields, duals): (Vec<Shape>, Vec<_>) = self.rotations().into_iter().unzip();
        let straight = &mut paths.straight;
        let (first, own) = (straight.S.len(), start..start + self.shapes.len());
        let others = straight.pairs.iter().filter(|(j, k, _)| !(own.contains(j) && own.contains(k)));
        let mut pairs: Vec<(usize, usize, Pair)> = others.map(|(j, k, pair)| (j, k, *pair)).collect();
        let numbered = || self.shapes.iter().chain(&fields).zip(own.clone().chain(first..));
        for (u, j) in numbered() {
            pairs.extend(numbered().map(|(v, k)| (j, k, self.piece.pair(&rho, u, v, &still))));
        }
        for field in &fields {
            straight.S.push(self.piece.sum(field));
            straight.h.push(self.piece.cross(&rho, field));
            straight.J1.push(self.piece.inertia(&rho, field));
        }
        straight.pairs = SparseRows::sum(straight.S.len(), pairs);
        let rows = |W: Matrix3<f64>| W.transpose().data.0;
        paths.followers.push(Follower::Rotation { gimbal, duals: duals.into_iter().map(rows).collect() });
    }

    /// Position field of the piece from a pole.
    pub fn position(&self, pole: Vector3<f64>) -> Shape {
        Shape { constant: self.base - pole, linear: self.pose }
    }

    /// Invariants of the coordinates of the piece with each other, numbered from `start`. (I4)–(I6)
    pub fn pairs(&self, pole: Vector3<f64>, start: usize) -> impl Iterator<Item = (usize, usize, Pair)> + '_ {
        let rho = self.position(pole);
        let count = self.shapes.len();
        (0..count * count).map(move |entry| {
            let (j, k) = (entry / count, entry % count);
            let pair = self.piece.pair(&rho, &self.shapes[j], &self.shapes[k], &self.curvature[j][k]);
            (start + j, start + k, pair)
        })
    }

    /// Places on the piece, with its coordinates numbered from `start`: the watched one, then the others.
    pub fn attachments(&self, start: usize) -> impl Iterator<Item = Attachment> + '_ {
        let all = std::iter::once(&self.marker).chain(&self.places);
        all.map(move |(name, s)| self.place(name, s, start))
    }

    /// A place on the piece, at `s` (m) from its base, with its coordinates numbered from `start`.
    pub fn place(&self, name: &str, s: &Vector3<f64>, start: usize) -> Attachment {
        let displaced = |shape: &Shape| -> [f64; 3] { (shape.constant + shape.linear * s).into() };
        let turn = |shape: &Shape| -> [f64; 3] {
            // the axial vector of a skew matrix
            let L = &shape.linear;
            [L[(2, 1)], L[(0, 2)], L[(1, 0)]]
        };
        let shapes = || self.shapes.iter().enumerate();
        let curved = self.curvature.iter().enumerate().flat_map(|(j, row)| {
            row.iter().enumerate().map(move |(k, G)| (start + j, start + k, displaced(G)))
        });
        Attachment {
            name: name.to_owned(),
            position: self.base + self.pose * s,
            shapes: shapes().map(|(j, H)| (start + j, displaced(H))).collect(),
            rotations: self.oriented.then(|| shapes().map(|(j, H)| (start + j, turn(H))).collect()),
            curvature: curved.filter(|(.., G)| *G != [0.0; 3]).collect(),
            carried: self.gimbal(start).map(|gimbal| Carried { gimbal, arm: (*s).into() }),
        }
    }
}
