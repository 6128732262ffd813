//! Pictures in pixels from SVG files of figures, by resvg with the fonts of the machine.

#[cfg(feature = "png")]
mod drawing;

#[cfg(feature = "png")]
use drawing::drawn;
use thiserror::Error;

/// Failure to make a picture in pixels.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PngError {
    /// The program was built without PNG pictures.
    #[error(
        "this program was built without PNG pictures; make an SVG picture, or build it with `--features png`"
    )]
    Absent,
    /// The machine has no font to draw text with.
    #[error("this machine has no fonts to draw the words of a PNG picture with; make an SVG picture")]
    NoFonts,
    /// The size is out of range.
    #[error("a picture can be {least} to {most} pixels wide, not {pixels}")]
    Size {
        /// Width asked for.
        pixels: u32,
        /// Least width.
        least: u32,
        /// Greatest width.
        most: u32,
    },
    /// The SVG file is not one that can be drawn.
    #[error("the picture could not be drawn: {0}")]
    Drawing(String),
}

/// Widths of pictures.
const MIN_WIDTH: u32 = 64;
const MAX_WIDTH: u32 = 16_384;

/// An SVG file of a figure as a PNG file of this width in pixels, on its own background.
///
/// # Errors
/// [`PngError`].
pub fn png(svg: &str, pixels: u32) -> Result<Vec<u8>, PngError> {
    if !(MIN_WIDTH..=MAX_WIDTH).contains(&pixels) {
        return Err(PngError::Size { pixels, least: MIN_WIDTH, most: MAX_WIDTH });
    }
    drawn(svg, pixels)
}

#[cfg(not(feature = "png"))]
fn drawn(_svg: &str, _pixels: u32) -> Result<Vec<u8>, PngError> {
    Err(PngError::Absent)
}
