//! What a picture says beside a list, and what the course is told of both.

use std::path::Path;

use super::judge_list::Expectations;
use super::limits::submission::{FEWEST_DOTS, TOGETHER};
use super::own::{seed_of, seed_of_picture};
use super::picture::dots::{FoundDots, find_dots};
use super::picture::reading::read_picture;
use super::picture::view::{PIXELS, View};
use super::submission::{Graded, Settings, remark};
use super::text::rounded;
use super::verdict::Finding;
use photon_list::reader::PhotonList;

/// What the course is told, if this program's own list was handed in.
pub(super) fn own(graded: &Graded, settings: &Settings) -> Option<String> {
    let (list, _) = graded.list.as_ref()?;
    seed_of(&list.records, settings.seed).map(|seed| told_own("photons", seed))
}

/// The same for a picture.
pub(super) fn own_picture(
    picture: &Path,
    settings: &Settings,
    expectations: &Expectations,
) -> Option<String> {
    let (dots, view) = dots_of(picture, expectations)?;
    seed_of_picture(&dots.red, view, settings.seed).map(|seed| told_own("dots", seed))
}

fn told_own(what: &str, seed: u64) -> String {
    format!(
        "the {what} are all or part of what this program produces with --seed {seed}; a correct \
         program that draws the same random numbers produces them, too"
    )
}

/// The dots of `picture`, and the view in which they are.
fn dots_of<'a>(picture: &Path, expectations: &'a Expectations) -> Option<(FoundDots, &'a View)> {
    let expectations = expectations.pictures();
    let picture = read_picture(picture).ok()?;
    let dots = find_dots(&picture, &expectations.view, || expectations.shifted()).ok()?;
    let view = if dots.is_shifted { expectations.shifted() } else { &expectations.view };
    Some((dots, view))
}

/// A remark, if the dots of `picture` are not the photons of `list`.
pub(super) fn apart(
    list: &PhotonList,
    picture: &Path,
    expectations: &Expectations,
) -> Option<Finding> {
    let (dots, view) = dots_of(picture, expectations)?;
    let mut of_list = vec![false; PIXELS];
    for record in &list.records {
        view.for_each_pixel_of(record.position, |pixel| of_list[pixel] = true);
    }
    let inside = |pixel: &usize| view.patch(*pixel).is_some();
    let count = |is_counted: &dyn Fn(usize) -> bool| {
        (0..PIXELS).filter(inside).filter(|pixel| is_counted(*pixel)).count() as f64
    };
    let both = count(&|pixel| dots.red[pixel] && of_list[pixel]);
    let [of_picture, of_list] = [count(&|pixel| dots.red[pixel]), count(&|pixel| of_list[pixel])];
    let least = of_picture.min(of_list);
    let fewer = (of_picture / of_list).min(of_list / of_picture);
    if least < FEWEST_DOTS || (both > TOGETHER * least && fewer > TOGETHER) {
        return None;
    }
    let found = format!(
        "of {} red pixels of the picture and {} of the list's photons, {} are the same",
        rounded(of_picture),
        rounded(of_list),
        rounded(both)
    );
    let advice = "Hand in the list and the picture of one run: the list is what is graded.";
    Some(remark("list and picture", "dots where the list's photons are", &found, advice))
}
