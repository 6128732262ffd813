//! What stands above the rows of a table in text: titles, the names of the columns, units, types, rules, and the comments of ECSV.

use std::path::Path;

use super::TableError;
use super::bodies::BodyTable;
use super::fixed::Columns;
use super::formula::unguarded;
use super::layout::{Layout, is_rule};
use super::names::unit;
use super::text_table::{COMMENT, JUDGED, Numbered};

/// Lines among which the names of the columns are looked for.
const TITLES: usize = 30;
/// Share of the lines that have as many values as there are names.
const MOST_LINES: f64 = 0.5;

/// Takes what stands above the rows off the first lines of a file: the table without rows, and its layout. Columns of fixed width are widened
/// by all lines from one on.
pub(super) fn take(
    file: &Path,
    head: &mut Vec<Numbered>,
    comments: &[Numbered],
    widen: impl FnOnce(&mut Columns, usize) -> Result<(), TableError>,
) -> Result<Option<(BodyTable, Layout)>, TableError> {
    let mut notes = Vec::new();
    let titles = titles_above(head);
    if titles > 0 {
        let lines = if titles == 1 { "line is" } else { "lines are" };
        notes.push(format!("{titles} {lines} left out above the names of the columns"));
        head.drain(..titles);
    }
    let Some((number, first)) = head.first() else { return Ok(None) };
    let mut layout = Layout::of(first, &below(head, 0));
    if let Layout::Fixed(columns) = &mut layout {
        widen(columns, *number)?;
    }
    notes.splice(0..0, layout.words().map(|words| format!("the table has {words}")));
    let names = match comments.last().and_then(|(_, comment)| names_in_comment(&layout, first, comment)) {
        Some(names) => {
            notes.push("the names of the columns stand in the comment above the rows".to_owned());
            names
        }
        None => {
            let names = layout.fields(first).ok_or_else(|| TableError::Names { file: file.to_owned() })?;
            head.remove(0);
            names
        }
    };
    let names: Vec<String> =
        names.iter().map(|name| unguarded(&String::from_utf8_lossy(name)).into_owned()).collect();
    let mut table = BodyTable::of(names.into_iter());
    drop_rules(head);
    if let Some(units) = units_below(&layout, table.names.len(), head) {
        notes.push("the row below the names of the columns holds their units".to_owned());
        table.units.iter_mut().zip(units).for_each(|(unit, found)| *unit = unit.take().or(found));
        head.remove(0);
        drop_rules(head);
    } else if types_below(file, &layout, table.names.len(), head) {
        notes.push("the row below the names of the columns holds their types, as in RDB".to_owned());
        head.remove(0);
    }
    for (name, unit) in units_in_comments(comments) {
        if let Some(column) = table.names.iter().position(|other| *other == name) {
            table.units[column] = table.units[column].take().or(Some(unit));
        }
    }
    table.notes = notes;
    Ok(Some((table, layout)))
}

fn below(head: &[Numbered], line: usize) -> Vec<Vec<u8>> {
    head.iter().skip(line + 1).map(|(_, line)| line.clone()).collect()
}

fn drop_rules(head: &mut Vec<Numbered>) {
    head.drain(..head.iter().take_while(|(_, line)| is_rule(line)).count());
}

/// Number of the lines above the names of the columns: those above the line over a rule, or lines without a separator.
fn titles_above(head: &[Numbered]) -> usize {
    let line = |k: usize| head.get(k).map(|(_, line)| line.as_slice());
    let is_rule = |k: usize| line(k).is_some_and(is_rule);
    let width =
        |layout: &Layout, k: usize| line(k).and_then(|line| layout.fields(line)).map_or(0, |all| all.len());
    let fits = |names: usize| {
        let layout = Layout::of(line(names).unwrap_or_default(), &below(head, names));
        let rows: Vec<usize> = (names + 1..head.len()).filter(|k| !is_rule(*k)).collect();
        let columns = width(&layout, names);
        let alike = rows.iter().filter(|row| width(&layout, **row) == columns).count();
        (columns > 1 && alike as f64 > MOST_LINES * rows.len() as f64).then_some(layout)
    };
    let end = head.len().min(TITLES);
    if end < 3 || is_rule(1) || fits(0).is_some() {
        return 0;
    }
    let underlined = |k: &usize| is_rule(*k) && !is_rule(k - 1) && line(k + 1).is_some() && !is_rule(k + 1);
    if let Some(rule) = (2..end).rev().find(underlined) {
        return if is_unit_row(head, rule - 2) { rule - 2 } else { rule - 1 };
    }
    let plain = |names: &usize| {
        let Some(layout @ Layout::Separated(_)) = fits(*names) else { return false };
        let values = line(*names).and_then(|line| layout.fields(line)).unwrap_or_default();
        (0..*names).all(|k| width(&layout, k) == 1) && !values.iter().any(|value| is_number(value))
    };
    (1..end - 1).find(plain).unwrap_or(0)
}

