use quasirigid_io::table_file::{CellKind, Cells};

/// Value of a row in one column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// No value.
    Missing,
    /// Number.
    Number(f64),
    /// Truth value.
    Boolean(bool),
    /// Text.
    Text(String),
}

impl Cell {
    /// The number, if the cell holds one.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }

    fn truth(&self) -> Option<bool> {
        if let Self::Boolean(truth) = self { Some(*truth) } else { None }
    }

    fn text(&self) -> Option<String> {
        if let Self::Text(text) = self { Some(text.clone()) } else { None }
    }

    /// Whether a column of a kind takes the cell.
    pub(super) fn fits(&self, kind: CellKind) -> bool {
        matches!(
            (self, kind),
            (Self::Missing, _)
                | (Self::Number(_), CellKind::Number)
                | (Self::Boolean(_), CellKind::Boolean)
                | (Self::Text(_), CellKind::Text)
        )
    }
}

/// A column of cells of one kind.
pub(super) fn cells<'a>(kind: CellKind, cells: impl Iterator<Item = &'a Cell>) -> Cells {
    match kind {
        CellKind::Number => Cells::Numbers(cells.map(Cell::number).collect()),
        CellKind::Boolean => Cells::Booleans(cells.map(Cell::truth).collect()),
        CellKind::Text => Cells::Texts(cells.map(Cell::text).collect()),
    }
}
