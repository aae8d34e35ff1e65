//! Model files, in one program of tests.

mod assignment8;
mod hard_cases;
mod obj;
