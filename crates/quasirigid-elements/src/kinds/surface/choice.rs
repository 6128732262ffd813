//! Choice of the approximation of a solid: polynomials or finite elements, and of which size.

use super::elements::Meshed;
use super::error::{AGREED, CONVERGED, LEAST_ERROR, TAIL, between_meshes, hidden};
use super::{Approximation, PartReduction, Resolution, Surface, SurfaceBody};
use crate::contribution::BuildOptions;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::kinds::compliance;
use crate::kinds::ritz::Ritz;
use crate::math::watch;
use quasirigid_mesh::meshing::{Neck, graded, necks};

/// Degrees tried one after the other; the last one of convex bodies only.
const DEGREES: [usize; 5] = [4, 6, 8, 10, 12];
/// Number of cells of the first mesh, approximately, and of the second while the error is larger than wanted.
const CELLS: [usize; 2] = [6_000, 16_000];
/// Shares of the cells in the coarser mesh against which a mesh is judged; the second where the neck is too thin for the first.
const COARSER: [f64; 2] = [0.25, 0.5];
/// Error at which no finer mesh is tried, and above which an approximation is refused unless it was asked for.
const WANTED: f64 = 0.05;
const REFUSED: f64 = 0.5;

impl Surface {
    /// The body.
    ///
    /// # Errors
    /// [`ElementError`] for a value that no solid has, polynomials that are linearly dependent up to rounding, and a shape that no mesh
    /// made here resolves.
    pub(super) fn built(
        &self,
        place: ElementId,
        reduction: PartReduction,
        asked: BuildOptions,
    ) -> Result<SurfaceBody, ElementError> {
        self.check_values(place)?;
        let choice = ApproximationChoice { surface: self, place, reduction, visuals: asked.visuals };
        let told = asked.errors;
        match (self.degree, self.cells) {
            (Some(degree), _) => choice.of_degree(degree, told),
            (None, Some(cells)) => choice.of_cells(cells, told),
            (None, None) => choice.chosen(),
        }
    }
}

/// Methods of approximation of a solid.
struct ApproximationChoice<'a> {
    surface: &'a Surface,
    place: ElementId,
    reduction: PartReduction,
    /// Whether visual geometry is wanted.
    visuals: bool,
}

