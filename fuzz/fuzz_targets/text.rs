//! Lists in text.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| photon_mapping_fuzz::read_list(data));
