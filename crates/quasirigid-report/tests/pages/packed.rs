//! Data of the page for its scripts: unpacked, they are the JSON that was packed.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::inflate::decompress_to_vec;
use proptest::prelude::*;
use quasirigid_io::record::*;
use quasirigid_report::page;
use serde_json::{Value, from_slice, to_value};

/// Contents of the scripts of a page that begin so.
fn scripts<'a>(page: &'a str, tag: &str) -> Vec<&'a str> {
    page.split(tag).skip(1).map(|rest| rest.split("</script>").next().unwrap()).collect()
}

/// Data of the figures of a page, or of a part of it.
pub fn figures(page: &str) -> Vec<Value> {
    let tag = "<script class=\"figure-data\" type=\"application/octet-stream\">";
    scripts(page, tag).into_iter().map(unpack).collect()
}

/// The JSON of packed data, its arrays in base64.
fn unpack(text: &str) -> Value {
    let all = decompress_to_vec(&STANDARD.decode(text).unwrap()).unwrap();
    let end = all.iter().position(|byte| *byte == b'\n').unwrap();
    let mut document = from_slice(&all[..end]).unwrap();
    put_back(&mut document, &all[end + 1..]);
    document
}

fn put_back(value: &mut Value, arrays: &[u8]) {
    if let Some(place) = value.get("packed") {
        let [offset, length, width, distance, times] =
            [0, 1, 2, 3, 4].map(|i| place[i].as_u64().unwrap() as usize);
        let coded = &arrays[offset..offset + length];
        *value = Value::String(STANDARD.encode(restored(coded, width, distance, times)));
        return;
    }
    match value {
        Value::Object(entries) => entries.values_mut().for_each(|value| put_back(value, arrays)),
        Value::Array(entries) => entries.iter_mut().for_each(|value| put_back(value, arrays)),
        _ => {}
    }
}

/// Bytes of numbers whose differences are given, first all lowest bytes.
fn restored(coded: &[u8], width: usize, distance: usize, times: usize) -> Vec<u8> {
    let count = coded.len() / width;
    let number = |i: usize| (0..width).map(|place| u64::from(coded[count * place + i]) << (8 * place)).sum();
    let mut numbers: Vec<u64> = (0..count).map(number).collect();
    for _ in 0..times {
        for i in distance..count {
            numbers[i] = numbers[i].wrapping_add(numbers[i - distance]);
        }
    }
    numbers.iter().flat_map(|number| number.to_le_bytes()[..width].to_vec()).collect()
}

/// A scene with a track of so many frames, whose numbers are smooth but for a noise.
fn scene(frames: usize, coordinates: usize, noise: &[f64]) -> SceneRecord {
    let part =
        |i: usize, j: usize| (0.01 * (j + 1) as f64 * i as f64).sin() + noise[(7 * i + j) % noise.len()];
    let floats = |width: usize| {
        let row = |i: usize| (0..width).map(move |j| part(i, j) as f32);
        Packed((0..frames).flat_map(row).collect::<Vec<f32>>())
    };
    let vectors: Vec<[f64; 3]> = (0..frames).map(|i| [part(i, 0), 1e-3 * part(i, 1), 0.0]).collect();
    let mut scene = super::motion::scene();
    let name = "AAAA</script>";
    scene.name = name.into();
    scene.pieces[0].fields = vec![FieldRecord { coordinate: 0, vectors: VectorsRecord::pack(&vectors) }];
    scene.pieces[2].name = "values".into();
    scene.track = Some(TrackRecord {
        system: "full".into(),
        t: Packed((0..frames).map(|i| 0.1 * i as f64).collect()),
        attitude: floats(4),
        omega: floats(3),
        momentum: floats(3),
        q: Some(floats(coordinates)),
        rotors: None,
        dissipated: Packed((0..frames).map(|i| part(i, 2)).collect()),
    });
    scene
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_packed_scene_unpacks_to_the_same_json(
        frames in 0usize..80, coordinates in 0usize..7, noise in prop::collection::vec(-1e-4..1e-4, 1..50)
    ) {
        let scene = scene(frames, coordinates, &noise);
        let record = RunRecord { scene: Some(scene.clone()), ..crate::support::without_histories() };
        let page = page(&record);
        let [text] = scripts(&page, "<script type=\"application/octet-stream\" id=\"scene\">")[..] else {
            panic!("a page has one scene")
        };
        prop_assert_eq!(unpack(text), to_value(&scene).unwrap());
    }
}

#[test]
fn packed_data_are_small_and_the_same_each_time() {
    let scene = scene(2000, 6, &[0.0]);
    let whole = serde_json::to_string(&scene).unwrap().len();
    let record = RunRecord { scene: Some(scene), ..crate::support::without_histories() };
    let first = page(&record);
    assert_eq!(first, page(&record));
    let text = scripts(&first, "id=\"scene\">")[0];
    assert!(2 * text.len() < whole, "{} of {whole} bytes", text.len());
}

#[test]
fn data_of_figures_unpack_to_their_curves() {
    let page = page(&crate::support::record(400, 600.0, 1e-4));
    let figures = figures(&page);
    assert!(figures.len() > 3);
    for figure in figures {
        let grids = figure["grids"].as_array().unwrap();
        for series in figure["series"].as_array().unwrap() {
            let grid = grids[series["grid"].as_u64().unwrap() as usize].as_str().unwrap();
            let values = series["values"].as_str().unwrap();
            assert_eq!(STANDARD.decode(grid).unwrap().len(), STANDARD.decode(values).unwrap().len());
        }
    }
}
