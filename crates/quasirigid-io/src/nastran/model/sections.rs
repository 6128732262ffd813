//! Sections of NASTRAN's library, PBARL and PBEAML: rounds in closed form, the others of rectangles; the twist of open ones is that of thin walls.

use crate::deck::sections::{Piece, boxed, summed};

/// Area, moments in plane 1 and 2 with the product, and torsion constant of a section of the library.
///
/// MSC Nastran Quick Reference Guide, PBARL: y is up, z to the left; here the pieces stand as `[z, y, width along z, height along y]`.
pub(super) fn library_section(kind: &str, d: &[f64]) -> Option<(f64, [f64; 3], f64)> {
    use std::f64::consts::PI;
    let round = |outer: f64, inner: f64| {
        let moment = 0.25 * PI * (outer.powi(4) - inner.powi(4));
        (PI * (outer.powi(2) - inner.powi(2)), [moment, moment, 0.0], 2.0 * moment)
    };
    let pieces: Vec<Piece> = match (kind, d) {
        ("ROD", [r]) => return Some(round(*r, 0.0)),
        ("TUBE", [outer, inner]) => return Some(round(*outer, *inner)),
        ("TUBE2", [outer, wall]) => return Some(round(*outer, outer - wall)),
        ("BAR", [width, height]) => vec![[0.0, 0.0, *width, *height]],
        ("BOX", [w, h, flange, wall]) => return Some(boxed([*w, *h], [*flange, *flange, *wall, *wall])),
        ("BOX1", [w, h, top, bottom, left, right]) => {
            return Some(boxed([*w, *h], [*top, *bottom, *left, *right]));
        }
        ("I", [h, lower, upper, web, t_lower, t_upper]) => vec![
            [0.0, 0.5 * t_lower, *lower, *t_lower],
            [0.0, 0.5 * (t_lower + h - t_upper), *web, h - t_lower - t_upper],
            [0.0, h - 0.5 * t_upper, *upper, *t_upper],
        ],
        ("I1", [flanges, web, inner, h]) => {
            let flange = 0.5 * (h - inner);
            let width = flanges + web;
            vec![
                [0.0, 0.5 * flange, width, flange],
                [0.0, 0.5 * h, *web, *inner],
                [0.0, h - 0.5 * flange, width, flange],
            ]
        }
        ("H", [inner, walls, h, bridge]) => {
            let wall = 0.5 * walls;
            let arm = 0.5 * (inner + wall);
            vec![[-arm, 0.0, wall, *h], [arm, 0.0, wall, *h], [0.0, 0.0, *inner, *bridge]]
        }
        ("T" | "T2", [width, h, flange, web]) => {
            let side = if kind == "T" { 1.0 } else { -1.0 };
            let stem = h - flange;
            vec![[0.0, 0.0, *width, *flange], [0.0, -side * 0.5 * (flange + stem), *web, stem]]
        }
        ("T1", [h, web_length, flange, web]) => {
            vec![[0.0, 0.0, *flange, *h], [0.5 * (flange + web_length), 0.0, *web_length, *web]]
        }
        ("L", [width, h, foot, wall]) => {
            vec![[0.5 * (width - wall), 0.0, *width, *foot], [0.0, 0.5 * h, *wall, h - foot]]
        }
        ("CHAN", [width, h, web, flange]) => vec![
            [0.0, 0.5 * (h - flange), *width, *flange],
            [0.0, -0.5 * (h - flange), *width, *flange],
            [-0.5 * (width - web), 0.0, *web, h - 2.0 * flange],
        ],
        ("CHAN1", [flange_length, web, inner, h]) => {
            let flange = 0.5 * (h - inner);
            vec![
                [0.0, 0.0, *web, *h],
                [0.5 * (web + flange_length), 0.5 * (h - flange), *flange_length, flange],
                [0.5 * (web + flange_length), -0.5 * (h - flange), *flange_length, flange],
            ]
        }
        ("CHAN2", [wall, foot, h, width]) => vec![
            [0.0, 0.5 * foot, *width, *foot],
            [0.5 * (width - wall), 0.5 * (h + foot), *wall, h - foot],
            [-0.5 * (width - wall), 0.5 * (h + foot), *wall, h - foot],
        ],
        ("Z", [flange_length, web, inner, h]) => {
            let flange = 0.5 * (h - inner);
            let arm = 0.5 * (web + flange_length);
            vec![
                [0.0, 0.0, *web, *h],
                [arm, 0.5 * (h - flange), *flange_length, flange],
                [-arm, -0.5 * (h - flange), *flange_length, flange],
            ]
        }
        ("HAT", [h, wall, top, brim]) => {
            let (web, out) = (0.5 * (top - wall), 0.5 * (top + brim));
            let side = h - wall;
            vec![
                [0.0, h - 0.5 * wall, *top, *wall],
                [web, 0.5 * side, *wall, side],
                [-web, 0.5 * side, *wall, side],
                [out, 0.5 * wall, *brim, *wall],
                [-out, 0.5 * wall, *brim, *wall],
            ]
        }
        ("CROSS", [arms, web, h, thickness]) => vec![
            [0.0, 0.0, *web, *h],
            [0.5 * web + 0.25 * arms, 0.0, 0.5 * arms, *thickness],
            [-0.5 * web - 0.25 * arms, 0.0, 0.5 * arms, *thickness],
        ],
        _ => return None,
    };
    if pieces.iter().any(|[_, _, width, height]| !(*width > 0.0 && *height > 0.0)) {
        return None;
    }
    Some(summed(&pieces))
}
