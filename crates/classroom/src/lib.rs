//! A class: the submissions among its files, those that are alike, and what each gets back, as
//! text, as a page, and as Gradescope reads it. The judge is another crate, which knows of one
//! submission alone.

pub mod class;
pub mod gradescope;
pub mod intake;
pub mod page;
pub mod text;
pub mod twins;
pub mod written;
