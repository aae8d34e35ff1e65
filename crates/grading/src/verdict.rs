//! What a grade says.

use std::borrow::Cow;

use serde::Serialize;

use super::limits::SIGNIFICANCE;
use variants::section::Section;

/// The verdict on a submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// What the handout asks for, in one of its fair readings.
    Correct,
    /// Too few photons to tell whether it is what the handout asks for.
    Undecided,
    /// Something else.
    Incorrect,
    /// Nothing was stored, or nothing is shown.
    NoDots,
    /// Not a submission.
    Unreadable,
}

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weight {
    /// It makes a submission incorrect, and its photons can be neither where nor what they are.
    Grave,
    /// It makes a submission incorrect.
    Fault,
    /// It is worth saying, and costs nothing.
    Remark,
}

/// What one check found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The check's name.
    pub check: &'static str,
    /// The section of the handout that it is about.
    pub section: Option<&'static str>,
    /// What the handout leads to expect.
    pub expected: String,
    /// What was found.
    pub found: String,
    /// The chance of finding this, or something stranger, in a correct submission, with regard to
    /// how much was looked at; nothing for what is certain.
    pub p_value: Option<f64>,
    /// Whether it is as it should be.
    pub passed: bool,
    /// What it weighs if it is not.
    pub weight: Weight,
    /// What to look at.
    pub advice: Cow<'static, str>,
}

/// The grade of one submission.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Grade {
    /// Its name.
    pub submission: String,
    /// How many photons were emitted, if that is known.
    pub emitted: Option<u64>,
    /// How many photons were stored; nothing when only a picture was handed in.
    pub stored: Option<u64>,
    /// By the handout's rubric, or the course's.
    pub score: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// The misreading that explains it, if a known one does.
    pub misreading: Option<&'static str>,
    /// How sure that is, among the known ones.
    pub misreading_confidence: Option<f64>,
    /// What that is, in words.
    #[serde(skip)]
    pub misreading_title: Option<String>,
    /// In the order in which they are to be read.
    pub findings: Vec<Finding>,
    /// What students do not see.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub for_course: Vec<String>,
}

/// The check of files that two students have in common.
pub const SAME_FILES: &str = "same files";

impl Grade {
    /// The sections of the handout that speak against it, each once.
    pub fn sections(&self) -> Vec<&'static str> {
        let faults = self.findings.iter().filter(|finding| finding.is_fault());
        each_once(faults.filter_map(|finding| finding.section))
    }

    /// The checks with remarks, each once.
    pub fn remarks(&self) -> Vec<&'static str> {
        let is_remark = |f: &&Finding| !f.passed && f.weight == Weight::Remark;
        each_once(self.findings.iter().filter(is_remark).map(|finding| finding.check))
    }

    /// What was found wrong by running a section of the code itself.
    pub fn wrong_sections(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| finding.is_section() && finding.is_fault())
    }
}

fn each_once(words: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    let mut once = Vec::new();
    for word in words {
        if !once.contains(&word) {
            once.push(word);
        }
    }
    once
}

impl Finding {
    /// Whether it is about a whole section of the handout, whose code was run by itself.
    pub fn is_section(&self) -> bool {
        self.section == Some(self.check)
    }

    /// A remark: `found` in place of what is `expected`.
    pub fn new(
        check: &'static str,
        expected: impl Into<String>,
        found: impl Into<String>,
        advice: &'static str,
    ) -> Self {
        Self {
            check,
            section: None,
            expected: expected.into(),
            found: found.into(),
            p_value: None,
            passed: false,
            weight: Weight::Remark,
            advice: advice.into(),
        }
    }

    /// The same of a section of the handout.
    pub fn of(self, section: Section) -> Self {
        Self { section: Some(section.title()), ..self }
    }

    /// The same with another weight.
    pub fn weighing(self, weight: Weight) -> Self {
        Self { weight, ..self }
    }

    /// The same, which is as it should be if it `passed`: then there is nothing to look at.
    pub fn passed_if(self, passed: bool) -> Self {
        Self { passed, advice: if passed { "".into() } else { self.advice }, ..self }
    }

    /// The same of what comes by chance as often as `p_value`: too rarely, or it is as it should
    /// be.
    pub fn by_chance(self, p_value: f64) -> Self {
        Self { p_value: Some(p_value), ..self.passed_if(p_value >= SIGNIFICANCE) }
    }

    /// Whether it speaks against the submission.
    pub fn is_fault(&self) -> bool {
        !self.passed && self.weight != Weight::Remark
    }

    /// Whether it names other students, and so is for the course alone.
    pub fn is_of_others(&self) -> bool {
        self.check == SAME_FILES
    }
}
