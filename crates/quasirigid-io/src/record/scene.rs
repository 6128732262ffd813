//! Scene of a run: what a viewer needs to draw the body as it moves. Arrays are packed, so that a page may carry them.
//! The layout is that of version 2; a reader refuses others. How its arrays are packed stands in docs/guide/19-reports.md, too.

use std::borrow::Cow;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Version of the layout.
pub const SCENE_VERSION: u32 = 2;

/// Scene: visual geometry, motion, modes and reduced equations. SI units, body axes, places from the pole.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SceneRecord {
    /// Version of the layout.
    pub version: u32,
    /// Name of the body.
    pub name: String,
    /// Radius of the sphere about the pole that holds the body at equilibrium (m).
    pub radius: f64,
    /// Internal coordinates.
    pub coordinates: Vec<CoordinateRecord>,
    /// Visual geometry, element by element.
    pub pieces: Vec<PieceRecord>,
    /// Principal moments and axes.
    pub principal: PrincipalRecord,
    /// The main history; none where nothing was propagated.
    pub track: Option<TrackRecord>,
    /// Steady spin of the modes (rad/s).
    pub spin: Option<[f64; 3]>,
    /// Small motions about the steady spin.
    pub modes: Vec<ShapeRecord>,
    /// Reduced equations; none where they do not exist for this body.
    pub equations: Option<EquationsRecord>,
}

/// Internal coordinate.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct CoordinateRecord {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
}

/// Visual geometry of an element: vertices joined by lines and triangles, or points.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct PieceRecord {
    /// Name of the element; empty for one without.
    pub name: String,
    /// Words for the kind of the element.
    pub kind: String,
    /// Vertices at equilibrium (m).
    pub vertices: VectorsRecord,
    /// Triangles, three vertices each.
    pub triangles: Option<Packed<u16>>,
    /// Lines, two vertices each.
    pub lines: Option<Packed<u16>>,
    /// Radius of points and lines (m).
    pub size: Option<f64>,
    /// Displacements, coordinate by coordinate.
    pub fields: Vec<FieldRecord>,
    /// Axis of a rotor.
    pub turning: Option<RotorAxisRecord>,
}

/// Displacement of vertices by a coordinate.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FieldRecord {
    /// Index of the coordinate.
    pub coordinate: usize,
    /// Displacement of each vertex (m) per unit of the coordinate.
    pub vectors: VectorsRecord,
}

/// Axis about which a piece turns.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RotorAxisRecord {
    /// Unit vector.
    pub axis: [f64; 3],
    /// Point of the axis (m).
    pub center: [f64; 3],
    /// Index among the rotors of the track.
    pub rotor: usize,
}

/// Principal moments and axes.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct PrincipalRecord {
    /// Moments (kg·m²), ascending.
    pub moments: [f64; 3],
    /// Unit vectors.
    pub axes: [[f64; 3]; 3],
}

/// Frames of a history, evenly among its rows.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct TrackRecord {
    /// `full`, `reduced` or `rigid`.
    pub system: String,
    /// Times (s).
    pub t: Packed<f64>,
    /// Attitudes: unit quaternions from body to inertial axes, scalar first.
    pub attitude: Packed<f32>,
    /// Angular velocities (rad/s).
    pub omega: Packed<f32>,
    /// Angular momenta (N·m·s), body axes.
    pub momentum: Packed<f32>,
    /// Internal coordinates, frame by frame.
    pub q: Option<Packed<f32>>,
    /// Angles of the rotors (rad), frame by frame.
    pub rotors: Option<Packed<f32>>,
    /// Energy dissipated since the start (J).
    pub dissipated: Packed<f64>,
}

/// Mode shape: the small motion is the real part of the vectors times `exp((rate + i frequency) t)`, in body axes.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ShapeRecord {
    /// Name of the mode.
    pub name: String,
    /// Frequency in body axes (rad/s).
    pub frequency: f64,
    /// Growth rate (1/s).
    pub rate: f64,
    /// Rotation from the steady attitude (rad), real and imaginary parts.
    pub rotation: [[f64; 2]; 3],
    /// Displacement of each coordinate, real and imaginary parts.
    pub q: Vec<[f64; 2]>,
}

