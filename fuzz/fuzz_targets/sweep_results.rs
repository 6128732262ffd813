#![no_main]
quasirigid_libfuzzer::fuzz!("sweep_results");
