//! A computed light curve beside a measured one, whose scale is free in each block.

use serde::Serialize;

use super::epochs::Epoch;

/// Comparison with measured brightness.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualsObject {
    /// Root mean square of measured over computed brightness less one over the points that a free scale of each block leaves; `null` where it
    /// leaves none.
    pub rms: f64,
    /// Blocks.
    pub blocks: Vec<BlockObject>,
    /// Measured brightness in the scale of the computed one (m²).
    #[serde(skip)]
    pub scaled: Vec<f64>,
    /// Measured over computed brightness less one.
    #[serde(skip)]
    pub each: Vec<f64>,
}

/// A block of measured brightness.
#[derive(Clone, Debug, Serialize)]
pub struct BlockObject {
    /// Number of the block, from 1.
    pub block: usize,
    /// Number of points.
    pub points: usize,
    /// Factor (m²) of the measured brightness.
    pub scale: f64,
    /// Root mean square of the residuals of the block.
    pub rms: f64,
}

impl ResidualsObject {
    /// None where not every time has a measured brightness.
    pub fn of(epochs: &[Epoch], brightness: &[f64]) -> Option<Self> {
        let measured = epochs.iter().map(|epoch| epoch.measured).collect::<Option<Vec<f64>>>()?;
        let last = epochs.iter().map(|epoch| epoch.block).max()?;
        let (mut scaled, mut each) = (vec![0.0; measured.len()], vec![0.0; measured.len()]);
        let mut blocks = Vec::new();
        for block in 0..=last {
            let rows: Vec<usize> = (0..epochs.len()).filter(|row| epochs[*row].block == block).collect();
            // relative residuals y s/m − 1 without a mean: the scale is not drawn down by noise
            let scale =
                rows.len() as f64 / rows.iter().map(|row| measured[*row] / brightness[*row]).sum::<f64>();
            for row in &rows {
                scaled[*row] = scale * measured[*row];
                each[*row] = scale * measured[*row] / brightness[*row] - 1.0;
            }
            let rms = root_mean_square(rows.iter().map(|row| each[*row]));
            if !rows.is_empty() {
                blocks.push(BlockObject { block: block + 1, points: rows.len(), scale, rms });
            }
        }
        let free = (each.len() - blocks.len()) as f64;
        let squares: f64 = each.iter().map(|value| value * value).sum();
        let rms = if free > 0.0 { (squares / free).sqrt() } else { f64::NAN };
        Some(Self { rms, blocks, scaled, each })
    }
}

fn root_mean_square(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    (values.map(|value| value * value).sum::<f64>() / count).sqrt()
}
