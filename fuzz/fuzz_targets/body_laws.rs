#![no_main]
quasirigid_libfuzzer::fuzz!("body_laws");
