//! VRML 1 and 2: the `IndexedFaceSet`s of a scene and the coordinates that they use.
//!
//! The scene is followed by its braces alone. Nodes that move or resize what is below them are refused unless they do nothing, since shape
//! models have none; other kinds of geometry are told.

use std::ops::Range;

use super::TriangleMesh;
use super::draft::Draft;
use super::error::{Fault, MeshProblem, Place, Row};
use super::text::readable;
use crate::text_file::{finite, last_line, number};

/// Nodes with a shape of their own, which are left out.
const OTHER_SHAPES: [&str; 9] =
    ["Box", "Cube", "Cone", "Cylinder", "Sphere", "ElevationGrid", "Extrusion", "Text", "Inline"];

/// VRML 1 or 2.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let text = readable(bytes);
    let mut scene = Scene::default();
    scene.draft.unit = stated_unit(&text);
    let mut tokens = Tokens { text: &text, at: 0, line: 1 };
    let (mut before, mut name) = ("", None);
    while let Some(token) = tokens.next() {
        match token {
            "{" => scene.open(before, name.take()),
            "}" => scene.close(tokens.line)?,
            "DEF" => name = tokens.next(),
            "USE" => scene.reuse(tokens.next().unwrap_or_default()),
            field => scene.field(field, &mut tokens)?,
        }
        before = token;
    }
    if !scene.nodes.is_empty() {
        return Err((Place::Line(last_line(&text)), MeshProblem::Unclosed { braces: scene.nodes.len() }));
    }
    let others: Vec<String> = scene.others.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    if !others.is_empty() {
        scene.draft.remarks.push(format!("shapes that are no faces left out: {}", others.join(", ")));
    }
    scene.draft.finish(0)
}

/// The unit in a comment that shape models of asteroids have.
fn stated_unit(text: &str) -> Option<(f64, String)> {
    let stated = [("#SIZE_IN_KILOMETERS", 1e3), ("#SIZE_IN_METERS", 1.0)];
    let mut comments = text.lines().map(str::trim).filter(|line| line.starts_with('#')).take(100);
    comments
        .find_map(|line| stated.iter().find(|(words, _)| line == *words))
        .map(|(words, unit)| (*unit, (*words).into()))
}

/// Words, braces and brackets one after the other; commas are blanks.
struct Tokens<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl<'a> Tokens<'a> {
    fn peek(&mut self) -> Option<&'a str> {
        let (at, line) = (self.at, self.line);
        let token = self.next();
        (self.at, self.line) = (at, line);
        token
    }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let bytes = self.text.as_bytes();
        loop {
            match bytes.get(self.at)? {
                b'\n' => (self.at, self.line) = (self.at + 1, self.line + 1),
                b'#' => {
                    self.at += bytes[self.at..]
                        .iter()
                        .position(|byte| *byte == b'\n')
                        .unwrap_or(bytes.len() - self.at)
                }
                byte if byte.is_ascii_whitespace() || *byte == b',' => self.at += 1,
                _ => break,
            }
        }
        let start = self.at;
        let ends = |byte: &u8| byte.is_ascii_whitespace() || b",{}[]#\"".contains(byte);
        self.at += match bytes[start] {
            b'{' | b'}' | b'[' | b']' => 1,
            b'"' => {
                let quote = bytes[start + 1..].iter().position(|byte| *byte == b'"');
                quote.map_or(bytes.len() - start, |length| length + 2)
            }
            _ => bytes[start..].iter().position(ends).unwrap_or(bytes.len() - start),
        };
        let token = &self.text[start..self.at];
        self.line += token.bytes().filter(|byte| *byte == b'\n').count();
        Some(token)
    }
}

/// The scene as far as it is read.
#[derive(Default)]
struct Scene<'a> {
    draft: Draft,
    nodes: Vec<Node<'a>>,
    /// Coordinates in force, among all.
    points: Range<usize>,
    /// Coordinates by the names of their nodes.
    named: Vec<(&'a str, Range<usize>)>,
    others: Vec<(&'a str, usize)>,
}

/// A node that is open.
struct Node<'a> {
    kind: &'a str,
    name: Option<&'a str>,
    /// Coordinates in force before it.
    outside: Range<usize>,
    /// Corners of its faces, one face after the other, with -1 between; and the line of each.
    corners: Vec<(i64, u32)>,
    clockwise: bool,
}

impl<'a> Scene<'a> {
    fn open(&mut self, kind: &'a str, name: Option<&'a str>) {
        if OTHER_SHAPES.contains(&kind) {
            match self.others.iter_mut().find(|(other, _)| *other == kind) {
                Some((_, count)) => *count += 1,
                None => self.others.push((kind, 1)),
            }
        }
        let outside = self.points.clone();
        self.nodes.push(Node { kind, name, outside, corners: Vec::new(), clockwise: false });
    }

    fn close(&mut self, line: usize) -> Result<(), Fault> {
        let unexpected =
            || (Place::Line(line), MeshProblem::Unexpected { found: "}".into(), row: Row::Vrml });
        let node = self.nodes.pop().ok_or_else(unexpected)?;
        match node.kind {
            "Coordinate" | "Coordinate3" => {
                self.named.extend(node.name.map(|name| (name, self.points.clone())));
            }
            "IndexedFaceSet" => {
                self.faces(&node)?;
                // In VRML 2 the coordinates are those of the node.
                self.points = node.outside;
            }
            "Separator" => self.points = node.outside,
            _ => {}
        }
        Ok(())
    }

