//! The moving picture: XML without a script, in which the body stands at every row as the record has it.

use std::f64::consts::TAU;

use quasirigid_io::record::*;
use quasirigid_report::{figure_names, picture};
use roxmltree::{Document, Node};

type Vector = [f64; 3];

/// Rate of precession and of the spin about the body's axis z (rad/s), and the angle between that axis and the angular momentum.
const PRECESSION: f64 = 0.5;
const SPIN: f64 = 0.2;
const TILT: f64 = 0.4;
/// Moments of a body that precesses so, across and along its axis: `K = A · PRECESSION`, `K cos(TILT) = C (PRECESSION cos(TILT) + SPIN)`.
const ACROSS: f64 = 3.0;

fn along() -> f64 {
    ACROSS * PRECESSION * TILT.cos() / (PRECESSION * TILT.cos() + SPIN)
}

fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    let [w, x, y, z] = a;
    let [s, p, q, r] = b;
    [
        w * s - x * p - y * q - z * r,
        w * p + x * s + y * r - z * q,
        w * q - x * r + y * s + z * p,
        w * r + x * q - y * p + z * s,
    ]
}

fn about(axis: usize, angle: f64) -> [f64; 4] {
    let mut turn = [(0.5 * angle).cos(), 0.0, 0.0, 0.0];
    turn[1 + axis] = (0.5 * angle).sin();
    turn
}

