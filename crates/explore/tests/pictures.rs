//! The pictures of `docs/explore.md`. With `UPDATE_PICTURES=1` in the environment, this test takes
//! them again: what browsers draw differs by their fonts, so it compares no pixels.

use std::path::{Path, PathBuf};

use crate::browser::launch;
use crate::support::{handout, write_page};
use explore::comparison::{ListComparison, Other};
use explore::misreading;
use photon_list::reader::PhotonList;

const SIZE: (u32, u32) = (1280, 960);

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name)
}

/// Writes what the browser shows of `page` at `link` to the picture `name`.
fn take(name: &str, page: &Path, link: &str) {
    let Some(browser) = launch(true) else { panic!("pictures need chromium") };
    browser.size(SIZE.0, SIZE.1);
    browser.call("Emulation.setScrollbarsHidden", serde_json::json!({ "hidden": true }));
    browser.open(page, link);
    browser.screenshot().save(file(name)).expect("it can be written");
}

#[test]
fn the_documentation_has_the_pictures() {
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        let (run, page) = handout();
        take("explore.png", page, "#photon=73&bounce=0&step=roulette");
        let (misreading, records) =
            misreading::trace("transposed-frame", &run.run).expect("it is in the table");
        let list = PhotonList { records, ..run.list() };
        let other = Other::Misreading(misreading);
        let comparison = ListComparison::new(other, run.list(), list, &run.run);
        let page = write_page("picture", &run.exploration(Some(&comparison)).page());
        take("explore-comparison.png", &page, "");
    }
    for name in ["explore.png", "explore-comparison.png"] {
        let size = image::image_dimensions(file(name));
        assert_eq!(size.ok(), Some(SIZE), "{name}: run this test with UPDATE_PICTURES=1");
    }
}
