#![no_main]
quasirigid_libfuzzer::fuzz!("nodes");
