//! The table of misreadings: to add one, add an entry. What it leaves where, its name, its advice,
//! the table in the documentation and its tests follow.

mod direction;
mod path;
mod roulette;
mod single;

use crate::hypotheses::{Hypothesis, Misreading, to_the_letter};
use crate::reading::TangentBasis;
use crate::section::Section;
use crate::variation::{FACETS, Transformation, Variation};

pub use single::{Numbers, directions};

/// Paths that end one bounce too early: unless the limit is small, nothing shows of it.
pub const BOUNCE_OFF_BY_ONE: &str = "bounce-off-by-one";

/// A misreading, before its ways are told apart.
struct Entry {
    id: &'static str,
    section: Section,
    advice: &'static str,
    /// What each way to it is called, and how the tracer does it.
    ways: Vec<(String, Variation)>,
}

impl Entry {
    fn new<const WAYS: usize>(
        id: &'static str,
        section: Section,
        advice: &'static str,
        ways: [(&str, Variation); WAYS],
    ) -> Self {
        let ways = ways.map(|(title, variation)| (title.to_owned(), variation));
        Self { id, section, advice, ways: ways.into() }
    }

    /// A misreading that is known by its marks on single photons, not by where all of them lie.
    fn by_its_marks(
        id: &'static str,
        section: Section,
        advice: &'static str,
        title: &str,
        variation: Variation,
    ) -> Hypothesis {
        let misreading = Some(Misreading { section, advice });
        Hypothesis { id, title: title.to_owned(), misreading, variation }
    }

    fn hypotheses(self) -> impl Iterator<Item = Hypothesis> {
        let Self { id, section, advice, ways } = self;
        ways.into_iter().map(move |(title, variation)| Hypothesis {
            id,
            title,
            misreading: Some(Misreading { section, advice }),
            variation,
        })
    }
}

/// The misreadings of which the grader knows what they do.
pub fn misreadings() -> Vec<Hypothesis> {
    let steps = [
        path::emission(),
        path::storage(),
        roulette::roulette(),
        direction::sampling(),
        direction::transformation(),
    ];
    let mut all: Vec<_> = steps.into_iter().flatten().flat_map(Entry::hypotheses).collect();
    // Whoever misreads one step may take t and b as they are written.
    let uses_frame = |hypothesis: &&Hypothesis| {
        let Hypothesis { id, variation, .. } = hypothesis;
        variation.reading.tangent_basis == TangentBasis::Normalized
            && matches!(variation.frame, Transformation::AsRead | Transformation::Columns(_))
            && variation.hemisphere.uses_frame()
            && !["nan-frame", "no-absolute-value"].contains(id)
    };
    let literal: Vec<_> = all.iter().filter(uses_frame).map(to_the_letter).collect();
    all.extend(literal);
    all
}

/// Photons that meet the surface they leave. How many do depends on rounding, and so on the
/// program: `self_hits` has the part for every facet.
pub fn no_offset(self_hits: [f32; FACETS]) -> Hypothesis {
    Entry::by_its_marks(
        "no-offset",
        Section::HemisphereRayTransformation,
        "Start the scattered ray a little above the surface: the hit point plus 1e-5 times the \
         normal, as the framework does for shadow rays.",
        "scattered photons hit the triangle they leave",
        Variation { self_hits, ..Variation::default() },
    )
}

/// Paths that come again, as from a generator that is seeded for every photon, or alike in every
/// thread.
pub fn repeated_paths() -> Hypothesis {
    Entry::by_its_marks(
        "repeated-paths",
        Section::PhotonEmission,
        "Seed the generator once for the whole run, not for every photon; with threads, give each \
         a seed of its own.",
        "the same paths come more than once",
        Variation::default(),
    )
}

/// Photons that are inserted more than once.
pub fn stored_twice() -> Hypothesis {
    Entry::by_its_marks(
        "stored-twice",
        Section::PhotonStorage,
        "Insert a photon into the map once for every hit.",
        "every photon is stored more than once",
        Variation::default(),
    )
}

/// Those that are known by their marks on single photons.
pub fn by_marks() -> [Hypothesis; 3] {
    [no_offset([0.0; FACETS]), repeated_paths(), stored_twice()]
}

/// The names of all misreadings, in order.
pub fn names() -> Vec<&'static str> {
    let all = by_marks().into_iter().chain(misreadings());
    let mut names: Vec<_> = all.map(|hypothesis| hypothesis.id).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// All misreadings as a table of the documentation.
pub fn table() -> String {
    let mut text = "# The misreadings that have a name\n\n\
        Each picture shows the dots of the misreading, and those of the reference to its right.\n\
        `photon-mapping explore --misreading NAME` shows both in 3-D.\n\n\
        This page is the output of the example `misreadings` of `crates/variants`.\n"
        .to_owned();
    let mut all: Vec<_> = by_marks().into_iter().chain(misreadings()).collect();
    all.retain(|way| {
        way.variation.reading.tangent_basis != TangentBasis::LetterOfTheHandout
            || way.id == "no-absolute-value"
    });
    for section in Section::ALL {
        text += &format!(
            "\n## {}\n\n| name | what is done, and what to look at | dots |\n|---|---|---|\n",
            section.title()
        );
        let is_of_section =
            |way: &&Hypothesis| way.misreading.is_some_and(|it| it.section == section);
        let mut ways: Vec<&Hypothesis> = all.iter().filter(is_of_section).collect();
        ways.sort_by_key(|way| all.iter().position(|other| other.id == way.id));
        for same in ways.chunk_by(|a, b| a.id == b.id) {
            let Hypothesis { id, misreading, .. } = same[0];
            let titles: Vec<&str> = same.iter().map(|way| way.title.as_str()).collect();
            let titles = match titles.len() {
                1..=3 => titles.join(". Or: "),
                count => {
                    let (first, last) = (titles[0], titles[count - 1]);
                    format!("{first}. Or: {last}. Or one of {} ways like these", count - 2)
                }
            };
            let advice = misreading.map_or("", |it| it.advice);
            let picture = format!("![{id}](misreadings/{id}.png)");
            text += &format!("| `{id}` | {titles}. <br>{advice} | {picture} |\n");
        }
    }
    text
}
