//! Stacks of TIFF pages, written here in each number, packing and byte order, and one that another program wrote; what is no stack is refused.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use miniz_oxide::deflate::compress_to_vec_zlib;
use quasirigid_io::mesh::{MeshError, VolumeFile, read_volume, volume_of};

const SIZES: [usize; 3] = [5, 4, 3];

/// Labels, with runs for PackBits and every tenth empty.
fn label(at: usize) -> i64 {
    if at % 10 == 3 { 0 } else { 1 + (at / 7 % 3) as i64 }
}

/// A kind of number: bits, and the code of its format, of 1 unsigned, 2 signed and 3 real numbers.
type Number = (usize, u16);

/// Packing by its code: 1 none, 5 LZW, 8 Deflate, 32773 PackBits.
const PACKINGS: [u16; 4] = [1, 5, 8, 32773];

struct Writer {
    big: bool,
    bytes: Vec<u8>,
}

impl Writer {
    fn short(&mut self, value: u16) {
        self.bytes.extend(if self.big { value.to_be_bytes() } else { value.to_le_bytes() });
    }

    fn long(&mut self, value: u32) {
        self.bytes.extend(if self.big { value.to_be_bytes() } else { value.to_le_bytes() });
    }
}

fn packed(packing: u16, data: &[u8]) -> Vec<u8> {
    match packing {
        5 => lzw(data),
        8 => compress_to_vec_zlib(data, 6),
        32773 => runs(data),
        _ => data.to_vec(),
    }
}

/// Runs of equal bytes, and single bytes as they are.
fn runs(data: &[u8]) -> Vec<u8> {
    let mut all = Vec::new();
    for run in data.chunk_by(|a, b| a == b) {
        for part in run.chunks(128) {
            all.extend([if part.len() == 1 { 0 } else { (1 - part.len() as i16) as u8 }, part[0]]);
        }
    }
    all
}

/// Single bytes as codes of nine bits; the table is cleared before its codes grow longer.
fn lzw(data: &[u8]) -> Vec<u8> {
    let mut codes = Vec::new();
    for part in data.chunks(200) {
        codes.push(256);
        codes.extend(part.iter().map(|byte| u16::from(*byte)));
    }
    codes.push(257);
    let mut bits: Vec<bool> =
        codes.iter().flat_map(|code| (0..9).rev().map(move |bit| code >> bit & 1 == 1)).collect();
    bits.resize(bits.len().div_ceil(8) * 8, false);
    bits.chunks(8).map(|byte| byte.iter().fold(0, |all, bit| all << 1 | u8::from(*bit))).collect()
}

fn number((bits, format): Number, value: i64, big: bool) -> Vec<u8> {
    let bytes =
        if format == 3 { u64::from((value as f32).to_bits()).to_le_bytes() } else { value.to_le_bytes() };
    let mut bytes = bytes[..bits / 8].to_vec();
    if big {
        bytes.reverse();
    }
    bytes
}

/// A page: the numbers of its picture, and its directory.
struct Page<'a> {
    size: [usize; 2],
    values: &'a [i64],
    description: &'a str,
    photometric: u16,
    samples: u16,
}

/// A TIFF file of pages in two strips each.
fn tiff(pages: &[Page], kind: Number, packing: u16, big: bool) -> Vec<u8> {
    let mut file = Writer { big, bytes: if big { b"MM".to_vec() } else { b"II".to_vec() } };
    file.short(42);
    let mut link = file.bytes.len();
    file.long(0);
    for page in pages {
        let rows = page.size[1].div_ceil(2);
        let mut strips = Vec::new();
        for strip in page.values.chunks(rows * page.size[0] * usize::from(page.samples)) {
            let data: Vec<u8> = strip.iter().flat_map(|value| number(kind, *value, big)).collect();
            let data = packed(packing, &data);
            strips.push([file.bytes.len() as u32, data.len() as u32]);
            file.bytes.extend(data);
        }
        let described = file.bytes.len() as u32;
        file.bytes.extend(page.description.bytes().chain([0]));
        let lists = file.bytes.len() as u32;
        strips.iter().for_each(|strip| file.long(strip[0]));
        strips.iter().for_each(|strip| file.long(strip[1]));
        let here = file.bytes.len() as u32;
        let link_bytes = if big { here.to_be_bytes() } else { here.to_le_bytes() };
        file.bytes[link..link + 4].copy_from_slice(&link_bytes);
        let count = strips.len() as u32;
        let long =
            |entry: u32| if count == 1 { strips[0][entry as usize] } else { lists + 4 * count * entry };
        let entries: [(u16, u16, u32, u32); 11] = [
            (256, 4, 1, page.size[0] as u32),
            (257, 4, 1, page.size[1] as u32),
            (258, 3, 1, kind.0 as u32),
            (259, 3, 1, packing.into()),
            (262, 3, 1, page.photometric.into()),
            (270, 2, page.description.len() as u32 + 1, described),
            (273, 4, count, long(0)),
            (277, 3, 1, page.samples.into()),
            (278, 4, 1, rows as u32),
            (279, 4, count, long(1)),
            (339, 3, 1, kind.1.into()),
        ];
        file.short(entries.len() as u16);
        for (tag, form, count, value) in entries {
            file.short(tag);
            file.short(form);
            file.long(count);
            if form == 3 {
                file.short(value as u16);
                file.short(0);
            } else {
                file.long(value);
            }
        }
        link = file.bytes.len();
        file.long(0);
    }
    file.bytes
}

