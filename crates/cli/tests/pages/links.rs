//! Links between pages.

use std::path::Path;

use super::markdown::{anchors, links};
use super::{pages, read, root};

/// The page of releases, as the README's page on GitHub sees it.
const RELEASES: &str = "../../releases";

#[test]
fn links_and_anchors_exist() {
    let mut seen = 0;
    for (path, page) in pages() {
        for link in links(&page).iter().filter(|link| !link.contains("://") && *link != RELEASES) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = Path::new(&path).parent().expect("a file is in a folder");
            let target = if file.is_empty() { path.clone().into() } else { folder.join(file) };
            assert!(root().join(&target).exists(), "{path}: {link} leads nowhere");
            if !anchor.is_empty() {
                let text = read(&target);
                assert!(anchors(&text).iter().any(|a| a == anchor), "{path}: no anchor {link}");
            }
            seen += 1;
        }
    }
    assert!(seen > 30, "found only {seen} links");
}
