//! Tests of cross-sections: constants against small squares, tables, and finite elements on the section.
//! Torsion and shear areas have no elementary reference: numbers are from printed tables, or from Prandtl's membrane solved once.
//! Cowper's table `[@cowper1966]`; Timoshenko and Goodier, Theory of Elasticity, art. 109.

use super::*;
use crate::math::quadrature::gauss_legendre;

/// A section by many small squares: whether each is filled, and its side.
struct Grid {
    filled: Vec<(f64, f64)>,
    cell: f64,
}

const CELLS: usize = 400;

/// Region within `±half` along `y` and `z`, as squares.
fn grid(half: f64, inside: impl Fn(f64, f64) -> bool) -> Grid {
    let cell = 2.0 * half / CELLS as f64;
    let place = |i: usize| (i as f64 + 0.5) * cell - half;
    let all = (0..CELLS * CELLS).map(|i| (place(i % CELLS), place(i / CELLS)));
    Grid { filled: all.filter(|(y, z)| inside(*y, *z)).collect(), cell }
}

fn section(shape: SectionShape) -> Section {
    shape.section(0.3).unwrap()
}

/// Shapes whose edges are on the squares, or that have many squares along their edges.
fn shapes() -> Vec<(SectionShape, Grid, f64)> {
    let (radius, thickness) = (1.0, 0.3);
    vec![
        (
            SectionShape::Rectangle { height: 1.6, width: 0.8 },
            grid(1.0, |y, z| y.abs() < 0.4 && z.abs() < 0.8),
            1e-4,
        ),
        (SectionShape::Circle { radius }, grid(1.0, |y, z| y.hypot(z) < 1.0), 1e-3),
        (SectionShape::Tube { radius, thickness }, grid(1.0, |y, z| (0.7..1.0).contains(&y.hypot(z))), 1e-3),
        (
            SectionShape::Box { height: 2.0, width: 1.2, thickness: 0.2 },
            grid(1.0, |y, z| y.abs() < 0.6 && !(y.abs() < 0.4 && z.abs() < 0.8)),
            1e-4,
        ),
        (
            SectionShape::IBeam { height: 2.0, width: 1.2, web: 0.1, flange: 0.2 },
            grid(1.0, |y, z| y.abs() < 0.6 && (y.abs() < 0.05 || z.abs() > 0.8)),
            1e-4,
        ),
    ]
}

#[test]
fn areas_and_second_moments_are_those_of_many_small_squares() {
    for (shape, grid, tolerance) in shapes() {
        let found = section(shape);
        let sum = |f: fn((f64, f64)) -> f64| {
            grid.filled.iter().map(|place| f(*place)).sum::<f64>() * grid.cell.powi(2)
        };
        for (found, wanted) in [
            (found.area, sum(|_| 1.0)),
            (found.second_y, sum(|(_, z)| z * z)),
            (found.second_z, sum(|(y, _)| y * y)),
        ] {
            assert!((found / wanted - 1.0).abs() < tolerance, "{shape:?}: {found} {wanted}");
        }
    }
}

#[test]
fn a_rectangle_twists_as_tabulated() {
    // Timoshenko and Goodier, Theory of Elasticity, art. 109; the square to more digits: 0.140 577 014 955.
    for (ratio, factor) in
        [(1.0, 0.1406), (1.5, 0.196), (2.0, 0.229), (4.0, 0.281), (10.0, 0.312), (1e4, 1.0 / 3.0)]
    {
        for shape in [[0.3, 0.3 * ratio], [0.3 * ratio, 0.3]] {
            let found = section(SectionShape::Rectangle { height: shape[0], width: shape[1] }).torsion;
            // Digits printed there; the strip without end lacks 0.63 b/a.
            assert!((found / (0.3_f64.powi(4) * ratio) - factor).abs() < 6e-4, "{ratio}");
        }
    }
    let square = section(SectionShape::Rectangle { height: 1.0, width: 1.0 }).torsion;
    assert!((square - 0.140_577_014_955).abs() < 1e-12, "{square}");
}