    fn reuse(&mut self, name: &str) {
        if let Some((_, points)) = self.named.iter().rev().find(|(other, _)| *other == name) {
            self.points = points.clone();
        }
    }

    /// Reads the value of a field that matters here.
    fn field(&mut self, field: &'a str, tokens: &mut Tokens<'a>) -> Result<(), Fault> {
        let Some(node) = self.nodes.last_mut() else { return Ok(()) };
        match (node.kind, field) {
            ("Coordinate" | "Coordinate3", "point") => {
                let start = self.draft.vertices.len();
                points(tokens, &mut self.draft.vertices)?;
                self.points = start..self.draft.vertices.len();
            }
            ("IndexedFaceSet", "coordIndex") => node.corners = indices(tokens)?,
            ("IndexedFaceSet", "ccw") => node.clockwise = tokens.next() == Some("FALSE"),
            ("Transform" | "Translation" | "Scale" | "Rotation", "translation" | "center") => {
                moved(tokens, field, |values| values.iter().all(|x| *x == 0.0))?;
            }
            ("Transform" | "Scale", "scale" | "scaleFactor") => {
                moved(tokens, field, |values| values.iter().all(|x| *x == 1.0))?;
            }
            ("Transform" | "Rotation", "rotation") => {
                moved(tokens, field, |values| values.last().is_none_or(|angle| *angle == 0.0))?;
            }
            ("MatrixTransform", "matrix") => {
                let identity = |(k, x): (usize, &f64)| *x == f64::from(u8::from(k % 5 == 0));
                moved(tokens, field, |values| values.iter().enumerate().all(identity))?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Adds the faces of a node that has closed.
    fn faces(&mut self, node: &Node<'_>) -> Result<(), Fault> {
        let (mut corners, mut line) = (Vec::new(), 0);
        for (corner, at) in node.corners.iter().copied().chain([(-1, 0)]) {
            if corner < 0 {
                if node.clockwise {
                    corners.reverse();
                }
                if !corners.is_empty() {
                    self.draft.polygon(&corners, line);
                }
                corners.clear();
                continue;
            }
            line = at as usize;
            let index = usize::try_from(corner).ok().filter(|index| *index < self.points.len());
            let index = index.and_then(|index| u32::try_from(self.points.start + index).ok());
            corners.push(index.ok_or_else(|| {
                let (found, vertices) = (corner.to_string().into(), self.points.len());
                (Place::Line(line), MeshProblem::NoSuchVertex { found, first: 0, vertices })
            })?);
        }
        Ok(())
    }
}

/// Numbers of a field, in brackets or alone.
fn numbers(
    tokens: &mut Tokens<'_>,
    mut each: impl FnMut(&str, usize) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let listed = tokens.peek() == Some("[");
    if listed {
        tokens.next();
    }
    while let Some(token) = tokens.peek() {
        if token == "]" {
            tokens.next();
            return Ok(());
        }
        if !listed && !token.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
            return Ok(());
        }
        tokens.next();
        each(token, tokens.line)?;
    }
    Ok(())
}

fn points(tokens: &mut Tokens<'_>, vertices: &mut Vec<[f64; 3]>) -> Result<(), Fault> {
    let (mut point, mut axis) = ([0.0; 3], 0);
    let mut last = tokens.line;
    numbers(tokens, |word, line| {
        let value = number(word, Row::Vrml).and_then(|value| finite(value, word, Row::Vrml));
        point[axis] = value.map_err(|problem| (Place::Line(line), problem))?;
        (axis, last) = ((axis + 1) % 3, line);
        if axis == 0 {
            vertices.push(point);
        }
        Ok(())
    })?;
    if axis == 0 {
        Ok(())
    } else {
        Err((Place::Line(last), MeshProblem::Values { found: axis, row: Row::Vrml }))
    }
}

fn indices(tokens: &mut Tokens<'_>) -> Result<Vec<(i64, u32)>, Fault> {
    let mut corners = Vec::new();
    numbers(tokens, |word, line| {
        let wrong = |_| (Place::Line(line), MeshProblem::NotANumber { found: word.into(), row: Row::Vrml });
        corners.push((word.parse().map_err(wrong)?, u32::try_from(line).unwrap_or(u32::MAX)));
        Ok(())
    })?;
    Ok(corners)
}

/// Refuses a node that moves or resizes what is below it.
fn moved(tokens: &mut Tokens<'_>, field: &str, at_rest: impl Fn(&[f64]) -> bool) -> Result<(), Fault> {
    let (mut values, line) = (Vec::new(), tokens.line);
    numbers(tokens, |word, line| {
        values.push(number(word, Row::Vrml).map_err(|problem| (Place::Line(line), problem))?);
        Ok(())
    })?;
    if at_rest(&values) {
        return Ok(());
    }
    Err((Place::Line(line), MeshProblem::Moved { field: field.into() }))
}
