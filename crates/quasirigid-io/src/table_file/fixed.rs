//! Columns of fixed width: the places of a line that are blank in every line part them, or the rule below their names shows them.

use std::ops::Range;

use super::layout::is_rule;

/// Columns at places of the line, in characters; the last goes on to the end of the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Columns {
    places: Vec<Range<usize>>,
    seen: Option<Seen>,
}

/// What was seen of the lines, where no rule shows the columns.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Seen {
    header: Vec<bool>,
    /// Places that any line fills, the names too.
    filled: Vec<bool>,
    /// Places that a row fills.
    rows: Vec<bool>,
}

impl Columns {
    /// Columns by the runs of dashes in a rule.
    pub(super) fn of_rule(rule: &[u8]) -> Option<Self> {
        let places = runs(&letters(rule));
        (places.len() > 1).then_some(Self { places, seen: None })
    }

    /// Columns by the names above them and some rows.
    pub(super) fn of_rows(header: &[u8], rows: &[Vec<u8>]) -> Option<Self> {
        let header = letters(header);
        let mut seen = Seen { filled: header.clone(), header, rows: Vec::new() };
        for row in rows.iter().filter(|row| !is_rule(row)).map(|row| letters(row)) {
            fill(&mut seen.filled, &row);
            fill(&mut seen.rows, &row);
        }
        let places = seen.columns();
        let named = places.first().is_some_and(|first| any(&seen.header, first));
        (places.len() > 1 && named).then_some(Self { places, seen: Some(seen) })
    }

    /// Takes a line into account, unless its text goes across two columns.
    pub(super) fn widen(&mut self, line: &[u8]) {
        let Some(seen) = self.seen.as_mut().filter(|_| !is_rule(line)) else { return };
        let line = letters(line);
        if !joins(&seen.filled, &line) {
            fill(&mut seen.filled, &line);
            fill(&mut seen.rows, &line);
        }
    }

    /// Ends the widening.
    pub(super) fn settle(&mut self) {
        if let Some(seen) = &self.seen {
            self.places = seen.columns();
        }
    }

    /// Number of columns.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether all of the line stands in columns.
    pub(super) fn holds(&self, line: &[u8]) -> bool {
        let end = self.places.last().map_or(0, |last| last.start);
        let mut line = letters(line);
        line.truncate(end);
        self.places
            .iter()
            .for_each(|place| line.iter_mut().take(place.end).skip(place.start).for_each(|x| *x = false));
        !line.contains(&true)
    }

    /// The values of a line, without the blanks around them.
    pub(super) fn values(&self, line: &[u8]) -> Vec<Vec<u8>> {
        let text = String::from_utf8_lossy(line);
        let starts: Vec<usize> = text.char_indices().map(|(start, _)| start).collect();
        let start = |place: usize| starts.get(place).copied().unwrap_or(text.len());
        let last = self.places.len() - 1;
        let value = |(k, place): (usize, &Range<usize>)| {
            let end = if k == last { text.len() } else { start(place.end) };
            text[start(place.start)..end].trim().as_bytes().to_vec()
        };
        self.places.iter().enumerate().map(value).collect()
    }
}

impl Seen {
    /// Runs of filled places. A run without a name is the second word of the values before it; one with a name alone, a blank behind the
    /// name before it, the second word of that name.
    fn columns(&self) -> Vec<Range<usize>> {
        let mut columns: Vec<Range<usize>> = Vec::new();
        for run in runs(&self.filled) {
            match columns.last_mut() {
                Some(before)
                    if !any(&self.header, &run)
                        || !any(&self.rows, &run)
                            && run.start >= 2
                            && self.header.get(run.start - 2) == Some(&true) =>
                {
                    before.end = run.end;
                }
                _ => columns.push(run),
            }
        }
        columns
    }
}

fn letters(line: &[u8]) -> Vec<bool> {
    String::from_utf8_lossy(line).chars().map(|letter| !letter.is_whitespace()).collect()
}

fn fill(filled: &mut Vec<bool>, line: &[bool]) {
    if filled.len() < line.len() {
        filled.resize(line.len(), false);
    }
    filled.iter_mut().zip(line).for_each(|(filled, letter)| *filled |= letter);
}

fn any(filled: &[bool], run: &Range<usize>) -> bool {
    filled.iter().take(run.end).skip(run.start).any(|filled| *filled)
}

/// Whether a line joins two runs of filled places.
fn joins(filled: &[bool], line: &[bool]) -> bool {
    let (mut runs, mut was) = (0, false);
    for (place, letter) in line.iter().enumerate() {
        let is = filled.get(place) == Some(&true);
        runs = match (is || *letter, is && !was) {
            (false, _) => 0,
            (true, true) => runs + 1,
            (true, false) => runs,
        };
        if runs > 1 {
            return true;
        }
        was = is;
    }
    false
}

fn runs(filled: &[bool]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for place in (0..filled.len()).filter(|place| filled[*place]) {
        match runs.last_mut().filter(|run| run.end == place) {
            Some(run) => run.end = place + 1,
            None => runs.push(place..place + 1),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(text: &str) -> Columns {
        let mut lines = text.lines().map(|line| line.as_bytes().to_vec());
        let header = lines.next().unwrap_or_default();
        Columns::of_rows(&header, &lines.collect::<Vec<_>>()).expect("columns")
    }

    #[test]
    fn a_name_without_values_is_a_column_unless_it_is_a_second_word() {
        assert_eq!(columns("name  P  D\nEros     5\n").places, [0..4, 6..7, 9..10]);
        assert_eq!(columns("spin rate  D\n0.25       5\n").places, [0..9, 11..12]);
    }

    #[test]
    fn later_lines_widen_columns_and_never_join_them() {
        let mut columns = columns("name      P\nIda     4.63\n");
        columns.widen(b"Itokawa 12.13");
        columns.widen(b"a footnote across");
        columns.settle();
        assert_eq!(columns.places, [0..7, 8..13]);
        assert_eq!(columns.values(b"Itokawa 12.132"), [b"Itokawa".to_vec(), b"12.132".to_vec()]);
        assert!(columns.holds(b"Itokawa 12.13 x") && !columns.holds(b"a footnote across"));
    }
}