#[test]
fn walls_and_plates_twist_as_finite_elements_on_the_section_say() {
    // Prandtl's membrane on 2·10⁵ to 10⁶ bilinear squares, the hole a stiff plate; extrapolated, good to 1e-3.
    let boxes = [
        ([10.0, 10.0, 0.5], 439.44, 0.022),
        ([10.0, 10.0, 1.0], 770.90, 0.040),
        ([10.0, 10.0, 2.0], 1181.2, 0.062),
        ([10.0, 10.0, 4.5], 1405.6, 0.010),
        ([20.0, 10.0, 1.0], 2164.9, 0.028),
        ([20.0, 10.0, 4.0], 4473.8, 0.043),
    ];
    for ([height, width, thickness], membrane, tolerance) in boxes {
        let found = section(SectionShape::Box { height, width, thickness }).torsion;
        assert!(
            (found / membrane - 1.0).abs() < tolerance,
            "{height} {width} {thickness}: {found} {membrane}"
        );
    }
    let beams = [
        ([20.0, 10.0, 1.0, 1.0], 12.836),
        ([20.0, 20.0, 1.0, 2.0], 107.24),
        ([20.0, 10.0, 1.5, 1.0], 27.866),
        ([20.0, 10.0, 0.25, 1.0], 6.3668),
        ([10.0, 6.0, 1.0, 1.0], 6.8301),
        ([4.0, 4.0, 1.0, 1.0], 3.4925),
    ];
    for ([height, width, web, flange], membrane) in beams {
        let found = section(SectionShape::IBeam { height, width, web, flange }).torsion;
        assert!((found / membrane - 1.0).abs() < 0.02, "{height} {width} {web} {flange}: {found} {membrane}");
    }
}

#[test]
fn a_thin_tube_twists_by_bredt_and_a_full_one_is_a_circle() {
    let tube = section(SectionShape::Tube { radius: 2.0, thickness: 1e-3 });
    assert!((tube.torsion / (2.0 * PI * 1.9995_f64.powi(3) * 1e-3) - 1.0).abs() < 1e-6);
    let full = section(SectionShape::Tube { radius: 2.0, thickness: 2.0 * (1.0 - 1e-9) });
    let circle = section(SectionShape::Circle { radius: 2.0 });
    for (found, wanted) in
        [(full.area, circle.area), (full.torsion, circle.torsion), (full.shear_y, circle.shear_y)]
    {
        assert!((found / wanted - 1.0).abs() < 1e-12);
    }
    assert!((circle.torsion - 8.0 * PI).abs() < 1e-13);
}

/// Two flanges of thickness `t` at `z = ±h/2`, and webs of the thickness `web` together at `y = ±place`.
struct Walls {
    h: f64,
    b: f64,
    t: f64,
    web: f64,
    place: f64,
    /// End at which the flow in half a flange is zero.
    end: f64,
}

impl Walls {
    /// Cowper's area by his definition `Q/(G γ)`, with `γ = W′ + Φ` of the mean slope `W′` and the mean rotation
    /// `Φ = ∫ z w dA/I`: the warping `w` along the walls under a unit shear force, from the flow of shear in balance
    /// with bending and from the displacements `ν κ (z² − y²)/2` and `ν κ y z` across, by Poisson's ratio.
    fn shear_area(&self, nu: f64) -> f64 {
        let Walls { h, b, t, web, place, end } = *self;
        let (top, young) = (0.5 * h, 2.0 * (1.0 + nu));
        let flange = b * t;
        let second = 2.0 * flange * top * top + web * h.powi(3) / 12.0;
        let other = 2.0 * t * b.powi(3) / 12.0 + web * h * place * place;
        let rate = -1.0 / (young * second);
        let slope = |z: f64| {
            let flow = (flange * top + 0.5 * web * (top * top - z * z)) / (second * web);
            flow - 0.5 * nu * rate * (z * z - place * place)
        };
        let warp = |z: f64| integral(0.0, z, slope);
        let across = |y: f64| {
            let bent = young * ((y - end).powi(2) - (place - end).powi(2)) - nu * (y * y - place * place);
            warp(top) + 0.5 * rate * top * bent
        };
        let webs = integral(-top, top, |z| z * warp(z) * web);
        let flanges = 4.0 * top * t * integral(0.0, 0.5 * b, across);
        let mean = 0.5 * nu * rate * (second - other) / (2.0 * flange + web * h);
        1.0 / (mean + (webs + flanges) / second)
    }
}

fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * (to - from);
    gauss_legendre(6).iter().map(|[x, weight]| half * weight * f(0.5 * (from + to) + half * x)).sum()
}

