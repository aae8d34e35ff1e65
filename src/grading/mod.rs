//! A verdict on a submission, and the reason for it.

pub mod axes;
pub mod class;
pub mod exact;
pub mod gradescope;
pub mod hypotheses;
pub mod intake;
pub mod judge_list;
pub mod naming;
pub mod observation;
pub mod page;
pub mod places;
pub mod policy;
pub mod signature;
pub mod statistics;
pub mod submission;
pub mod text;
pub mod variation;
pub mod verdict;
