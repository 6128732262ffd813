#![no_main]
quasirigid_libfuzzer::fuzz!("history_npz");
