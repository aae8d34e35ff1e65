//! A page's maps and plots of photons: on every face, by direction and by bounce.

use maud::{Markup, PreEscaped, html};

use super::Pages;
use super::plot::{self, Histogram};
use super::profile::{Axis, LAST_BOUNCE, Profile};
use grading::judge_list::Judgment;
use grading::places::MARGIN;
use grading::signature::classes;
use grading::text::rounded;
use photon_list::reader::PhotonList;
use variants::variation::{FACETS, Variation};

/// With how many photons the curves of a page are measured: for the handout, and for a misreading,
/// which takes longer to trace.
const PHOTONS_FOR_CURVES: u64 = 1_000_000;
const PHOTONS_FOR_MISREADINGS: u64 = 300_000;

impl Pages<'_> {
    /// What is expected of one photon under `variation`, measured with `photons`.
    fn profile(&self, variation: Variation, photons: u64) -> Profile {
        let kept = || self.profiles.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let known = kept().iter().find(|(other, _)| *other == variation).map(|(_, p)| p.clone());
        // Measured without the lock: a thread that waits for others' pieces may take up another
        // page.
        known.unwrap_or_else(|| {
            let max_bounces = self.expectations.signatures.max_bounces;
            let places = &self.expectations.places;
            let profile = Profile::expected(variation, max_bounces, places, photons, 1.0);
            // Self-hits differ from student to student.
            if variation.self_hits == [0.0; FACETS] {
                kept().push((variation, profile.clone()));
            }
            profile
        })
    }

    /// The photons of `list` beside those of the reading and the misreading of `judgment`. Counts
    /// are those of the findings.
    pub(super) fn faces(&self, list: &PhotonList, judgment: &Judgment) -> Markup {
        let places = &self.expectations.places;
        let Judgment { emitted, signature, .. } = judgment;
        let first = list.records.iter().map(|record| record.bounce).min().unwrap_or_default();
        let found = Profile::of(&list.records, places, first);
        let by_class = classes(&found.counts, places);
        let expected =
            self.profile(judgment.reading.variation, PHOTONS_FOR_CURVES).scaled(*emitted);
        let misread = judgment.explanation.as_ref().map(|explanation| {
            self.profile(explanation.hypothesis.variation, PHOTONS_FOR_MISREADINGS)
                .scaled(explanation.emitted)
        });
        let misread = misread.as_ref();
        let scaled = |numbers: &[f64]| numbers.iter().map(|n| n * emitted).collect::<Vec<f64>>();
        let (cells, variance) = (scaled(&signature.cells), scaled(&signature.variance));
        let by_class_expected = scaled(&signature.classes);
        let both = |class: usize| {
            format!(
                "{} found, {} expected",
                rounded(by_class[class]),
                rounded(by_class_expected[class])
            )
        };
        let edges = places.facets.len();
        html! {
            h2 { "Photons on every face" }
            p.small {
                "Maps: photons found in each cell divided by those expected; in orange where there \
                 are more and in blue where there are fewer by over two standard deviations. \
                 Plots: bars are found, the black line is expected, with a gray band of two \
                 standard deviations"
                @if misread.is_some() { "; the orange line is what the misreading leads to" }
                ". x, y and z are the world's, z up. Photons within " (MARGIN) " of the edge where \
                 two faces meet are counted apart: " (both(edges)) "."
            }
            div.facets {
                @for (at, facet) in places.facets.iter().enumerate() {
                    @let axes = Axis::of(facet);
                    section.facet {
                        h3 { (places.name(at)) }
                        p { (both(at)) }
                        (plot::map(facet, &axes, &found.counts.cells, &cells, &variance))
                        @for number in Axis::order(&axes) {
                            (PreEscaped(Histogram {
                                what: format!("photons along {}", axes[number].name),
                                ends: axes[number].ends,
                                found: &found.along[at][number],
                                expected: &expected.along[at][number],
                                misread: misread.map(|misread| &misread.along[at][number][..]),
                            }.svg()))
                        }
                    }
                }
                @if has_directions(list) {
                    section.facet {
                        h3 { "Incoming directions" }
                        p { "The cosine between the direction to the light and the normal, on all \
                             faces; what comes from behind has 0." }
                        (PreEscaped(Histogram {
                            what: "photons by cosine".to_owned(),
                            ends: [0.0, 1.0],
                            found: &found.cosines,
                            expected: &expected.cosines,
                            misread: misread.map(|misread| &misread.cosines[..]),
                        }.svg()))
                    }
                }
                @if list.columns.bounce {
                    section.facet {
                        h3 { "Bounces" }
                        p { "1 is the first bounce after which photons are stored; the last bar \
                             has all later ones." }
                        (PreEscaped(Histogram {
                            what: "photons by bounce".to_owned(),
                            ends: [0.5, LAST_BOUNCE as f64 + 0.5],
                            found: &found.bounces,
                            expected: &expected.bounces,
                            misread: misread.map(|misread| &misread.bounces[..]),
                        }.svg()))
                    }
                }
            }
        }
    }
}

/// Whether directions to the light are given, and not one for all, as those of a ray that is never
/// set.
fn has_directions(list: &PhotonList) -> bool {
    let directions = || list.records.iter().map(|record| record.to_light);
    list.columns.to_light && directions().any(|direction| Some(direction) != directions().next())
}
