//! The page as a student uses it, and the pictures of the documentation. One program of tests: it
//! is linked once, and its browsers serve one test after another.

mod browser;
mod overlays;
mod page;
mod panel;
mod pictures;
mod reach;
mod source;
mod support;
