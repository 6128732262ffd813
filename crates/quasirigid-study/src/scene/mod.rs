//! Scene of a run: the body as a viewer draws it, its motion, its modes and its reduced equations.
//! A page must stay small: of many coordinates those are kept that move the body most, in the run or in a mode.

mod equations;
mod kept;
mod merged;
mod modes;
mod pieces;
mod track;

use quasirigid::elements::Visual;
use quasirigid::model::{FlexibleBody, Principal};
use quasirigid::modes::SpinModes;
use quasirigid_io::record::{CoordinateRecord, EquationsRecord, PrincipalRecord, SCENE_VERSION, SceneRecord};
use quasirigid_io::visible::one_line;
use quasirigid_math::vec3::norm;

pub(crate) use equations::equations;
pub(crate) use track::Frames;

use crate::study::Study;
use kept::Kept;

/// The scene of a run, from its frames, the modes about its steady spin and the reduced equations, where there are any.
pub(crate) fn scene(
    study: &Study,
    visuals: &[Visual],
    frames: Option<&Frames>,
    modes: Option<&SpinModes>,
    equations: Option<EquationsRecord>,
) -> SceneRecord {
    let body = &study.body;
    let kept = Kept::new(body, visuals, frames, modes);
    let principal = Principal::compute(body.invariants().J);
    let pieces: Vec<Visual> =
        merged::pieces_of(visuals).iter().map(|elements| merged::joined(elements, &kept)).collect();
    let rotors = pieces::rotors(&pieces);
    SceneRecord {
        version: SCENE_VERSION,
        name: one_line(&study.model.name),
        radius: radius(visuals, body),
        coordinates: kept
            .coordinates
            .iter()
            .map(|j| &body.coordinates()[*j])
            .map(|each| CoordinateRecord { name: one_line(&each.name), unit: each.unit.to_owned() })
            .collect(),
        pieces: pieces.iter().map(|visual| pieces::piece(visual, &kept, &rotors)).collect(),
        principal: PrincipalRecord { moments: principal.moments, axes: principal.axes },
        track: frames.map(|frames| frames.record(&kept.coordinates, &rotors)),
        spin: modes.map(|modes| modes.equilibrium.omega),
        modes: modes.map_or_else(Vec::new, |modes| modes::shapes(modes, &kept.coordinates)),
        equations: equations.map(|equations| kept.of(equations)),
    }
}

