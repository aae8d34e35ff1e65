//! What the variants trace, in one program of tests.

mod hard_cases_of_place;
mod lanes;
mod lists;
mod misreadings;
