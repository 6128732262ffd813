//! Stacks of TIFF pages: one page of grey values for each layer along z, as microtomographs and ImageJ write them.
//! What ImageJ says of its stacks in the first description is compared with the pages; resolutions are not read, since most programs write
//! those of a screen. (TIFF revision 6.0; ImageJ: TiffEncoder)

use std::io::Cursor;

use quasirigid_math::memory;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::{Fault, Grid, MOST, MeshProblem, Place, UNIT, VoxelProblem, counted, of_file};

/// Most bytes of a page as numbers of the file.
const PAGE: usize = 8 * MOST;
/// Photometric interpretation of pictures that are white at zero.
const WHITE_AT_ZERO: u32 = 0;

pub(super) fn read(bytes: &[u8]) -> Result<Grid, Fault> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = PAGE;
    limits.intermediate_buffer_size = PAGE;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(wrong)?.with_limits(limits);
    let told = decoder.find_tag(Tag::ImageDescription).ok().flatten();
    let told = told.and_then(|text| text.into_string().ok()).unwrap_or_default();
    let first = decoder.dimensions().map_err(wrong)?;
    let (mut values, mut pages) = (Vec::new(), 0);
    loop {
        pages += 1;
        check(&mut decoder, pages, first)?;
        let count = counted([first.0 as usize, first.1 as usize, pages]).map_err(of_file)?;
        memory::ask(8.0 * count as f64).map_err(|problem| (Place::File, MeshProblem::Memory(problem)))?;
        add(&decoder.read_image().map_err(wrong)?, &mut values);
        if values.len() != count {
            return Err(of_file(VoxelProblem::Length { announced: count, found: values.len() }));
        }
        if !decoder.more_images() {
            break;
        }
        decoder.next_image().map_err(wrong)?;
    }
    compare(&told, pages).map_err(of_file)?;
    if let Some(found) = values.iter().find(|value| value.is_infinite()) {
        return Err(of_file(VoxelProblem::NoLabel { found: found.to_string() }));
    }
    Ok(Grid { sizes: [first.0 as usize, first.1 as usize, pages], values, corner: [0.0; 3], edges: UNIT })
}

fn wrong(error: tiff::TiffError) -> Fault {
    of_file(VoxelProblem::Tiff { detail: error.to_string() })
}

/// Accepts a page of grey values of the size of the first.
fn check(decoder: &mut Decoder<Cursor<&[u8]>>, page: usize, first: (u32, u32)) -> Result<(), Fault> {
    let refuse = |found: String, wanted: String| Err(of_file(VoxelProblem::Page { page, found, wanted }));
    let (width, height) = decoder.dimensions().map_err(wrong)?;
    if (width, height) != first {
        let wanted =
            format!("each page is a layer of {} by {} as the first; leave out previews", first.0, first.1);
        return refuse(format!("{width} by {height}"), wanted);
    }
    match decoder.colortype().map_err(wrong)? {
        ColorType::Gray(8 | 16 | 32 | 64) | ColorType::Palette(8 | 16) => {}
        other => {
            let wanted = "one value of 8 to 64 bits a voxel is read; save it in shades of grey";
            return refuse(format!("{other:?}"), wanted.to_owned());
        }
    }
    let photometric = decoder.find_tag_unsigned::<u32>(Tag::PhotometricInterpretation).map_err(wrong)?;
    if photometric == Some(WHITE_AT_ZERO) {
        let wanted = "values grow with the brightness; save it with black at zero".to_owned();
        return refuse("white at zero".to_owned(), wanted);
    }
    Ok(())
}

fn add(page: &DecodingResult, values: &mut Vec<f64>) {
    match page {
        DecodingResult::U8(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::U16(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::U32(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::U64(all) => values.extend(all.iter().map(|value| *value as f64)),
        DecodingResult::I8(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::I16(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::I32(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::I64(all) => values.extend(all.iter().map(|value| *value as f64)),
        DecodingResult::F16(all) => values.extend(all.iter().map(|value| value.to_f64())),
        DecodingResult::F32(all) => values.extend(all.iter().map(|value| f64::from(*value))),
        DecodingResult::F64(all) => values.extend(all),
    }
}

/// Compares a description of ImageJ, lines such as `images=40`, with the pages: no channels, no times, no layer that is missing.
fn compare(description: &str, pages: usize) -> Result<(), VoxelProblem> {
    if !description.starts_with("ImageJ=") {
        return Ok(());
    }
    let number = |key: &str| -> Option<usize> {
        let line = description.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='))?;
        line.trim().parse().ok()
    };
    for (what, key, most) in [
        ("channels", "channels", 1),
        ("times", "frames", 1),
        ("layers", "slices", pages),
        ("images", "images", pages),
    ] {
        if let Some(told) = number(key).filter(|told| *told != most) {
            return Err(VoxelProblem::Stack { what, told, pages });
        }
    }
    Ok(())
}