/// Reduced equations as sums of homogeneous polynomials.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct EquationsRecord {
    /// Order.
    pub order: usize,
    /// Whether the powers of stiffness and damping in the terms are exact.
    pub scalable: bool,
    /// Reason for which they are not; empty where they are.
    pub note: String,
    /// Gradient of the energy (rad/s), of the angular momentum (N·m·s). (R16)
    pub energy_gradient: Vec<TermRecord>,
    /// Axial vector `c(K)` (1/(N·m·s)), of the angular momentum. (R18)
    pub c: Vec<TermRecord>,
    /// Tensor `T(K)` (s/(kg·m²)) of the dissipation, rows xx, yy, zz, yz, zx, xy, of the angular momentum. (R19)
    pub T: Vec<TermRecord>,
    /// Angular momentum `K(ω)` (N·m·s).
    pub momentum: Vec<TermRecord>,
    /// Energy (J), of the angular velocity.
    pub energy: Vec<TermRecord>,
    /// Power dissipated (W), of the angular velocity.
    pub power: Vec<TermRecord>,
    /// Internal coordinates, of the angular velocity.
    pub displacements: Vec<TermRecord>,
    /// Limits of the spin; none of equations that hold at any.
    pub limits: Vec<LimitRecord>,
    /// Start of the run.
    pub start: StartRecord,
}

/// Limit of the spin by one criterion, scaled by powers of common factors of all stiffnesses and all dampings.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct LimitRecord {
    /// Spin (rad/s) up to which the equations hold.
    #[serde(with = "super::number::unbounded")]
    pub holds: f64,
    /// Spin (rad/s) from which they fail.
    #[serde(with = "super::number::unbounded")]
    pub fails: f64,
    /// Power of the factor of the stiffnesses.
    pub stiffness: f64,
    /// Power of the factor of the dampings.
    pub damping: f64,
}

/// Homogeneous polynomial, scaled by powers of common factors of all stiffnesses and all dampings.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct TermRecord {
    /// Degree.
    pub degree: usize,
    /// Power of the factor of the stiffnesses.
    pub stiffness: i32,
    /// Power of the factor of the dampings.
    pub damping: i32,
    /// Coefficients, row by row, of `x^i y^j z^k` with `i`, then `j`, descending.
    pub values: Vec<Vec<f64>>,
}

/// State at the start.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct StartRecord {
    /// Angular momentum (N·m·s), body axes.
    #[serde(rename = "K")]
    pub momentum: [f64; 3],
    /// Attitude, scalar first.
    pub attitude: [f64; 4],
    /// Duration of the run (s).
    pub duration: f64,
}

/// Vectors as whole multiples of a unit: a page shows no more digits.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct VectorsRecord {
    /// The unit (m).
    pub unit: f64,
    /// Components in the unit, three for each vector.
    pub values: Packed<i16>,
}

impl VectorsRecord {
    /// Vectors in the unit that the largest component leaves.
    #[must_use]
    pub fn pack(vectors: &[[f64; 3]]) -> Self {
        let flat = vectors.as_flattened();
        let largest = flat.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        let unit = largest / f64::from(i16::MAX);
        let whole = |entry: &f64| if unit > 0.0 { (entry / unit).round() as i16 } else { 0 };
        Self { unit, values: Packed(flat.iter().map(whole).collect()) }
    }

    /// The vectors (m), to half a unit.
    #[must_use]
    pub fn unpack(&self) -> Vec<[f64; 3]> {
        let (vectors, _) = self.values.0.as_chunks::<3>();
        vectors.iter().map(|vector| vector.map(|entry| self.unit * f64::from(entry))).collect()
    }
}

/// Array in base64 of its little-endian bytes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Packed<T>(pub Vec<T>);

/// Number with a fixed number of bytes.
pub trait Bytes: Copy {
    /// Appends the little-endian bytes.
    fn append(self, bytes: &mut Vec<u8>);
    /// Reads the numbers of some bytes; none if the last one is cut off.
    fn read(bytes: &[u8]) -> Option<Vec<Self>>;
}

macro_rules! bytes {
    ($($number:ty),+) => {$(
        impl Bytes for $number {
            fn append(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }

            fn read(bytes: &[u8]) -> Option<Vec<Self>> {
                let (numbers, rest) = bytes.as_chunks();
                rest.is_empty().then(|| numbers.iter().map(|bytes| Self::from_le_bytes(*bytes)).collect())
            }
        }
    )+};
}

bytes!(f32, f64, i16, u16);

impl<T: Bytes> Serialize for Packed<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut bytes = Vec::with_capacity(self.0.len() * size_of::<T>());
        self.0.iter().for_each(|number| number.append(&mut bytes));
        serializer.serialize_str(&STANDARD.encode(bytes))
    }
}

impl<'de, T: Bytes> Deserialize<'de> for Packed<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Cow::<str>::deserialize(deserializer)?;
        let bytes = STANDARD.decode(text.as_bytes()).map_err(D::Error::custom)?;
        let numbers = T::read(&bytes).ok_or_else(|| D::Error::custom("a packed array is cut off"))?;
        Ok(Self(numbers))
    }
}