#[test]
fn shear_areas_of_thin_walls_are_those_of_cowper_s_definition() {
    // Walls so thin that middles and outsides do not differ.
    let (h, b, t) = (3.0, 1.4, 1e-6);
    for nu in [0.0, 0.2, 0.3, 0.45, -0.4] {
        let tube = SectionShape::Box { height: h, width: b, thickness: t }.section(nu).unwrap();
        let along = |h: f64, b: f64| Walls { h, b, t, web: 2.0 * t, place: 0.5 * b, end: 0.0 }.shear_area(nu);
        let beam = SectionShape::IBeam { height: h, width: b, web: t, flange: 1.5 * t }.section(nu).unwrap();
        let web = Walls { h, b, t: 1.5 * t, web: t, place: 0.0, end: 0.5 * b }.shear_area(nu);
        for (found, wanted) in [(tube.shear_z, along(h, b)), (tube.shear_y, along(b, h)), (beam.shear_z, web)]
        {
            assert!((found / wanted - 1.0).abs() < 1e-5, "{nu}: {found} {wanted}");
        }
        let plates = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * 3.0 * b * t;
        assert!((beam.shear_y / plates - 1.0).abs() < 1e-12, "two plates");
    }
}

#[test]
fn shear_areas_depend_on_poissons_ratio_as_cowper_found() {
    // Cowper (1966), table of coefficients for sections with one number only.
    let coefficient = |shape: SectionShape, poisson: f64| {
        let section = shape.section(poisson).unwrap();
        [section.shear_y, section.shear_z].map(|shear| shear / section.area)
    };
    for nu in [0.0, 0.2, 0.3, 0.45, -0.4] {
        let close = |found: [f64; 2], wanted: f64, tolerance: f64| {
            found.iter().for_each(|k| assert!((k / wanted - 1.0).abs() < tolerance, "{nu}: {k} {wanted}"));
        };
        close(
            coefficient(SectionShape::Circle { radius: 0.7 }, nu),
            6.0 * (1.0 + nu) / (7.0 + 6.0 * nu),
            1e-14,
        );
        let thin = SectionShape::Tube { radius: 0.7, thickness: 1e-6 };
        close(coefficient(thin, nu), 2.0 * (1.0 + nu) / (4.0 + 3.0 * nu), 1e-5);
        let square = SectionShape::Box { height: 0.7, width: 0.7, thickness: 1e-6 };
        close(coefficient(square, nu), 20.0 * (1.0 + nu) / (48.0 + 39.0 * nu), 1e-5);
        let plank = SectionShape::Rectangle { height: 0.7, width: 0.1 };
        close(coefficient(plank, nu), 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu), 1e-14);
    }
}

#[test]
fn what_is_no_section_is_refused() {
    let general = |area, second_y, torsion, shear| {
        SectionShape::General { area, second_y, second_z: 2.0, torsion, shear }.section(0.3)
    };
    assert!(general(1.0, 1.0, 1.0, None).unwrap().shear_y.is_infinite());
    assert_eq!(general(1.0, 1.0, 1.0, Some([0.3, 0.4])).unwrap().shear_z, 0.4);
    let found = [
        general(0.0, 1.0, 1.0, None),
        general(1.0, f64::NAN, 1.0, None),
        general(1.0, 1.0, f64::INFINITY, None),
        general(1.0, 1.0, 1.0, Some([0.3, -0.4])),
        SectionShape::Circle { radius: -1.0 }.section(0.3),
        SectionShape::Tube { radius: 1.0, thickness: 1.0 }.section(0.3),
        SectionShape::Box { height: 2.0, width: 1.0, thickness: 0.5 }.section(0.3),
        SectionShape::IBeam { height: 2.0, width: 1.0, web: 0.1, flange: 1.0 }.section(0.3),
        SectionShape::IBeam { height: 2.0, width: 0.1, web: 0.1, flange: 0.1 }.section(0.3),
        SectionShape::IBeam { height: 2.0, width: 1.0, web: 0.16, flange: 0.1 }.section(0.3),
        SectionShape::IBeam { height: 2.0, width: 1.0, web: 0.024, flange: 0.1 }.section(0.3),
        SectionShape::Circle { radius: 1.0 }.section(0.5),
        SectionShape::Circle { radius: 1.0 }.section(f64::NAN),
    ];
    found.iter().for_each(|result| assert!(result.is_err(), "{result:?}"));
    let told = found[6].clone().unwrap_err().to_string();
    assert_eq!(told, "the thickness of a section is 0.5, but there is room for less than 0.5");
}
