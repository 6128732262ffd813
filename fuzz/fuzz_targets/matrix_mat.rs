#![no_main]
quasirigid_libfuzzer::fuzz!("matrix_mat");