/// Radius of the sphere about the pole that holds every vertex; of a body that is not drawn, that of its inertia.
fn radius(visuals: &[Visual], body: &FlexibleBody) -> f64 {
    let vertices = visuals.iter().flat_map(|visual| &visual.vertices);
    let drawn = vertices.map(|vertex| norm(*vertex)).fold(0.0, f64::max);
    if drawn > 0.0 {
        return drawn;
    }
    let [xx, yy, zz, ..] = body.invariants().J;
    (0.5 * (xx + yy + zz) / body.invariants().mass).sqrt()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use quasirigid_io::model::{KeyValue, changed};
    use quasirigid_io::record::{RunRecord, SceneRecord, TermRecord};

    use crate::Study;
    use crate::settings::PartialRun;

    fn text(example: &str) -> String {
        let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
        std::fs::read_to_string(examples.join(example).join("model.toml")).unwrap()
    }

    fn run(text: &str) -> RunRecord {
        let study = Study::read_from(Path::new("model.toml"), text.as_bytes(), None).unwrap();
        study.run(&PartialRun::default(), &mut ()).unwrap().record
    }

    fn scene(text: &str) -> SceneRecord {
        run(text).scene.unwrap()
    }

    /// A body with every stiffness and every damping multiplied has the terms multiplied by the powers that the scene names.
    #[test]
    fn terms_scale_by_their_powers() {
        let (s, d): (f64, f64) = (1.7, 0.6);
        let short = text("boom-satellite").replace("duration = \"8 h\"", "duration = \"20 min\"");
        let scale = |key: &str, value: f64| (key.to_owned(), KeyValue::Number(value));
        let changes: Vec<(String, KeyValue)> = (1..=2)
            .flat_map(|spring| {
                [
                    scale(&format!("spring.{spring}.stiffness"), 500.0 * s),
                    scale(&format!("spring.{spring}.damping"), 50.0 * d),
                ]
            })
            .collect();
        let changes: Vec<(&str, KeyValue)> =
            changes.iter().map(|(key, given)| (&**key, given.clone())).collect();
        let [soft, stiff] =
            [short.clone(), changed(&short, &changes).unwrap()].map(|text| scene(&text).equations.unwrap());
        assert!(soft.scalable && soft.note.is_empty());
        let families = |of: &dyn Fn(&quasirigid_io::record::EquationsRecord) -> Vec<TermRecord>| {
            let [soft, stiff] = [of(&soft), of(&stiff)];
            assert!(!soft.is_empty() && soft.len() == stiff.len());
            for (soft, stiff) in soft.iter().zip(&stiff) {
                let factor = f64::powi(s, soft.stiffness) * f64::powi(d, soft.damping);
                let size = stiff.values.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
                for (soft, stiff) in soft.values.iter().flatten().zip(stiff.values.iter().flatten()) {
                    assert!((factor * soft - stiff).abs() < 1e-9 * size, "{factor} {soft} {stiff}");
                }
            }
        };
        families(&|equations| equations.energy_gradient.clone());
        families(&|equations| equations.c.clone());
        families(&|equations| equations.T.clone());
        families(&|equations| equations.momentum.clone());
        families(&|equations| equations.energy.clone());
        families(&|equations| equations.power.clone());
        families(&|equations| equations.displacements.clone());
        assert!(soft.limits.len() >= 3 && soft.limits.len() == stiff.limits.len());
        for (soft, stiff) in soft.limits.iter().zip(&stiff.limits) {
            let factor = s.powf(soft.stiffness) * d.powf(soft.damping);
            // the other body is spun at the same rate, so that its displacement is that of the scaled one but for the third order
            assert!((factor * soft.fails / stiff.fails - 1.0).abs() < 0.02, "{factor}: {soft:?} {stiff:?}");
        }
    }

    /// Frames are rows of the history, and the whole is small, whatever the body.
    #[test]
    fn scenes_are_small_and_their_frames_are_rows() {
        for example in ["apophis", "friction-wheel", "nutation-damper", "solar-panels"] {
            let record = run(&text(example));
            let scene = record.scene.as_ref().unwrap();
            let track = scene.track.as_ref().unwrap();
            let columns = &record.histories[0].columns;
            let column = |name: &str| &columns.iter().find(|column| column.name == name).unwrap().values;
            let frames = track.t.0.len();
            assert!((2..=2_000).contains(&frames), "{example}: {frames}");
            let stride = (column("t").len() - 1) / (frames - 1);
            for (frame, t) in track.t.0.iter().enumerate() {
                assert_eq!(*t, column("t")[frame * stride], "{example}");
                assert_eq!(track.omega.0[3 * frame + 1], column("wy")[frame * stride] as f32, "{example}");
                assert_eq!(track.attitude.0[4 * frame], column("qw")[frame * stride] as f32, "{example}");
            }
            let lengths = scene.track.as_ref().and_then(|track| track.q.as_ref()).map(|q| q.0.len());
            assert_eq!(lengths.unwrap_or(0), frames * scene.coordinates.len(), "{example}");
            assert!(scene.pieces.iter().all(|piece| {
                piece.fields.iter().all(|field| field.vectors.values.0.len() == piece.vertices.values.0.len())
            }));
            let size = serde_json::to_string(scene).unwrap().len();
            assert!(size < 1_500_000, "{example}: {size} bytes");
        }
    }

    /// A wheel whose motor keeps its momentum has no coordinate to turn by.
    #[test]
    fn wheels_beside_rotors_stand_still() {
        let wheel = "[[wheel]]\nname = \"bias\"\naxis = [0, 0, 1]\nmomentum = 0.1\n";
        let model = text("friction-wheel").replace("evolve = {}\n", "");
        let scene = scene(&format!("{model}\n{wheel}"));
        let turning: Vec<_> = scene.pieces.iter().filter_map(|piece| piece.turning.as_ref()).collect();
        assert_eq!(turning.iter().map(|turning| turning.rotor).collect::<Vec<_>>(), [0]);
        assert!(scene.track.unwrap().rotors.unwrap().0.iter().any(|angle| *angle > 0.0));
    }

    /// A wheel turns by the integral of its rate, and the modes turn the body about its steady spin.
    #[test]
    fn rotors_turn_and_modes_nutate() {
        let scene = scene(&text("friction-wheel"));
        let turning = scene.pieces.iter().find_map(|piece| piece.turning.as_ref()).unwrap();
        assert_eq!(turning.rotor, 0);
        assert!(scene.track.unwrap().rotors.unwrap().0.iter().any(|angle| *angle > 0.0));
        let nutation = &scene.modes[0];
        assert_eq!(nutation.name, "nutation");
        assert!(nutation.rotation.as_flattened().iter().any(|part| part.abs() > 1e-6));
        assert!(!scene.equations.unwrap().scalable);
    }
}
