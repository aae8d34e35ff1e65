//! What the score of a page comes from.

use maud::{Markup, html};

use grading::policy::{Policy, SectionPoints, points};
use grading::recognized::scored_as;
use grading::verdict::{Grade, Verdict};

/// The rubric by `policy`, with the row of `grade` marked; or the points of each section, where
/// sections have points and one is wrong.
pub fn rubric(grade: &Grade, policy: &Policy) -> Markup {
    let findings = 0..grade.findings.len();
    let sections: Vec<_> = findings.filter_map(|at| points(grade, at, policy)).collect();
    if sections.iter().any(|section| section.score < section.most) {
        return of_sections(&sections);
    }
    let Policy { correct, undecided, plausible, incorrect, no_dots, unreadable, .. } = policy;
    let own = grade.misreading.and_then(|id| Some((id, *policy.misreadings.get(id)?)));
    let row = |score: f64, words: &str, verdict| (score, words.to_owned(), verdict);
    let mut rows = vec![
        row(*correct, "dots as the handout's photons leave them", Verdict::Correct),
        row(
            *plausible,
            "dots that look incorrect, but finite, on surfaces, and indirect only",
            Verdict::Incorrect,
        ),
        row(*incorrect, "dots that look incorrect otherwise", Verdict::Incorrect),
    ];
    rows.extend(
        own.map(|(id, score)| (score, format!("with the misreading {id}"), Verdict::Incorrect)),
    );
    rows.push(row(*no_dots, "no dots", Verdict::NoDots));
    rows.push(row(*unreadable, "nothing that can be read, or no photon map", Verdict::Unreadable));
    rows.push(row(
        *undecided,
        "too few photons to tell or to recognize: needs a look",
        Verdict::Undecided,
    ));
    let verdict = scored_as(grade.verdict, &grade.findings);
    let is_row = |row: &(f64, String, Verdict)| row.2 == verdict && row.0 == grade.score;
    // The last of those that fit: a score of a misreading's own stands after the others.
    let chosen = rows.iter().rposition(is_row);
    html! {
        table.rubric {
            caption { "Rubric" }
            @for (at, (score, words, _)) in rows.iter().enumerate() {
                tr.chosen[chosen == Some(at)] { td { (score) } td { (words) } }
            }
        }
    }
}

fn of_sections(sections: &[SectionPoints]) -> Markup {
    html! {
        table.rubric {
            caption { "Points by section" }
            @for section in sections {
                tr { td { (section.score) " of " (section.most) } td { (section.title) } }
            }
        }
    }
}
