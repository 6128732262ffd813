//! Reports: what is made of records alone, the page, the comparison of several, single figures, and the body in motion.

pub use quasirigid_report::{
    Compared, FitColumn, GltfOptions, PngError, comparison_page, figure_names, fill_map_picture, fit_picture,
    gltf, light_curve_picture, page, picture, png, revolutions_per_frame, tornado_picture, yorp_picture,
};