/// Whether the line below these names holds their units.
fn is_unit_row(head: &[Numbered], names: usize) -> bool {
    let Some((_, line)) = head.get(names) else { return false };
    let layout = Layout::of(line, &below(head, names));
    let columns = layout.fields(line).map_or(0, |all| all.len());
    units_below(&layout, columns, &head[names + 1..]).is_some()
}

fn is_number(value: &[u8]) -> bool {
    std::str::from_utf8(value).is_ok_and(|text| text.parse::<f64>().is_ok())
}

/// Names of the columns in the comment above a first line of numbers.
fn names_in_comment(layout: &Layout, first: &[u8], comment: &[u8]) -> Option<Vec<Vec<u8>>> {
    let values = layout.fields(first)?;
    let numbers = values.iter().filter(|value| is_number(value)).count();
    let text = comment.iter().position(|byte| *byte != COMMENT).map(|start| &comment[start..])?;
    let names = layout.fields(text)?;
    let sound = names.iter().all(|name| !name.is_empty() && !is_number(name));
    (2 * numbers >= values.len() && sound && names.len() == values.len()).then_some(names)
}

/// Units of the columns, where the first row has nothing but units and the rows below it have numbers there.
fn units_below(layout: &Layout, columns: usize, head: &[Numbered]) -> Option<Vec<Option<String>>> {
    let texts = |line: &Numbered| -> Option<Vec<String>> {
        let fields = layout.fields(&line.1)?;
        fields.into_iter().map(|field| String::from_utf8(field).ok()).collect()
    };
    let first = texts(head.first()?)?;
    let bare = |text: &String| text.trim_matches(['[', ']', '(', ')']).to_owned();
    let units: Vec<Option<String>> = first
        .iter()
        .map(|text| if text.is_empty() { Some(String::new()) } else { unit(&bare(text)) })
        .collect();
    let below: Vec<Vec<String>> = head.iter().skip(1).take(JUDGED).filter_map(texts).collect();
    let numeric = |column: usize| {
        below.iter().any(|row| row.get(column).is_some_and(|text| text.parse::<f64>().is_ok()))
    };
    let named =
        (0..first.len()).filter(|column| units[*column].as_ref().is_some_and(|unit| !unit.is_empty()));
    let named: Vec<usize> = named.collect();
    let sound = first.len() == columns && units.iter().all(Option::is_some) && !named.is_empty();
    (sound && named.into_iter().all(numeric)).then_some(units)
}

/// Whether the first row has the types of an RDB table: a width, then `S`, `N` or `M`; without any width the name of the file decides.
fn types_below(file: &Path, layout: &Layout, columns: usize, head: &[Numbered]) -> bool {
    let Some((_, line)) = head.first().filter(|_| *layout == Layout::Separated(b'\t')) else { return false };
    let types = layout.fields(line).unwrap_or_default();
    let is_type = |text: &Vec<u8>| {
        text.split_last()
            .is_some_and(|(kind, width)| b"SNM".contains(kind) && width.iter().all(u8::is_ascii_digit))
    };
    let named = || file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("rdb"));
    types.len() == columns
        && types.iter().all(is_type)
        && (types.iter().any(|text| text.len() > 1) || named())
}

/// Units in the comments of ECSV, lines such as `# - {name: P, unit: h, datatype: float64}`.
fn units_in_comments(comments: &[Numbered]) -> impl Iterator<Item = (String, String)> {
    comments.iter().filter_map(|(_, comment)| {
        let text = String::from_utf8_lossy(comment);
        let entry = text.trim_start_matches('#').trim().strip_prefix("- {")?.strip_suffix('}')?.to_owned();
        let value = |key: &str| {
            let found = entry.split(", ").find_map(|pair| pair.strip_prefix(key)?.strip_prefix(": "));
            found.map(|value| value.trim_matches(['"', '\'']).to_owned())
        };
        Some((value("name")?, unit(&value("unit")?)?))
    })
}
