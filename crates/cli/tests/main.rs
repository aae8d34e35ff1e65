//! The program as a user runs it, and what the pages say of it. One program of tests: it is linked
//! once, and tests that wait take no other test's time. Tests start in the order of their names:
//! what waits longest comes first.

mod array_job;
mod check;
mod command_line;
mod companion;
mod compare;
mod expectation;
mod explain;
mod explore;
mod files;
mod grade;
mod grade_formats;
mod grade_pictures;
mod gradebook;
mod hostile_class;
mod intake;
mod interop;
mod kit_gradescope;
mod kit_student;
mod merge;
#[path = "other_programs/main.rs"]
mod other_programs;
#[path = "pages/main.rs"]
mod pages;
#[path = "report/main.rs"]
mod report;
mod shell;
mod support;
