//! Sections of rectangles: area, moments and torsion; the twist of open ones is that of thin walls.

/// A rectangle of a section: centre and size along z and y; plane 1 bends along y.
pub(crate) type Piece = [f64; 4];

/// A box: outer width and height, thicknesses of top, bottom, left and right walls; torsion by Bredt's formula.
pub(crate) fn boxed([width, height]: [f64; 2], [top, bottom, left, right]: [f64; 4]) -> (f64, [f64; 3], f64) {
    let inner = height - top - bottom;
    let pieces = [
        [0.0, 0.5 * (height - top), width, top],
        [0.0, -0.5 * (height - bottom), width, bottom],
        [0.5 * (width - left), 0.5 * (bottom - top), left, inner],
        [-0.5 * (width - right), 0.5 * (bottom - top), right, inner],
    ];
    let (area, moments, open) = summed(&pieces);
    let (w, h) = (width - 0.5 * (left + right), height - 0.5 * (top + bottom));
    let torsion = 4.0 * (w * h).powi(2) / (w / top + w / bottom + h / left + h / right);
    (area, moments, torsion + open)
}

/// Area, moments about the centroid and torsion constant `⅓ Σ b t³` of rectangles.
pub(crate) fn summed(pieces: &[Piece]) -> (f64, [f64; 3], f64) {
    let area: f64 = pieces.iter().map(|[_, _, width, height]| width * height).sum();
    let centre =
        |axis: usize| pieces.iter().map(|piece| piece[axis] * piece[2] * piece[3]).sum::<f64>() / area;
    let (z, y) = (centre(0), centre(1));
    let mut moments = [0.0; 3];
    let mut torsion = 0.0;
    for [pz, py, width, height] in pieces {
        let part = width * height;
        moments[0] += part * (height.powi(2) / 12.0 + (py - y).powi(2));
        moments[1] += part * (width.powi(2) / 12.0 + (pz - z).powi(2));
        moments[2] += part * (py - y) * (pz - z);
        let (long, short) = (width.max(*height), width.min(*height));
        torsion +=
            long * short.powi(3) * (1.0 / 3.0 - 0.21 * short / long * (1.0 - (short / long).powi(4) / 12.0));
    }
    (area, moments, torsion)
}
