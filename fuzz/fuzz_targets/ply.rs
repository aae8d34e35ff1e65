//! Lists in PLY: every input starts as one.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    photon_mapping_fuzz::read_list(&[b"ply\n", data].concat());
});
