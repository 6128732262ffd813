#![no_main]
quasirigid_libfuzzer::fuzz!("formula_text");
