#![no_main]
quasirigid_libfuzzer::fuzz!("study_tables");