/// Inertial components by the matrix of the quaternion, written out.
fn inertial([w, x, y, z]: [f64; 4], v: Vector) -> Vector {
    let rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn attitude(t: f64) -> [f64; 4] {
    product(product(about(2, PRECESSION * t), about(0, TILT)), about(2, SPIN * t))
}

const TIP: Vector = [0.3, -0.8, 0.9];

/// A precessing box with a point on a line, off its axes; rows at every part of a revolution.
fn record(revolutions: f64, rows_each: f64) -> RunRecord {
    let mut record = crate::support::record(10, 1.0, 0.0);
    let rate = (PRECESSION.powi(2) + SPIN.powi(2) + 2.0 * PRECESSION * SPIN * TILT.cos()).sqrt();
    let rows = (revolutions * rows_each).round() as usize + 1;
    let t: Vec<f64> = (0..rows).map(|i| i as f64 * TAU / rate / rows_each).collect();
    let column = |name: &str, unit: &str, value: &dyn Fn(f64) -> f64| Column {
        name: name.into(),
        unit: unit.into(),
        values: t.iter().map(|t| value(*t)).collect(),
    };
    let history = &mut record.histories[0];
    history.rows = rows as u64;
    history.revolutions = revolutions;
    history.columns = vec![
        column("t", "s", &|t| t),
        column("wx", "rad/s", &|t| PRECESSION * TILT.sin() * (SPIN * t).sin()),
        column("wy", "rad/s", &|t| PRECESSION * TILT.sin() * (SPIN * t).cos()),
        column("wz", "rad/s", &|_| PRECESSION * TILT.cos() + SPIN),
        column("nutation_max", "rad", &|_| TILT),
        column("circled_axis", "1", &|_| 1.0),
    ];
    for (i, name) in ["qw", "qx", "qy", "qz"].into_iter().enumerate() {
        history.columns.push(column(name, "1", &|t| attitude(t)[i]));
    }
    record.histories.truncate(1);
    record.body.inertia = [[ACROSS, 0.0, 0.0], [0.0, ACROSS, 0.0], [0.0, 0.0, along()]];
    record.body.principal_moments = [along(), ACROSS, ACROSS];
    record.body.principal_axes = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    record.scene = Some(scene());
    record
}

pub fn scene() -> SceneRecord {
    let piece = |name: &str, kind: &str, vertices: &[Vector]| PieceRecord {
        name: name.into(),
        kind: kind.into(),
        vertices: VectorsRecord::pack(vertices),
        triangles: None,
        lines: None,
        size: Some(0.05),
        fields: Vec::new(),
        turning: None,
    };
    let corner = |i: u16| [0, 1, 2].map(|axis| if i & (1 << axis) == 0 { -0.5 } else { 0.5 });
    let quads: [[u16; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
    SceneRecord {
        version: SCENE_VERSION,
        name: "box".into(),
        radius: 1.25,
        coordinates: Vec::new(),
        pieces: vec![
            PieceRecord {
                triangles: Some(Packed(triangles)),
                ..piece("hub", "carrier", &(0..8).map(corner).collect::<Vec<_>>())
            },
            piece("tip", "point", &[TIP]),
            PieceRecord { lines: Some(Packed(vec![0, 1])), ..piece("", "spring", &[[0.0; 3], TIP]) },
        ],
        principal: PrincipalRecord {
            moments: [along(), ACROSS, ACROSS],
            axes: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        },
        track: None,
        spin: None,
        modes: Vec::new(),
        equations: None,
    }
}

fn values<'a>(node: Node<'a, '_>, attribute: &str) -> Vec<&'a str> {
    let animation = node.children().find(|child| child.attribute("attributeName") == Some(attribute));
    animation.map_or_else(Vec::new, |found| found.attribute("values").unwrap().split(';').collect())
}

fn of_class<'a, 'd>(document: &'a Document<'d>, group: &str, class: &str) -> Vec<Node<'a, 'd>> {
    let has = |node: &Node, name: &str| {
        node.attribute("class").is_some_and(|all| all.split(' ').any(|one| one == name))
    };
    let group = document.descendants().find(|node| has(node, group)).unwrap();
    group.descendants().filter(|node| has(node, class)).collect()
}

/// Spot of a body vector in half pixels: `K` is the inertial axis z; the observer is 0.35 rad above the plane across it.
fn spot(t: f64, vector: Vector) -> [f64; 2] {
    let [x, y, z] = inertial(attitude(t), vector);
    let (sin, cos) = 0.35_f64.sin_cos();
    let scale = 2.0 * 128.0 / 1.25;
    // an observer on the axis x and above it, with y to the right
    [scale * y, -scale * (cos * z + sin * -x)]
}

#[test]
fn keyframes_are_the_attitudes_of_the_record() {
    let text = picture(&record(5.0, 24.0), "motion").unwrap();
    let document = Document::parse(&text).unwrap();
    let dots = of_class(&document, "moving", "dot");
    assert_eq!(dots.len(), 2, "the point is drawn behind the box and before it");
    let [x, y] = ["cx", "cy"].map(|axis| values(dots[0], axis));
    assert_eq!((x.len(), y.len()), (121, 121));
    let rate = (PRECESSION.powi(2) + SPIN.powi(2) + 2.0 * PRECESSION * SPIN * TILT.cos()).sqrt();
    for (i, (x, y)) in x.iter().zip(&y).enumerate() {
        let [right, down] = spot(i as f64 * TAU / rate / 24.0, TIP);
        let off = [x.parse::<f64>().unwrap() - right, y.parse::<f64>().unwrap() - down];
        // half a unit of rounding
        assert!(off.iter().all(|off| off.abs() < 0.6), "frame {i}: {x} {y}, not {right} {down}");
    }
}

#[test]
fn far_sides_and_pieces_behind_are_hidden() {
    let text = picture(&record(5.0, 24.0), "motion").unwrap();
    let document = Document::parse(&text).unwrap();
    let seen_at = |node: Node, place: f64| {
        let times = node
            .children()
            .find(|child| child.attribute("attributeName") == Some("display"))
            .map_or_else(Vec::new, |found| {
                found.attribute("keyTimes").unwrap().split(';').map(|t| t.parse::<f64>().unwrap()).collect()
            });
        let states = values(node, "display");
        let now = times.iter().rposition(|time| *time <= place);
        now.is_none_or(|now| states[now] == "inline")
    };
    let faces: Vec<Node> =
        ["tone-1", "tone-2", "tone-3"].iter().flat_map(|tone| of_class(&document, "moving", tone)).collect();
    assert_eq!(faces.len(), 6);
    // at the start: the faces whose outward normals point to the observer
    let (sin, cos) = 0.35_f64.sin_cos();
    let normals = (0..6)
        .map(|i| [0, 1, 2].map(|axis| if axis == i / 2 { if i % 2 == 0 { 0.5 } else { -0.5 } } else { 0.0 }));
    let near = normals.filter(|normal| {
        let [x, _, z] = inertial(attitude(0.0), *normal);
        cos * x + sin * z > 0.0
    });
    let middle = |face: &Node| {
        let data = face.attribute("d").unwrap().replace('-', " -");
        let numbers: Vec<f64> =
            data[1..data.len() - 1].split_whitespace().map(|one| one.parse().unwrap()).collect();
        [0, 1].map(|axis| numbers.iter().skip(axis).step_by(2).sum::<f64>() / 4.0)
    };
    let mut seen: Vec<[f64; 2]> = faces.iter().filter(|face| seen_at(**face, 0.0)).map(middle).collect();
    for [right, down] in near.map(|normal| spot(0.0, normal)) {
        let count = seen.len();
        seen.retain(|[x, y]| (x - right).hypot(y - down) > 1.0);
        assert_eq!(seen.len() + 1, count, "a face about {right} {down}");
    }
    assert!(seen.is_empty(), "{seen:?}");
    for place in (0..200).map(|i| f64::from(i) / 200.0 + 1e-3) {
        let count = faces.iter().filter(|face| seen_at(**face, place)).count();
        assert!((1..=3).contains(&count), "{count} faces of a box at {place}");
        let dots = of_class(&document, "moving", "dot");
        assert_eq!(dots.iter().filter(|dot| seen_at(**dot, place)).count(), 1, "at {place}");
    }
}

#[test]
fn long_runs_show_stretches_of_one_length() {
    let record = record(300.0, 24.0);
    let text = picture(&record, "motion").unwrap();
    let document = Document::parse(&text).unwrap();
    let [x, y] = ["cx", "cy"].map(|axis| values(of_class(&document, "moving", "dot")[0], axis));
    let each = x.len() / 7;
    assert_eq!((x.len() % 7, each), (0, 61), "two and a half revolutions of 24 frames");
    let states = of_class(&document, "moving", "state");
    assert_eq!(states.len(), 7);
    assert!(
        states[0].text().unwrap().starts_with("at the start: nutation up to 22.9°"),
        "{:?}",
        states[0].text()
    );
    let t = &record.histories[0].columns[0].values;
    let room = t.len() - 1 - 144; // six revolutions of path are drawn
    for stretch in 0..7 {
        let [right, down] = spot(t[stretch * room / 6], TIP);
        let [x, y] = [&x, &y].map(|axis| axis[stretch * each].parse::<f64>().unwrap());
        assert!(
            (x - right).abs() < 0.6 && (y - down).abs() < 0.6,
            "stretch {stretch}: {x} {y}, not {right} {down}"
        );
    }
}

/// The angular momentum of a free body rests, as it is drawn; the file is XML without a script, within its size, with one clock.
#[test]
fn picture_is_xml_without_script_and_stands_still_on_demand() {
    let mut record = record(300.0, 24.0);
    record.model.name = "</svg><script>alert(1)</script>&".into();
    assert_eq!(figure_names(&record).last(), Some(&"motion"));
    let text = picture(&record, "motion").unwrap();
    assert!(text.len() < 300_000, "{} bytes", text.len());
    let document = Document::parse(&text).unwrap();
    let arrow = of_class(&document, "moving", "momentum")[0].first_element_child().unwrap();
    assert!(values(arrow, "x2").is_empty() && values(arrow, "y2").is_empty());
    let mut lengths: Vec<_> = document.descendants().filter_map(|node| node.attribute("dur")).collect();
    lengths.dedup();
    assert_eq!(lengths, ["16.8s"]);
    for node in document.descendants().filter(Node::is_element) {
        let name = node.tag_name().name();
        assert!(!matches!(name, "script" | "foreignObject" | "image" | "a" | "set"), "{name}");
        for attribute in node.attributes() {
            let value = attribute.value();
            assert!(
                !attribute.name().starts_with("on") && attribute.name() != "href",
                "{}",
                attribute.name()
            );
            assert!(!value.contains("NaN") && !value.contains("inf;"), "{value}");
        }
    }
    let still = document.descendants().find(|node| node.attribute("class") == Some("still")).unwrap();
    assert!(still.descendants().all(|node| node.tag_name().name() != "animate"));
    assert!(text.contains("@media (prefers-reduced-motion: reduce)"));
}

/// Rows that are more than a fifth of a revolution apart do not tell the motion; nor do extremes.
#[test]
fn records_that_do_not_tell_the_motion_have_no_moving_picture() {
    assert!(picture(&record(300.0, 5.0), "motion").is_some());
    assert!(picture(&record(300.0, 4.5), "motion").is_none());
    let mut thinned = record(300.0, 24.0);
    thinned.histories[0].rows *= 100;
    assert!(picture(&thinned, "motion").is_none());
    let without = RunRecord { scene: None, ..record(5.0, 24.0) };
    assert!(picture(&without, "motion").is_none() && !figure_names(&without).contains(&"motion"));
}
