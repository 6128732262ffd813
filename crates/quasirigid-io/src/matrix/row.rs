//! Kinds of lines and records in files of matrices.

use std::fmt;

use super::error::MatrixProblem;
use crate::text_file::Line;

/// A kind of line or record, whose text says how it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// The first line of a Matrix Market file.
    MarketHeader,
    /// The size of a Matrix Market file with coordinates.
    MarketSizes,
    /// The size of a Matrix Market array.
    MarketArraySizes,
    /// An entry of a Matrix Market file with coordinates.
    MarketEntry,
    /// An entry of a Matrix Market array.
    MarketValue,
    /// An entry of an integer matrix.
    MarketInteger,
    /// An entry of a CalculiX matrix.
    CalculiX,
    /// The header of a Harwell–Boeing file.
    HarwellHeader,
    /// A pointer or a row of a Harwell–Boeing file.
    HarwellIndex,
    /// A value of a Harwell–Boeing file.
    HarwellValue,
    /// An entry of a matrix of Abaqus by numbers.
    Coordinates,
    /// An entry of a matrix of Abaqus by nodes.
    Labels,
    /// A line of a list of degrees of freedom.
    Dof,
    /// A line of a table of nodes.
    Node,
    /// A line of a `*NODE` block.
    InputNode,
    /// A `GRID` card.
    Grid,
    /// An element of NASTRAN.
    Element,
    /// A property or material of NASTRAN.
    Property,
    /// A card of NASTRAN.
    Card,
    /// A line of a keyword of Abaqus.
    InpCard,
    /// The header card of a `DMIG` matrix.
    DmigHeader,
    /// A column card of a `DMIG` matrix.
    DmigColumn,
    /// A number of NASTRAN.
    NastranReal,
    /// The header of an `OUTPUT4` matrix.
    Op4Header,
    /// The beginning of an `OUTPUT4` column.
    Op4Column,
    /// The beginning of a string of an `OUTPUT4` column.
    Op4String,
    /// The numbers of an `OUTPUT4` column.
    Op4Values,
    /// A number between the records of an `OUTPUT2` file.
    Op2Key,
    /// A point of an `OUTPUT2` table.
    Op2Point,
    /// A line of a printed or punched table of modes.
    Mode,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MarketHeader => {
                "the first line is %%MatrixMarket matrix, then coordinate or array, then real or integer, then \
                 general, symmetric or skew-symmetric"
            }
            Self::MarketSizes => "the line after the comments has the numbers of rows, columns and entries",
            Self::MarketArraySizes => "the line after the comments has the numbers of rows and columns",
            Self::MarketEntry | Self::CalculiX | Self::Coordinates => "an entry is written row column value",
            Self::MarketValue => "an array has one value on a line, column by column",
            Self::MarketInteger => "the first line says that the values are integers",
            Self::HarwellHeader => {
                "a Harwell-Boeing header has its numbers of lines, then RUA, RSA or RZA with rows, columns and entries, \
                 then its Fortran formats"
            }
            Self::HarwellIndex => "pointers ascend from 1 to one more than the entries, and rows count from 1",
            Self::HarwellValue => "values fill the columns of the format in the header",
            Self::Labels => "an entry is written node component node component value",
            Self::Dof => "a degree of freedom is written node.component or node component",
            Self::Node => "a node is written label x y z",
            Self::InputNode => "a node is written label, x, y, z below *NODE",
            Self::Grid => "a GRID card has its label, system, x, y and z in fields 2 to 6",
            Self::Element => "an element has whole numbers for itself, its property and its grid points",
            Self::Property => "a property or material has whole numbers for itself and what it names",
            Self::Card => {
                "the fields of a card are ASCII: eight of 8 columns on a line, or four of 16 if a star follows its \
                 name, or as many between commas"
            }
            Self::InpCard => "a line has numbers and names between commas, as its keyword demands",
            Self::DmigHeader => {
                "a DMIG header has its name, 0, form, type of input and type of output in fields 2 to 6, and its \
                 number of columns in field 9"
            }
            Self::DmigColumn => {
                "a DMIG column has its name, point and component in fields 2 to 4, then from field 6 on the point, \
                 component, value and a blank of each row"
            }
            Self::NastranReal => "a real number has a decimal point, such as 3. or 1.5-3",
            Self::Op4Header => {
                "a matrix begins with its numbers of columns and rows, form and type in 8 columns each, its name \
                 in 8 columns and its format, such as 1P,3E23.16"
            }
            Self::Op4Column => {
                "a column begins with its number, its first row or 0, and its number of words in 8 columns each, in \
                 ascending order, up to one more than there are columns"
            }
            Self::Op4String => "a string begins with its length and first row, and fits its column",
            Self::Op2Key => "keys of 1 and 0 stand between the records of a table, and those of a matrix",
            Self::Op2Point => "a point has its number, its type, three displacements and three rotations",
            Self::Mode => "a mode has its number, order, eigenvalue, frequencies, mass and stiffness, a point its six components",
            Self::Op4Values => "values fill the lines and records as the header and the column announce",
        })
    }
}

impl Line for Row {
    type Problem = MatrixProblem;

    fn not_a_number(self, found: String) -> MatrixProblem {
        MatrixProblem::NotANumber { found: found.into(), row: self }
    }

    fn not_finite(self, found: String) -> MatrixProblem {
        MatrixProblem::NotFinite { found: found.into() }
    }
}
