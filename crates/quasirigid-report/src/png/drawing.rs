//! Drawing of a picture by resvg with the fonts of the machine.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};

use super::PngError;

/// Families tried for the words, the first that the machine has.
const FAMILIES: [&str; 5] = ["Helvetica", "Arial", "Liberation Sans", "DejaVu Sans", "Noto Sans"];

/// An SVG file as a PNG file of a width in pixels.
pub fn drawn(svg: &str, pixels: u32) -> Result<Vec<u8>, PngError> {
    let drawing = |cause: &dyn std::fmt::Display| PngError::Drawing(cause.to_string());
    let fonts = if svg.contains("<text") { fonts()? } else { Database::new() };
    let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|cause| drawing(&cause))?;
    let scale = pixels as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round().max(1.0) as u32;
    let mut picture = Pixmap::new(pixels, height).ok_or_else(|| drawing(&"it has no size"))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
    picture.encode_png().map_err(|cause| drawing(&cause))
}

/// The fonts of the machine, with one that is there for words without a family.
fn fonts() -> Result<Database, PngError> {
    let mut fonts = Database::new();
    fonts.load_system_fonts();
    let named =
        |family: &&str| fonts.faces().any(|face| face.families.iter().any(|(name, _)| name == family));
    let any = || fonts.faces().find_map(|face| face.families.first().map(|(name, _)| name.clone()));
    let known = FAMILIES.iter().find(|family| named(family)).map(|family| (*family).to_owned());
    let family = known.or_else(any).ok_or(PngError::NoFonts)?;
    fonts.set_sans_serif_family(family);
    Ok(fonts)
}
