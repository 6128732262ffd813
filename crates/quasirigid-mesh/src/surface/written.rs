//! A closed surface as it is written down: vertices and triangles, checked again when it is loaded.

use serde::{Deserialize, Serialize};

use super::{ClosedSurface, SurfaceError};

#[derive(Deserialize, Serialize)]
pub(super) struct Written {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
}

impl From<ClosedSurface> for Written {
    fn from(surface: ClosedSurface) -> Self {
        Self { vertices: surface.vertices, triangles: surface.triangles }
    }
}

impl TryFrom<Written> for ClosedSurface {
    type Error = SurfaceError;

    fn try_from(Written { vertices, triangles }: Written) -> Result<Self, SurfaceError> {
        Self::new(vertices, triangles)
    }
}
