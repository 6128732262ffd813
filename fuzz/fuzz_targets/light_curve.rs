#![no_main]
quasirigid_libfuzzer::fuzz!("light_curve");
