//! Pictures: every input starts as one.
#![no_main]

use grading::picture::reading::read_picture;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let png = [b"\x89PNG\r\n\x1a\n", data].concat();
    photon_mapping_fuzz::with_file("a.png", &png, |path| {
        if let Ok(picture) = read_picture(path) {
            assert_eq!(picture.dimensions(), (640, 480));
        }
    });
});
