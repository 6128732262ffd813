#![no_main]
quasirigid_libfuzzer::fuzz!("attitude_aem");
