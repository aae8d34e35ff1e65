//! A verdict on a submission, and the reason for it.

pub mod exact;
pub mod hypotheses;
pub mod judge_list;
pub mod naming;
pub mod observation;
pub mod picture;
pub mod places;
pub mod policy;
pub mod signature;
pub mod statistics;
pub mod submission;
pub mod text;
pub mod variation;
pub mod verdict;
