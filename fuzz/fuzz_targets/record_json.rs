#![no_main]
quasirigid_libfuzzer::fuzz!("record_json");
