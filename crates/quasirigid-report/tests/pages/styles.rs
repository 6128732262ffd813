//! Every class in the markup has a style: a class renamed on one side alone leaves a drawing in black.

use std::collections::BTreeSet;

use quasirigid_report::{figure_names, page, picture};

/// Classes of the markup between scripts and styles.
fn classes(document: &str) -> BTreeSet<&str> {
    let parts = document.split("<style>").flat_map(|part| part.split("</style>").last());
    let markup = parts
        .flat_map(|part| part.split("<script").map(|part| part.split("</script>").last().unwrap_or(part)));
    let values =
        markup.flat_map(|part| part.split(" class=\"").skip(1).filter_map(|rest| rest.split('"').next()));
    values.flat_map(str::split_whitespace).collect()
}

fn styles(document: &str) -> String {
    document.split("<style>").skip(1).filter_map(|rest| rest.split("</style>").next()).collect()
}

fn without_style(document: &str) -> Vec<&str> {
    let styles = styles(document);
    let styled = |class: &&str| {
        let name = format!(".{class}");
        let ends =
            |rest: &str| !rest.starts_with(|next: char| next.is_alphanumeric() || next == '-' || next == '_');
        styles.match_indices(&name).any(|(at, _)| ends(&styles[at + name.len()..]))
    };
    classes(document).into_iter().filter(|class| !styled(class)).collect()
}

#[test]
fn every_class_has_a_style() {
    let record = crate::support::record(400, 600.0, 1e-4);
    let whole = page(&record);
    assert!(classes(&whole).len() > 40 && classes(&whole).contains("ball"), "{:?}", classes(&whole));
    assert_eq!(without_style(&whole), Vec::<&str>::new());
    for name in figure_names(&record) {
        let picture = picture(&record, name).unwrap();
        assert_eq!(without_style(&picture), Vec::<&str>::new(), "{name}");
    }
}
