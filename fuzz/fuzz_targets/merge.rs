//! What headers say of their runs, and whether they belong together.
#![no_main]

use photon_list::ply;
use photon_list::run::RunPart;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let headers = data.split(|byte| *byte == 0).take(8);
    let comments = |header: &[u8]| {
        photon_mapping_fuzz::with_file("list.ply", header, |path| ply::comments(path)).ok()
    };
    let parts: Vec<RunPart> =
        headers.filter_map(comments).filter_map(|lines| RunPart::from_comments(&lines)).collect();
    for part in &parts {
        assert_eq!(RunPart::from_comments(&part.comments()).as_ref(), Some(part));
    }
    if !parts.is_empty() {
        let mut order: Vec<usize> = (0..parts.len()).collect();
        let _ = RunPart::join(&parts, &mut order);
    }
});