impl ApproximationChoice<'_> {
    fn polynomials(&self, degree: usize) -> Result<Ritz, ElementError> {
        self.surface.ritz(degree).map_err(at(self.place, Field::DEGREE))
    }

    fn of(&self, degree: usize, ritz: Ritz, error: f64) -> Result<SurfaceBody, ElementError> {
        let visuals = if self.visuals { vec![self.surface.visual(self.place, &ritz)] } else { Vec::new() };
        let body = self.surface.of_polynomials(self.place, ritz)?;
        let resolution = Resolution { approximation: Approximation::Polynomials { degree }, error };
        Ok(SurfaceBody { body, condensation: None, resolution, visuals })
    }

    /// Polynomials of a given degree, judged by finite elements unless the body is convex.
    fn of_degree(&self, degree: usize, told: bool) -> Result<SurfaceBody, ElementError> {
        let ritz = self.polynomials(degree)?;
        let own = (TAIL * ritz.growth).max(LEAST_ERROR);
        let mut found = self.of(degree, ritz, own)?;
        if told && !self.surface.surface.is_convex() {
            found.resolution.error = match self.judged(CELLS[0], &self.necks().unwrap_or_default()) {
                Ok(better) => {
                    let [mine, others] = [&found, &better].map(|found| compliance::of(&found.body));
                    let apart = compliance::gap(&mine, &others);
                    own.max(apart + (1.0 + apart) * better.resolution.error)
                }
                Err(_) => f64::INFINITY,
            };
        }
        Ok(found)
    }

    fn of_cells(&self, cells: usize, told: bool) -> Result<SurfaceBody, ElementError> {
        let necks = self.necks().unwrap_or_default();
        if told { self.judged(cells, &necks) } else { Ok(self.mesh(cells, &necks)?.found(f64::INFINITY)) }
    }

    /// Polynomials of a convex body, and of others without necks where they converge and cells agree; else cells.
    fn chosen(&self) -> Result<SurfaceBody, ElementError> {
        let convex = self.surface.surface.is_convex();
        let necks = if convex { Vec::new() } else { self.necks()? };
        if necks.is_empty() {
            let (degree, ritz) = self.converged(convex)?;
            let growth = ritz.growth;
            if convex {
                return self.of(degree, ritz, (TAIL * growth).max(LEAST_ERROR));
            }
            if growth < CONVERGED {
                let cells = self.mesh((COARSER[0] * CELLS[0] as f64) as usize, &necks);
                let mut found = self.of(degree, ritz, 0.0)?;
                let apart = cells.map_or(f64::INFINITY, |cells| {
                    compliance::gap(&compliance::of(&found.body), &compliance::of(&cells.body))
                });
                if apart < AGREED {
                    found.resolution.error = apart.max(TAIL * growth) + LEAST_ERROR;
                    return Ok(found);
                }
            }
        }
        self.by_cells(&necks)
    }

    /// Cells in one mesh or the other. The error that necks hide is known before anything is solved.
    fn by_cells(&self, necks: &[Neck]) -> Result<SurfaceBody, ElementError> {
        let hidden = CELLS.map(|cells| {
            let mesh = graded(&self.surface.surface, necks.first(), cells);
            mesh.map_or(0.0, |mesh| hidden(&self.surface.surface, &mesh, necks))
        });
        let least = hidden[0].min(hidden[1]);
        if least > REFUSED {
            return Err(self.unsettled(least));
        }
        let first = (hidden[0] <= WANTED).then(|| self.judged(CELLS[0], necks));
        let found = match first {
            Some(Ok(found)) if found.resolution.error <= WANTED => found,
            first => match (self.judged(CELLS[1], necks), first) {
                (Ok(finer), Some(Ok(first))) if first.resolution.error < finer.resolution.error => first,
                (Ok(finer), _) => finer,
                (Err(error), first) => {
                    first.unwrap_or_else(|| self.judged(CELLS[0], necks)).map_err(|_| error)?
                }
            },
        };
        if found.resolution.error > REFUSED {
            return Err(self.unsettled(found.resolution.error));
        }
        Ok(found)
    }

    fn unsettled(&self, error: f64) -> ElementError {
        at(self.place, Field::FILE)(Problem::Unsettled { error })
    }

    /// The first degree at which the compliance has converged, or the highest that rounding leaves.
    fn converged(&self, convex: bool) -> Result<(usize, Ritz), ElementError> {
        let offered = if convex { &DEGREES[..] } else { &DEGREES[..DEGREES.len() - 1] };
        let mut best = (offered[0], self.polynomials(offered[0])?);
        watch::stage("raising the degree of the polynomials");
        for degree in &offered[1..] {
            watch::progress((degree - offered[0]) as f64 / offered[offered.len() - 1] as f64);
            if best.1.growth < CONVERGED {
                break;
            }
            // Rounding may leave the degree between.
            let ritz = |degree: usize| Some((degree, self.surface.ritz(degree).ok()?));
            match ritz(*degree).or_else(|| ritz(degree - 1)) {
                Some(better) => best = better,
                None => break,
            }
        }
        Ok(best)
    }

    fn necks(&self) -> Result<Vec<Neck>, ElementError> {
        necks(&self.surface.surface).map_err(|error| self.unmeshed(error.into()))
    }

    /// Body of a mesh of about so many cells, with its error estimated from a coarser mesh. (G12)
    fn judged(&self, cells: usize, necks: &[Neck]) -> Result<SurfaceBody, ElementError> {
        let fine = self.mesh(cells, necks)?;
        let coarser = COARSER.into_iter().find_map(|part| {
            let cells = (part * cells as f64) as usize;
            self.mesh(cells, necks).ok().filter(|coarse| coarse.cells < fine.cells)
        });
        let error = coarser
            .map_or(f64::INFINITY, |coarse| between_meshes(&self.surface.surface, &fine, &coarse, necks));
        Ok(fine.found(error))
    }

    fn mesh(&self, cells: usize, necks: &[Neck]) -> Result<Meshed, ElementError> {
        Meshed::new(self.surface, self.place, cells, necks.first(), (self.reduction, self.visuals))
            .map_err(|problem| self.unmeshed(problem))
    }

    fn unmeshed(&self, problem: Problem) -> ElementError {
        at(self.place, Field::FILE)(Problem::Unmeshed { cause: Box::new(problem) })
    }
}
