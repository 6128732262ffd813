#![no_main]
quasirigid_libfuzzer::fuzz!("bodies_votable");
