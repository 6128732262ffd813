//! Sections of beams by their shapes, with n1 along the first axis: area, ∫ x1² dA, ∫ x2² dA, ∫ x1 x2 dA, torsion, shear factor.
//! (Abaqus Analysis User's Guide, *Beam cross-section library*)

use quasirigid_elements::SectionShape;

use crate::deck::sections::{boxed, summed};

/// Constants of a section.
pub(super) struct Profile {
    pub area: f64,
    pub moments: [f64; 3],
    pub torsion: f64,
    /// Factor of the area under shear.
    pub shear: f64,
    /// Whether the section is drawn away from its centroid.
    pub off_centre: bool,
}

/// The section of a shape and its sizes; none where it is not carried or a size is not positive.
pub(super) fn profile(shape: &str, sizes: &[f64]) -> Option<Profile> {
    let of = |kind: SectionShape, shear: f64| {
        let section = kind.section(0.0).ok()?;
        let moments = [section.second_z, section.second_y, 0.0];
        Some(Profile { area: section.area, moments, torsion: section.torsion, shear, off_centre: false })
    };
    let at = |index: usize| sizes.get(index).copied().unwrap_or(0.0);
    match shape {
        "RECT" | "RECTANGULAR" => {
            let height = if at(1) > 0.0 { at(1) } else { at(0) };
            of(SectionShape::Rectangle { height, width: at(0) }, 0.85)
        }
        "CIRC" | "CIRCULAR" => of(SectionShape::Circle { radius: at(0) }, 0.89),
        "PIPE" => of(SectionShape::Tube { radius: at(0), thickness: at(1) }, 0.53),
        "BOX" => {
            let walls = [at(2), at(3), at(4), at(5)];
            let same = walls.iter().all(|wall| *wall == walls[0]);
            if same {
                return of(SectionShape::Box { height: at(1), width: at(0), thickness: walls[0] }, 0.44);
            }
            // walls at +1, +2, −1, −2; pieces have 1 upwards
            let [right, top, left, bottom] = walls;
            let fits = at(0) > right + left && at(1) > top + bottom && walls.iter().all(|wall| *wall > 0.0);
            fits.then(|| ours(boxed([at(1), at(0)], [right, left, top, bottom]), 0.44, true))
        }
        "I" => {
            // l, h, b1, b2, t1, t2, t3: the web along 2, lower flange first
            let [origin, h, lower, upper, t_lower, t_upper, web] = std::array::from_fn(at);
            let inner = h - t_lower - t_upper;
            let sizes = [h, lower, upper, t_lower, t_upper, web, inner];
            let pieces = [
                [0.5 * t_lower, 0.0, t_lower, lower],
                [t_lower + 0.5 * inner, 0.0, inner, web],
                [h - 0.5 * t_upper, 0.0, t_upper, upper],
            ];
            let centre: f64 = pieces.iter().map(|piece| piece[0] * piece[2] * piece[3]).sum::<f64>()
                / pieces.iter().map(|piece| piece[2] * piece[3]).sum::<f64>();
            let off_centre = (origin - centre).abs() > 1e-9 * h;
            sizes.iter().all(|size| *size > 0.0).then(|| ours(summed(&pieces), 0.44, off_centre))
        }
        "L" => {
            // a along 1, b along 2, thickness of the leg along 1, of the leg along 2
            let [a, b, along, up] = std::array::from_fn(at);
            let pieces =
                [[0.5 * along, 0.5 * a, along, a], [along + 0.5 * (b - along), 0.5 * up, b - along, up]];
            let fits = [a, b, along, up, b - along, a - up].iter().all(|size| *size > 0.0);
            fits.then(|| ours(summed(&pieces), 1.0, true))
        }
        _ => None,
    }
}

/// A section of pieces as a profile.
fn ours((area, moments, torsion): (f64, [f64; 3], f64), shear: f64, off_centre: bool) -> Profile {
    Profile { area, moments, torsion, shear, off_centre }
}