fn read(bytes: &[u8]) -> Result<VolumeFile, MeshError> {
    volume_of(Path::new("a.tif"), bytes)
}

/// The labels as an NRRD file.
fn nrrd() -> VolumeFile {
    let values: Vec<String> = (0..60).map(|at| label(at).to_string()).collect();
    let text = format!("NRRD0004\ntype: int\nsizes: 5 4 3\nencoding: ascii\n\n{}\n", values.join(" "));
    volume_of(Path::new("a.nrrd"), text.as_bytes()).unwrap()
}

/// Each number, packing and byte order gives the mesh of the same labels in an NRRD file.
#[test]
fn a_stack_of_pages_is_read_in_each_number_packing_and_byte_order() {
    let values: Vec<i64> = (0..60).map(label).collect();
    let pages: Vec<Page> = values
        .chunks(SIZES[0] * SIZES[1])
        .map(|values| Page { size: [5, 4], values, description: "made", photometric: 1, samples: 1 })
        .collect();
    let expected = nrrd();
    for kind in [(8, 1), (16, 1), (32, 1), (8, 2), (16, 2), (32, 2), (32, 3)] {
        for packing in PACKINGS {
            for big in [false, true] {
                let found = read(&tiff(&pages, kind, packing, big));
                let found = found.unwrap_or_else(|error| panic!("{kind:?} {packing} {big}: {error}"));
                assert_eq!(found, expected, "{kind:?} {packing} {big}");
            }
        }
    }
}

/// A stack that Pillow wrote, in LZW with differences between neighbours.
#[test]
fn a_stack_of_another_program_is_read() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/volume/voxels.tif");
    assert_eq!(read_volume(&file).unwrap(), nrrd());
}

/// What is no stack of grey values is refused in words: pages of two sizes, colours, white at zero, layers that the description has.
#[test]
fn what_is_no_stack_is_refused() {
    let values: Vec<i64> = (0..60).map(label).collect();
    let page = Page { size: [5, 4], values: &values[..20], description: "", photometric: 1, samples: 1 };
    let says = |pages: &[Page]| read(&tiff(pages, (8, 1), 1, false)).expect_err("a refusal").to_string();
    let small = Page { size: [2, 2], values: &values[..4], ..page };
    insta::assert_snapshot!(says(&[Page { ..page }, small]), @"a.tif: page 2 is 2 by 2; each page is a layer of 5 by 4 as the first; leave out previews");
    insta::assert_snapshot!(says(&[Page { photometric: 0, ..page }]), @"a.tif: page 1 is white at zero; values grow with the brightness; save it with black at zero");
    insta::assert_snapshot!(says(&[Page { values: &values, photometric: 2, samples: 3, ..page }]), @"a.tif: page 1 is RGB(8); one value of 8 to 64 bits a voxel is read; save it in shades of grey");
    let described = |description| [Page { description, ..page }, Page { ..page }];
    insta::assert_snapshot!(says(&described("ImageJ=1.53t\nimages=40\nslices=40\n")), @"a.tif: the description tells of 40 layers, and the file has 2 pages; save one stack of grey values, a page for each layer");
    insta::assert_snapshot!(says(&described("ImageJ=1.53t\nimages=2\nchannels=2\n")), @"a.tif: the description tells of 2 channels, and the file has 2 pages; save one stack of grey values, a page for each layer");
    assert!(read(&tiff(&described("ImageJ=1.53t\nimages=2\nslices=2\n"), (8, 1), 1, false)).is_ok());
    let whole = tiff(&[Page { ..page }], (8, 1), 1, false);
    insta::assert_snapshot!(read(&whole[..whole.len() - 40]).expect_err("a refusal").to_string(), @"a.tif: the TIFF file cannot be read: failed to fill whole buffer; save it uncompressed, or with LZW or Deflate");
}
