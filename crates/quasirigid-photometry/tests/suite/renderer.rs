//! Five shapes, three of them not convex, against the independent renderer in `tests/data/render.py`.

use quasirigid_mesh::surface::ClosedSurface;
use quasirigid_photometry::{Facets, Scattering};

use crate::support::{V, law};

/// Pixels at edges and shadows; those of the renderer and the facets of this test.
const PIXELS: f64 = 4e-3;

fn surfaces() -> Vec<(String, ClosedSurface)> {
    let mut found: Vec<(String, Vec<V>, Vec<[usize; 3]>)> = Vec::new();
    for line in include_str!("../data/shapes.txt").lines() {
        let (kind, rest) = line.split_once(' ').unwrap();
        let three = || <[&str; 3]>::try_from(rest.split(' ').collect::<Vec<_>>()).unwrap();
        match (kind, found.last_mut()) {
            ("v", Some((_, vertices, _))) => vertices.push(three().map(|number| number.parse().unwrap())),
            ("f", Some((_, _, triangles))) => triangles.push(three().map(|number| number.parse().unwrap())),
            _ => found.push((rest.to_owned(), Vec::new(), Vec::new())),
        }
    }
    let closed = |(name, vertices, triangles)| (name, ClosedSurface::new(vertices, triangles).unwrap());
    found.into_iter().map(closed).collect()
}

#[test]
fn brightness_is_that_of_an_independent_renderer() {
    let surfaces = surfaces();
    let concave = surfaces.iter().filter(|(_, surface)| !surface.is_convex()).count();
    assert!(surfaces.len() == 5 && concave == 3);
    let mut rows = 0;
    for row in include_str!("../data/brightness.csv").lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let number = |k: usize| cells[k].parse::<f64>().unwrap();
        let [sun, observer] = [[2, 3, 4], [5, 6, 7]].map(|place: [usize; 3]| place.map(number));
        let scattering = if cells[1] == "lambert" { Scattering::Lambert } else { Scattering::LommelSeeliger };
        let (_, surface) = surfaces.iter().find(|(name, _)| name == cells[0]).unwrap();
        let facets = Facets::of_surface(surface).refined(surface, 2);
        let found = facets.brightness(&law(scattering, 0.5), sun, observer);
        let whole = facets.mean_cross_section();
        assert!((found - number(8)).abs() < PIXELS * (number(8) + 0.1 * whole), "{row}: {found}");
        rows += 1;
    }
    assert_eq!(rows, 30);
}
