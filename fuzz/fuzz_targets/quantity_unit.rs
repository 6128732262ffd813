#![no_main]
quasirigid_libfuzzer::fuzz!("quantity_unit");
