//! Inputs of a study as a record has them: files, values, and the body that they give.

use std::path::Path;

use quasirigid::elements::{Assembly, ElasticMaterial, Material, PartKind};
use quasirigid::model::{Principal, Rheology};
use quasirigid_io::model::Model;
use quasirigid_io::record::{DerivedBodyRecord, InputFileRecord, InputsRecord, SolidRecord};
use serde_json::{Value, json};

use crate::study::Study;

impl Study {
    /// A JSON object with what went into it.
    #[must_use]
    pub fn with_inputs(&self, mut object: Value) -> Value {
        object["inputs"] = json!(self.inputs());
        object
    }

    /// The text of a JSON object, whose keys keep their order, with what went into it as the last.
    #[must_use]
    pub fn ending_with_inputs(&self, object: &str) -> String {
        let text = object.trim_end();
        let open = text.strip_suffix('}').unwrap_or(text).trim_end();
        format!("{open},\n\"inputs\": {}\n}}", json!(self.inputs()))
    }

    /// Inputs of every answer of the study.
    #[must_use]
    pub fn inputs(&self) -> InputsRecord {
        let (mut values, left_out) = self.model.values();
        if self.order != self.model.run.order {
            let order = values.iter_mut().find(|value| value.key == "run.order");
            if let Some(value) = order {
                (value.value, value.default) = (json!(self.order), false); // asked for beside the file
            }
        }
        InputsRecord {
            version: env!("CARGO_PKG_VERSION").into(),
            files: files(&self.model),
            values,
            values_left_out: left_out as u64,
            body: Some(body(self)),
            notes: self.model.notes.clone(),
        }
    }
}

/// The model, then the files that its readers opened, by the names that they have in it.
fn files(model: &Model) -> Vec<InputFileRecord> {
    let source = &model.source;
    let name = source.file.file_name().unwrap_or(source.file.as_os_str());
    let own = InputFileRecord {
        name: name.to_string_lossy().into_owned(),
        bytes: source.text.len() as u64,
        sha256: source.sha256.clone(),
    };
    std::iter::once(own).chain(named_files(model)).collect()
}

/// The files that the readers of a model opened.
pub(crate) fn named_files(model: &Model) -> impl Iterator<Item = InputFileRecord> + '_ {
    let folder = model.source.file.parent().unwrap_or(Path::new(""));
    model.files.iter().map(move |file| InputFileRecord {
        name: file.path.strip_prefix(folder).unwrap_or(&file.path).to_string_lossy().into_owned(),
        bytes: file.bytes,
        sha256: file.sha256.clone(),
    })
}

fn body(study: &Study) -> DerivedBodyRecord {
    let assembly = &study.model.assembly;
    let solids = solids(assembly);
    let common = |of: fn(&SolidRecord) -> Option<f64>| {
        let value = of(solids.first()?)?;
        solids.iter().all(|solid| of(solid) == Some(value)).then_some(value)
    };
    let shear = common(|solid| Some(solid.shear));
    let quality_factor = common(|solid| solid.quality_factor);
    DerivedBodyRecord {
        mass: study.body.invariants().mass,
        size: size(assembly),
        principal_moments: Principal::compute(study.body.invariants().J).moments,
        volume: (!solids.is_empty()).then(|| solids.iter().map(|solid| solid.volume).sum()),
        density: common(|solid| Some(solid.density)),
        shear,
        quality_factor,
        mu_Q: shear.zip(quality_factor).map(|(shear, factor)| shear * factor),
        solids,
    }
}

/// Solids of an isotropic material.
fn solids(assembly: &Assembly) -> Vec<SolidRecord> {
    let ellipsoids = assembly.ellipsoids.iter().map(|solid| {
        let volume = 4.0 / 3.0 * std::f64::consts::PI * solid.semi_axes.iter().product::<f64>();
        record(&solid.name, volume, &solid.material)
    });
    let surfaces =
        assembly.surfaces.iter().map(|solid| record(&solid.name, solid.surface.volume(), &solid.material));
    let regions = assembly.parts.iter().flat_map(|part| {
        let PartKind::Solid(solid) = &part.kind else { return Vec::new() };
        let isotropic = solid.regions.iter().filter_map(|region| match &region.material {
            ElasticMaterial::Isotropic(material) => {
                let name = [part.name.as_str(), &region.name].join(" ");
                Some(record(name.trim(), solid.mesh.volume(&region.cells), material))
            }
            ElasticMaterial::Orthotropic(_) => None,
        });
        isotropic.collect()
    });
    ellipsoids.chain(surfaces).chain(regions).collect()
}

fn record(name: &str, volume: f64, material: &Material) -> SolidRecord {
    SolidRecord {
        name: name.into(),
        volume,
        density: material.density,
        shear: material.shear(),
        poisson: material.poisson,
        quality_factor: match material.rheology {
            Rheology::QualityFactor { factor } => Some(factor),
            _ => None,
        },
    }
}

/// Extent of the solids along the axes of the file (m).
fn size(assembly: &Assembly) -> Option<[f64; 3]> {
    let ellipsoids = assembly.ellipsoids.iter().map(|solid| {
        let end = |sign: f64| std::array::from_fn(|axis| solid.center[axis] + sign * solid.semi_axes[axis]);
        [end(-1.0), end(1.0)]
    });
    let surfaces = assembly.surfaces.iter().map(|solid| solid.surface.bounds());
    let meshes = assembly.parts.iter().flat_map(|part| {
        let PartKind::Solid(solid) = &part.kind else { return Vec::new() };
        let cells = solid.regions.iter().flat_map(|region| &region.cells);
        let nodes = cells.filter_map(|cell| solid.mesh.cells.get(*cell)).flat_map(|cell| &cell.nodes);
        nodes.map(|node| [solid.mesh.nodes[*node]; 2]).collect()
    });
    let both = |[low, high]: [[f64; 3]; 2], [least, greatest]: [[f64; 3]; 2]| {
        let end = |a: [f64; 3], b: [f64; 3], of: fn(f64, f64) -> f64| std::array::from_fn(|i| of(a[i], b[i]));
        [end(low, least, f64::min), end(high, greatest, f64::max)]
    };
    let [low, high] = ellipsoids.chain(surfaces).chain(meshes).reduce(both)?;
    Some(std::array::from_fn(|axis| high[axis] - low[axis]))
}
