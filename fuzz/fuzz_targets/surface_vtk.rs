#![no_main]
quasirigid_libfuzzer::fuzz!("surface_vtk");
