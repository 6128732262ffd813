#![no_main]
quasirigid_libfuzzer::fuzz!("deck_abaqus");
