//! Dissipation by harmonic and dissipator: bars whose heights are the shares of the record.

use quasirigid_io::record::RunRecord;
use quasirigid_report::{figure_names, page, picture};
use roxmltree::Document;

const NAME: &str = "evolution-harmonics";

fn record() -> RunRecord {
    crate::support::record(400, 600.0, 1e-4)
}

/// Heights of the bars of each colour, over that of the tallest.
fn heights(svg: &str) -> Vec<(String, Vec<f64>)> {
    let document = Document::parse(svg).unwrap();
    let paths = document
        .descendants()
        .filter(|node| node.attribute("stroke") == Some("none") && node.has_tag_name("path"));
    let of = |bar: &str| {
        let numbers: Vec<f64> = bar.split(['V', 'H', 'Z', ' ']).filter_map(|one| one.parse().ok()).collect();
        let [_, base, top, ..] = numbers[..] else { panic!("{bar}") };
        base - top
    };
    let mut all: Vec<(String, Vec<f64>)> = paths
        .map(|path| {
            (
                path.attribute("fill").unwrap().to_owned(),
                path.attribute("d").unwrap().split('M').skip(1).map(of).collect(),
            )
        })
        .collect();
    let tallest =
        all.iter().flat_map(|(_, heights)| heights).fold(0.0, |most: f64, height| most.max(*height));
    all.iter_mut().flat_map(|(_, heights)| heights).for_each(|height| *height /= tallest);
    all
}

#[test]
fn bars_are_the_shares_of_the_record() {
    let record = record();
    assert!(figure_names(&record).contains(&NAME));
    let harmonics = &record.evolution.as_ref().unwrap().harmonics;
    let drawn = heights(&picture(&record, NAME).unwrap());
    // the largest dissipator is the first of the colours, drawn last
    for ((colour, heights), name) in drawn.iter().rev().zip(["spring tip-carrier", "tank", "flywheel"]) {
        for (height, harmonic) in heights.iter().zip(harmonics) {
            let expected = harmonic.dissipation[name] / (0.62 * 0.912);
            assert!((height - expected).abs() < 1e-3, "{name} in {colour}: {height}, not {expected}");
        }
    }
    assert_eq!(drawn.len(), 3);
}

/// Records of versions without the parts show the harmonics alone; of many dissipators the small ones are one.
#[test]
fn few_colours_show_any_number_of_dissipators() {
    let mut record = record();
    let harmonics = &mut record.evolution.as_mut().unwrap().harmonics;
    harmonics.iter_mut().for_each(|harmonic| harmonic.dissipation.clear());
    assert_eq!(heights(&picture(&record, NAME).unwrap()).len(), 1);
    let harmonics = &mut record.evolution.as_mut().unwrap().harmonics;
    for harmonic in harmonics {
        harmonic.dissipation =
            (1..=9).map(|i| (format!("damper {i}"), harmonic.share * f64::from(i) / 45.0)).collect();
    }
    let svg = picture(&record, NAME).unwrap();
    assert!(
        svg.contains(">damper 9</text>") && svg.contains(">6 others</text>") && !svg.contains("damper 6")
    );
    let drawn = heights(&svg);
    let total: f64 = drawn.iter().map(|(_, heights)| heights[1]).sum();
    assert!((drawn.len(), (total - 45.0 / 21.0).abs() < 3e-3) == (4, true), "{drawn:?}");
}

#[test]
fn page_has_the_bars_with_their_data() {
    let page = page(&record());
    let (_, after) = page.split_once("Dissipation by harmonic of the nutation</h3>").unwrap();
    let figure = after.split("</figure>").next().unwrap();
    let data = &super::packed::figures(figure)[0];
    assert!(
        figure.contains("curve s1 bars") && data["series"][0]["bar"].is_array() && data["x"]["whole"] == true
    );
    assert!(figure.contains("share of the power [%]</text>") && figure.contains("spring tip-carrier"));
    let ticks: Vec<&str> =
        figure.split("tick middle").skip(1).filter_map(|rest| rest.split(['>', '<']).nth(1)).collect();
    assert_eq!(ticks, ["1", "2", "3", "4", "5"]);
}
