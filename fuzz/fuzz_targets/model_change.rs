#![no_main]
quasirigid_libfuzzer::fuzz!("model_change");
