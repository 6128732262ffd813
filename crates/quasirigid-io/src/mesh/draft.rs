//! Builder of surfaces that all formats share: vertices, polygons with the lines they stand in, and what there is to tell of the file.

use earcut::Earcut;
use earcut::utils3d::project3d_to_2d;
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use super::TriangleMesh;
use super::error::{Fault, MeshProblem, Place, Row};

/// Height of a corner over the plane of its polygon, as a share of the polygon's size, above which it is told.
const BENT: f64 = 1e-3;

/// Surface while its file is read.
#[derive(Default)]
pub(super) struct Draft {
    pub vertices: Vec<[f64; 3]>,
    /// Corners of the polygons, one polygon after the other, as the file numbers them.
    corners: Vec<u32>,
    polygons: Vec<Polygon>,
    /// Faces of one or two corners, which have no area.
    pub flat: usize,
    /// Remarks on the file.
    pub remarks: Vec<String>,
    /// Length of one unit (m) that the file itself states, with its words.
    pub unit: Option<(f64, String)>,
}

/// End of a polygon among the corners, and its line; 0 where lines mean nothing.
struct Polygon {
    end: u32,
    line: u32,
}

impl Draft {
    pub(super) fn new() -> Self {
        Self::default()
    }

    /// Number of polygons, with those that have no area.
    pub(super) fn faces(&self) -> u64 {
        (self.polygons.len() + self.flat) as u64
    }

    /// Adds a polygon; one of fewer than three corners is counted and left out.
    pub(super) fn polygon(&mut self, corners: &[u32], line: usize) {
        if corners.len() < 3 {
            self.flat += 1;
            return;
        }
        self.corners.extend(corners);
        let [end, line] = [self.corners.len(), line].map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        self.polygons.push(Polygon { end, line });
    }

    /// Lowest number of a corner.
    pub(super) fn lowest(&self) -> Option<u32> {
        self.corners.iter().copied().min()
    }

    /// The triangles, of corners that are numbered from `first`.
    pub(super) fn finish(mut self, first: u32) -> Result<TriangleMesh, Fault> {
        let count = self.vertices.len();
        let mut start = 0;
        for Polygon { end, line } in &self.polygons {
            let corners = &mut self.corners[start..*end as usize];
            start = *end as usize;
            for corner in corners {
                let index = corner.checked_sub(first).filter(|index| (*index as usize) < count);
                *corner = index.ok_or_else(|| {
                    let place = if *line == 0 { Place::File } else { Place::Line(*line as usize) };
                    let found = corner.to_string().into();
                    (place, MeshProblem::NoSuchVertex { found, first: first as usize, vertices: count })
                })?;
            }
        }
        let triangles = self.triangles();
        if self.flat > 0 {
            let (flat, faces) = (self.flat, if self.flat == 1 { "face" } else { "faces" });
            self.remarks.push(format!("{flat} {faces} of fewer than three corners left out"));
        }
        let Self { vertices, remarks, unit, .. } = self;
        Ok(TriangleMesh { vertices, triangles, remarks, unit })
    }

    fn triangles(&mut self) -> Vec<[usize; 3]> {
        let mut triangles = Vec::with_capacity(self.corners.len() - 2 * self.polygons.len());
        let (mut start, mut bent) = (0, 0);
        let mut cut = Cut { earcut: Earcut::new(), places: Vec::new(), plane: Vec::new(), ears: Vec::new() };
        for Polygon { end, .. } in &self.polygons {
            let corners = &self.corners[start..*end as usize];
            start = *end as usize;
            if let [a, b, c] = corners {
                triangles.push([*a, *b, *c].map(|corner| corner as usize));
            } else {
                bent += usize::from(cut.polygon(corners, &self.vertices, &mut triangles));
            }
        }
        if bent > 0 {
            let polygons = if bent == 1 { "polygon is" } else { "polygons are" };
            self.remarks
                .push(format!("{bent} {polygons} not plane: the surface there is that of their triangles"));
        }
        triangles
    }
}

/// Cutting of polygons into triangles, with its memory.
struct Cut {
    earcut: Earcut<f64>,
    places: Vec<[f64; 3]>,
    plane: Vec<[f64; 2]>,
    ears: Vec<u32>,
}

impl Cut {
    /// Adds the triangles of a polygon: a fan about its first corner, or ears where the fan would leave the polygon. Whether the polygon is
    /// far from plane.
    fn polygon(&mut self, corners: &[u32], vertices: &[[f64; 3]], triangles: &mut Vec<[usize; 3]>) -> bool {
        let from = vertices[corners[0] as usize];
        self.places.clear();
        self.places.extend(corners.iter().map(|corner| add(vertices[*corner as usize], scale(-1.0, from))));
        let fan = |k: usize| cross(self.places[k], self.places[k + 1]);
        let sides = 1..corners.len() - 1;
        let normal = sides.clone().map(fan).fold([0.0; 3], add);
        let convex = sides.clone().all(|k| dot(fan(k), normal) >= 0.0);
        let size = self.places.iter().copied().map(norm).fold(0.0, f64::max);
        let height = self.places.iter().map(|place| dot(*place, normal).abs()).fold(0.0, f64::max);
        let bent = height > BENT * size * norm(normal);
        self.ears.clear();
        if !convex && project3d_to_2d(&self.places, corners.len(), &mut self.plane) {
            self.earcut.earcut(self.plane.iter().copied(), &[], &mut self.ears);
        }
        let corner = |k: usize| corners[k] as usize;
        let (ears, _) = self.ears.as_chunks::<3>();
        // Every vertex of the polygon stays a corner, so that neighbours find their edges.
        if ears.len() == sides.len() {
            let area = |ear: &[u32; 3]| {
                let [a, b, c] = ear.map(|k| self.places[k as usize]);
                dot(cross(add(b, scale(-1.0, a)), add(c, scale(-1.0, a))), normal)
            };
            let reversed = ears.iter().map(area).sum::<f64>() < 0.0;
            let turned = |[a, b, c]: &[u32; 3]| if reversed { [*a, *c, *b] } else { [*a, *b, *c] };
            triangles.extend(ears.iter().map(|ear| turned(ear).map(|k| corner(k as usize))));
        } else {
            triangles.extend(sides.map(|k| [corner(0), corner(k), corner(k + 1)]));
        }
        bent
    }
}

/// The number of a corner as a file writes it.
pub(super) fn number_of_corner(
    word: &str,
    row: Row,
    vertices: usize,
    first: usize,
) -> Result<u32, MeshProblem> {
    if word.is_empty() || !word.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(MeshProblem::NotANumber { found: word.into(), row });
    }
    word.parse().map_err(|_| MeshProblem::NoSuchVertex { found: word.into(), first, vertices })
}

impl Draft {
    /// Tells that corners are numbered from 0, where that is not the rule of the format.
    pub(super) fn numbered_from(&mut self, first: u32) {
        if first == 0 {
            self.remarks.push("corners are numbered from 0, since one of them is 0".into());
        }
    }
}
