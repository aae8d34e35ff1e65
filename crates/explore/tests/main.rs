//! The page as a student uses it, and the pictures of the documentation. One program of tests: it is
//! linked once, and one browser serves all.

mod browser;
mod overlays;
mod page;
mod panel;
mod pictures;
mod reach;
mod source;
mod support;
