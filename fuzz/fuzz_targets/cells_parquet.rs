#![no_main]
quasirigid_libfuzzer::fuzz!("cells_parquet");
