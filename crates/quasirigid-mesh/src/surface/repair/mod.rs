//! Repair of triangles that nearly bound a body, each step with its count.
//!
//! Nothing is invented unless small holes are to be closed: a hole stays open, and crossing parts are not united. A surface that needs no repair is taken as it is.

mod caps;
mod facets;
mod orient;
mod weld;

use std::fmt;

use thiserror::Error;

use super::closed::check;
use super::holes::holes;
use super::parts::used;
use super::topology::sides;
use super::{ClosedSurface, Hole, SurfaceError};
pub use caps::{LARGEST_SHARE, Unclosed};

/// Repairs that were made to triangles, with their counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Repairs {
    /// Corners that became one with an earlier one.
    pub merged: usize,
    /// Distance (m) within which corners were merged; zero where they were at the same place.
    pub within: f64,
    /// Facets without area that were left out.
    pub degenerate: usize,
    /// Copies of facets that were left out.
    pub repeated: usize,
    /// Facets back to back, between parts that are one body now, that were left out.
    pub walls: usize,
    /// Facets turned around to agree with their neighbours.
    pub reversed: usize,
    /// Shells turned inside out as a whole.
    pub inverted: usize,
    /// Corners of no facet that were left out.
    pub unused: usize,
    /// Holes closed by caps.
    pub holes: usize,
    /// Length of their rims (m).
    pub rims: f64,
    /// Area of the caps (m²).
    pub caps: f64,
    /// Their share of the surface.
    pub share: f64,
}

impl Repairs {
    /// Whether nothing was repaired.
    #[must_use]
    pub fn none(&self) -> bool {
        *self == Self::default()
    }

    /// Every repair that was made, by its name, with the count.
    #[must_use]
    pub fn counts(&self) -> Vec<(&'static str, usize)> {
        let all = [
            ("corners merged", self.merged),
            ("degenerate facets dropped", self.degenerate),
            ("repeated facets dropped", self.repeated),
            ("walls between touching parts dropped", self.walls),
            ("facets turned around", self.reversed),
            ("shells turned inside out", self.inverted),
            ("unused corners dropped", self.unused),
            ("holes closed", self.holes),
        ];
        all.into_iter().filter(|(_, count)| *count > 0).collect()
    }
}

impl fmt::Display for Repairs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (name, count)) in self.counts().into_iter().enumerate() {
            let comma = if place > 0 { ", " } else { "" };
            let within = match (name, self.within) {
                ("corners merged", 0.0) => " at the same place".to_owned(),
                ("corners merged", within) => format!(" within {within:.1e} m"),
                ("holes closed", _) => {
                    let Self { rims, caps, share, .. } = self;
                    let percent = 100.0 * share;
                    format!(" by caps ({rims:.3e} m around, {caps:.3e} m², {percent:.2} % of the surface)")
                }
                _ => String::new(),
            };
            write!(f, "{comma}{count} {name}{within}")?;
        }
        Ok(())
    }
}

/// Triangles that bound no body even after repair.
#[derive(Clone, Debug, Error, PartialEq)]
pub struct Unrepaired {
    /// First fault that is left. Its triangles are numbered as they are after the repair.
    pub fault: SurfaceError,
    /// Holes that are left, the one with the longest rim first.
    pub holes: Vec<Hole>,
    /// Cause for which they were not closed, where they were to be.
    pub unclosed: Option<Unclosed>,
}

/// Holes that a message lists.
const LISTED: usize = 3;

impl fmt::Display for Unrepaired {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { fault, holes, unclosed } = self;
        if !matches!(fault, SurfaceError::Open { .. }) {
            return write!(f, "{fault}");
        }
        let listed: Vec<String> = holes.iter().take(LISTED).map(Hole::to_string).collect();
        let (noun, more) = (if holes.len() == 1 { "hole" } else { "holes" }, holes.len() > LISTED);
        let more = if more { "; …" } else { "" };
        write!(f, "the surface has {} {noun}: {}{more}; ", holes.len(), listed.join("; "))?;
        match unclosed {
            Some(cause) => write!(f, "{cause}"),
            None => f.write_str("fill what is open"),
        }
    }
}

/// The surface of triangles that bound a body, or nearly do, with what was repaired.
///
/// In this order: corners on open edges are merged within the least distance that closes the surface, up to `10⁻⁵` of its size; facets
/// without area and copies are left out; facets turn to agree with their neighbours, and outer shells outward; corners of no facet go.
/// Parts that touch in facets back to back become one body.
///
/// # Errors
/// [`Unrepaired`] with the first fault that is left, and the holes.
pub fn repaired(
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
) -> Result<(ClosedSurface, Repairs), Unrepaired> {
    mended(vertices, triangles, false)
}

/// The same with holes closed by caps, which have at most [`LARGEST_SHARE`] of the surface together.
///
/// # Errors
/// [`Unrepaired`], with the cause for which holes were not closed.
pub fn closing(
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
) -> Result<(ClosedSurface, Repairs), Unrepaired> {
    mended(vertices, triangles, true)
}

fn mended(
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
    close: bool,
) -> Result<(ClosedSurface, Repairs), Unrepaired> {
    use SurfaceError::{NoSuchVertex, NotFinite};
    let mut draft = Draft { vertices, triangles, repairs: Repairs::default() };
    match check(&draft.vertices, &draft.triangles) {
        Ok(()) => {}
        Err(fault @ (NoSuchVertex { .. } | NotFinite { .. })) => {
            return Err(Unrepaired { fault, holes: Vec::new(), unclosed: None });
        }
        Err(_) => draft.repair(close)?,
    }
    let Draft { vertices, triangles, mut repairs } = draft;
    let all = vertices.len();
    let (vertices, triangles) = used(&vertices, triangles);
    repairs.unused = all - vertices.len() - repairs.merged;
    Ok((ClosedSurface::accepted(vertices, triangles), repairs))
}

/// Triangles under repair.
struct Draft {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
    repairs: Repairs,
}

impl Draft {
    fn repair(&mut self, close: bool) -> Result<(), Unrepaired> {
        self.drop_collapsed();
        self.drop_repeats();
        self.weld();
        self.drop_repeats();
        self.orient();
        let unclosed = if close { self.close().err() } else { None };
        self.flatten();
        self.turn_outward();
        let Err(fault) = check(&self.vertices, &self.triangles) else { return Ok(()) };
        if matches!(fault, SurfaceError::SelfIntersecting { .. }) && self.join() {
            self.turn_outward();
            if check(&self.vertices, &self.triangles).is_ok() {
                return Ok(());
            }
        }
        Err(Unrepaired { fault, holes: holes(&self.vertices, &self.triangles), unclosed })
    }

    /// Number of edges of one facet only.
    fn open_edges(&self) -> usize {
        sides(&self.triangles).chunk_by(|a, b| a.edge == b.edge).filter(|group| group.len() == 1).count()
    }
}
