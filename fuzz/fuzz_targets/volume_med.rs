#![no_main]
quasirigid_libfuzzer::fuzz!("volume_med");
