//! The page of several runs: what differs, what does not, and nothing of equations that do not hold.

use quasirigid_report::{Compared, comparison_page, figure_names, picture};

use crate::support::{record as of_run, secular};

fn record() -> quasirigid_io::record::RunRecord {
    of_run(201, 60.0, 1e-3)
}

fn row<'a>(page: &'a str, name: &str) -> &'a str {
    let start =
        page.find(&format!("<th scope=\"row\">{name}</th>")).unwrap_or_else(|| panic!("no row {name}"));
    &page[start..start + page[start..].find("</tr>").unwrap()]
}

#[test]
fn what_differs_stands_before_what_does_not() {
    let (one, mut other) = (record(), record());
    other.model.name = "<b>other</b> & co".into();
    other.body.mass *= 2.0;
    let page = comparison_page(&[
        Compared { label: "one", record: &one },
        Compared { label: "<i>two</i>", record: &other },
    ]);
    let (differs, same) = page.split_once("What is the same").unwrap();
    assert!(row(differs, "Mass [kg]").matches("<td>").count() == 2);
    assert!(row(same, "Revolutions").matches("<td>").count() == 1);
    assert!(row(differs, "Body").contains("&lt;b&gt;other&lt;/b&gt; &amp; co") && !page.contains("<i>two"));
    assert!(page.contains("data-label=\"one\"") && page.contains("data-label=\"&lt;i&gt;two&lt;/i&gt;\""));
}

#[test]
fn numbers_of_equations_that_fail_are_not_given() {
    let (one, mut other) = (record(), record());
    other.validity.overall = "fails".into();
    other.evolution = None;
    let page = comparison_page(&[
        Compared { label: "one", record: &one },
        Compared { label: "two", record: &other },
    ]);
    for name in ["Revolutions", "Energy dissipated [J]", "Nutation, start → end"] {
        assert!(row(&page, name).contains("does not hold"), "{}", row(&page, name));
        assert!(!row(&page, name).starts_with("does not hold"));
    }
    assert!(page.contains("two (does not hold)") && !page.contains("one (does not hold)"));
}

#[test]
fn equal_runs_differ_in_nothing() {
    let one = record();
    let page =
        comparison_page(&[Compared { label: "one", record: &one }, Compared { label: "two", record: &one }]);
    assert!(page.contains("Nothing in the table below."));
    assert!(page.contains("data-label=\"two\""));
}

/// Of a history of which a record has the extremes, no figure joins rows that are revolutions apart, and the data tell their number.
#[test]
fn extremes_are_not_drawn_as_a_path() {
    let mut record = record();
    record.histories[0].rows = 5_000_000;
    let page = quasirigid_report::page(&record);
    assert!(page.contains("its ends are drawn") && !page.contains("id=\"first-turns-title\""));
    assert!(!page.contains("<path class=\"angular_momentum"));
    let figures = super::packed::figures(&page);
    assert!(
        figures.iter().any(|figure| figure["series"][0]["rows"] == 5_000_000)
            && page.contains("5000000 rows")
    );
}

/// Modes that grow stand apart from those that decay, each mode a point.
#[test]
fn campbell_diagram_has_a_point_for_each_mode() {
    let svg = picture(&record(), "campbell").unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let dots = |colour: &str| {
        let paths = document.descendants().filter(|node| node.attribute("stroke") == Some(colour));
        paths.filter_map(|node| node.attribute("d")).map(|d| d.matches("h0").count()).sum::<usize>()
    };
    assert_eq!([dots("#0068a8"), dots("#c24a00")], [20, 20]);
    assert!(svg.contains("growing") && svg.contains("this run"));
}

#[test]
fn pictures_stand_alone() {
    let mut record = record();
    record.evolution = Some(secular::evolution(0.6));
    let names = figure_names(&record);
    assert!(
        ["spin", "energy", "nutation", "campbell", "evolution-nutation", "evolution-map", "sphere"]
            .iter()
            .all(|name| names.contains(name)),
        "{names:?}"
    );
    for name in names {
        let svg = picture(&record, name).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(document.root_element().tag_name().namespace(), Some("http://www.w3.org/2000/svg"));
        assert!(!svg.contains("var(") && !svg.contains("%\""), "{name} needs a style sheet or a page");
        let paths =
            document.descendants().filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "path")));
        assert!(paths.filter(|path| path.attribute("d").is_some_and(|d| d.len() > 20)).count() > 0, "{name}");
    }
    assert!(picture(&record, "no-such-figure").is_none());
}

#[cfg(feature = "png")]
#[test]
fn pixels_are_those_of_the_picture() {
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='100'><rect width='200' height='100' fill='#fff'/>\
               <rect x='100' width='100' height='100' fill='#c24a00'/></svg>";
    let bytes = quasirigid_report::png(svg, 400).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let size = [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()));
    assert_eq!(size, [400, 200]);
    let wide = quasirigid_report::png(svg, 20_000).unwrap_err();
    assert!(wide.to_string().contains("64 to 16384"), "{wide}");
}
