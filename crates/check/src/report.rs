//! What is said about one submission.

use photon_list::reader::PhotonList;
use serde::Serialize;

use crate::compile::BuildError;
use crate::sections::Verdict;

/// Whether the submission builds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "status")]
pub enum Builds {
    /// It does.
    Yes,
    /// A file was not handed in.
    MissingFile {
        /// Which.
        file: &'static str,
    },
    /// It does not.
    No(BuildError),
    /// It does, but ends before any function of the assignment is called.
    EndsAtOnce {
        /// What happens.
        what: String,
    },
}

/// The whole run on the handout's scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Whole {
    /// How many photons were to be sent out.
    pub photons: u64,
    /// How many were stored, if the run ended.
    pub stored: Option<u64>,
    /// How many random numbers were drawn from `rand()` and its like.
    pub drawn: Option<u64>,
    /// How the run died.
    pub death: Option<String>,
}

/// The report on one submission.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Its name.
    pub submission: String,
    /// Whether it builds.
    pub builds: Builds,
    /// The sections, in the handout's order; none where it does not build.
    pub sections: Vec<Verdict>,
    /// The whole run.
    pub whole: Whole,
    /// What is worth saying about the whole submission.
    pub remarks: Vec<String>,
    /// Seconds for compiling and running.
    pub seconds: [f64; 2],
    /// The photon list of the whole run.
    #[serde(skip)]
    pub list: Option<PhotonList>,
}
