//! `grade` on pictures: through the library, and as a user runs it.

#[path = "../../grading/examples/common/simulated_pictures.rs"]
mod simulated_pictures;

use std::fs;
use std::path::Path;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use crate::support::{folder, json, run_line};
use glam::Vec3;
use grading::expected::Groups;
use grading::picture::dot_size::DotSize;
use grading::picture::dots::{FoundDots, find_dots};
use grading::picture::expectations::PictureExpectations;
use grading::picture::expected::expect;
use grading::picture::judge::{PictureJudgment, judge_dots};
use grading::picture::reading::read_picture;
use grading::picture::signature::measure;
use grading::picture::view::{PIXELS, View};
use grading::places::Places;
use image::{DynamicImage, Rgb, RgbImage, imageops};
use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;
use serde_json::Value;
use simulated_pictures::{misread, simulate_dots};
use variants::hypotheses::fair_readings;
use variants::variation::{Emission, Hemisphere, Roulette, Simulation, Variation};

const MILLION: u64 = 1_000_000;

fn expectations() -> &'static PictureExpectations {
    static EXPECTATIONS: OnceLock<PictureExpectations> = OnceLock::new();
    let places = || Places::new(&create_scene());
    EXPECTATIONS.get_or_init(|| PictureExpectations::new(&places(), MAX_PHOTON_BOUNCES))
}

fn simulate(variation: Variation, seed: u64, emitted: u64, standoff: f32) -> Vec<bool> {
    let all = expectations();
    simulate_dots(variation, seed, emitted, standoff, &all.places, &all.view)
}

fn judge(red: &[bool], emitted: Option<u64>) -> PictureJudgment {
    let all = expectations();
    judge_dots(red, &all.view, emitted.map(|emitted| emitted as f64), all)
}

fn named(judgment: &PictureJudgment) -> Option<&'static str> {
    judgment.explanation.as_ref().map(|explanation| explanation.hypothesis.id)
}

/// The direct light of `view`, with `dot` done to the pixels of `red`.
fn paint(view: &View, red: &[bool], dot: impl Fn(&mut Rgb<u8>)) -> RgbImage {
    let mut picture = view.direct.clone();
    picture.pixels_mut().zip(red).filter(|(_, is_red)| **is_red).for_each(|(pixel, _)| dot(pixel));
    picture
}

fn framework_dot(pixel: &mut Rgb<u8>) {
    pixel.0[0] = 255;
}

fn dots_of(picture: &RgbImage) -> Result<FoundDots, String> {
    find_dots(picture, &expectations().view, || expectations().shifted())
}

/// The grade of the file `path`, by the command line.
fn grade(path: &Path, more: &str) -> Value {
    let line = format!("grade --format json{more} {{}}");
    json(run_line(&line, &[path]).success())
}

fn found(grade: &Value) -> String {
    grade["findings"][0]["found"].as_str().expect("a finding says what was found").to_owned()
}

/// What is done to every pixel.
type Change = fn(&mut Rgb<u8>);

#[test]
fn pictures_of_fair_readings_are_correct() {
    for (seed, reading) in fair_readings().iter().enumerate() {
        let red = simulate(reading.variation, 500 + seed as u64, MILLION, 0.0);
        for emitted in [Some(MILLION), None] {
            let judgment = judge(&red, emitted);
            let p_value = judgment.p_value.expect("it was tested");
            assert!(!judgment.is_incorrect() && p_value > 1e-4, "{}: {judgment:?}", reading.title);
        }
        let fitted = judge(&red, None).emitted.expect("it was fitted");
        assert!((fitted / MILLION as f64 - 1.0).abs() < 0.05, "{}: {fitted}", reading.title);
    }
}

#[test]
fn what_is_expected_is_what_pictures_show() {
    let all = expectations();
    let coverage = vec![1.0; all.view.facets.len()];
    for (emitted, pictures) in [(20_000, 400), (MILLION, 12)] {
        let (view, signature) = (&all.view, &all.signatures.fair[0].signature);
        let cells = view.cells.len();
        let expected = expect(view, signature, emitted as f64, &coverage, &vec![0.0; cells]);
        let everything = expected.grouped(&Groups::whole(cells));
        let totals: Vec<f64> = (0..pictures)
            .map(|seed| {
                let red = simulate(Variation::default(), 900 + seed, emitted, 0.0);
                let inside = |pixel: &usize| red[*pixel] && all.view.patch(*pixel).is_some();
                (0..PIXELS).filter(inside).count() as f64
            })
            .collect();
        let count = pictures as f64;
        let mean = totals.iter().sum::<f64>() / count;
        let variance =
            totals.iter().map(|total| (total - mean) * (total - mean)).sum::<f64>() / (count - 1.0);
        let [expected_mean, expected_variance] = [everything.mean[0], everything.covariance[0][0]];
        let z = (mean - expected_mean) / (expected_variance / count).sqrt();
        assert!(z.abs() < 4.0, "{emitted}: {mean} where {expected_mean} are expected");
        // A variance of few is itself known to sqrt(2 / count).
        let off = (variance / expected_variance - 1.0) / (2.0 / count).sqrt();
        assert!(off.abs() < 4.0, "{emitted}: {variance} where {expected_variance} is expected");
    }
}

#[test]
fn the_signatures_that_are_kept_are_measured() {
    let all = expectations();
    let kept = &all.signatures.fair[0].signature;
    let again = measure(&fair_readings()[0], &all.view, 2 * MILLION, MAX_PHOTON_BOUNCES);
    assert_eq!(kept.red.len(), all.view.patches.len());
    for facet in 0..all.view.facets.len() {
        let of_facet = |red: &[f64]| -> f64 {
            let patches = all.view.patches.iter().zip(red);
            patches.filter(|(patch, _)| patch.facet_in_sight == facet).map(|(_, red)| red).sum()
        };
        let [kept, again] =
            [of_facet(&kept.red) / kept.emitted, of_facet(&again.red) / again.emitted];
        assert!((again / kept - 1.0).abs() < 0.05, "{facet}: {again} where {kept} is kept");
    }
}

#[test]
fn misreadings_are_incorrect_and_named() {
    for id in ["uniform-hemisphere", "mean-roulette", "no-offset", "direct-stored"] {
        let hypothesis = misread(id, 3).expect("it is known");
        let red = simulate(hypothesis.variation, 33, MILLION, 0.0);
        let judgment = judge(&red, Some(MILLION));
        assert!(judgment.is_incorrect(), "{id}: {judgment:?}");
        assert_eq!(named(&judgment), Some(id), "{judgment:?}");
    }
    let hypothesis = misread("no-absolute-value", 0).expect("it is known");
    let judgment = judge(&simulate(hypothesis.variation, 34, MILLION, 0.0), None);
    assert!(judgment.is_incorrect(), "{judgment:?}");
    assert_eq!(named(&judgment), Some("no-absolute-value"), "{judgment:?}");
}

#[test]
fn another_mistake_is_incorrect_and_is_not_named() {
    // Dots on one half of the picture only.
    let mut red = simulate(Variation::default(), 35, MILLION, 0.0);
    red.iter_mut().enumerate().filter(|(pixel, _)| pixel % 640 < 320).for_each(|(_, r)| *r = false);
    for emitted in [Some(MILLION), None] {
        let judgment = judge(&red, emitted);
        assert!(judgment.is_incorrect(), "{judgment:?}");
        assert_eq!(named(&judgment), None, "{judgment:?}");
    }
}

#[test]
fn a_picture_that_is_red_all_over_is_the_nan_of_the_frame() {
    let red: Vec<bool> = (0..PIXELS).map(|at| expectations().view.shows_surface(at)).collect();
    let judgment = judge(&red, None);
    assert!(judgment.is_incorrect());
    assert_eq!(named(&judgment), Some("nan-frame"));
    // With four billion photons a right picture is red all over, too.
    let judgment = judge(&red, Some(4_000_000_000));
    assert!(!judgment.is_incorrect(), "{judgment:?}");

    let folder = folder();
    let picture = folder.path().join("red.png");
    paint(&expectations().view, &red, framework_dot).save(&picture).expect("it can be written");
    let grade = grade(&picture, "");
    assert_eq!((&grade["verdict"], &grade["score"]), (&"incorrect".into(), &2.0.into()));
    assert_eq!(grade["misreading"], "nan-frame");
}

#[test]
fn a_page_without_the_scene_is_not_red_all_over() {
    // Light over all, red among it; the background of the scene is black.
    for color in [[255, 255, 255], [255, 255, 0], [255, 192, 203]] {
        let page = RgbImage::from_pixel(640, 480, Rgb(color));
        let reason = dots_of(&page).expect_err("it is not the scene");
        assert!(reason.contains("background"), "{reason}");
    }
    // Red all over, the background too: the frame's NaN in a program that asks no surface.
    let red = RgbImage::from_pixel(640, 480, Rgb([255, 0, 0]));
    assert!(dots_of(&red).is_ok());
}

#[test]
fn positions_off_the_surface_are_fair_until_no_dot_is_left() {
    // Of few photons few pixels are red, and hardly a group of cells is left to be told from
    // others.
    for seed in [70_085, 70_115, 70_328] {
        let red = simulate(Variation::default(), seed, 30_000, 2.9e-3);
        let judgment = judge(&red, Some(30_000));
        assert!(!judgment.is_incorrect(), "{seed}: {judgment:?}");
    }
    let fair = fair_readings();
    let of_literal = |standoff| (fair[1].variation, standoff, true);
    for (variation, standoff, has_dots) in [
        (fair[0].variation, 1.0e-3, true),
        (fair[0].variation, 2.6e-3, true),
        of_literal(2.45e-3),
        (fair[0].variation, 3.3e-3, true),
        (fair[0].variation, 5.0e-3, false),
    ] {
        let red = simulate(variation, 36, MILLION, standoff);
        for emitted in [Some(MILLION), None] {
            let judgment = judge(&red, emitted);
            assert_eq!(judgment.has_dots, has_dots, "{standoff}: {judgment:?}");
            assert!(!judgment.is_incorrect(), "{standoff}: {judgment:?}");
        }
    }
}

#[test]
fn positions_off_the_surface_excuse_no_misreading() {
    let hypothesis = misread("uniform-hemisphere", 3).expect("it is known");
    for standoff in [2.0e-3, 2.6e-3] {
        let red = simulate(hypothesis.variation, 39, 100_000, standoff);
        for emitted in [Some(100_000), None] {
            let judgment = judge(&red, emitted);
            assert!(judgment.is_incorrect(), "{standoff}: {judgment:?}");
            let mut checks = judgment.findings.iter().map(|finding| finding.check);
            assert!(!checks.any(|check| check == "off the surfaces"), "{standoff}: {judgment:?}");
        }
    }
}

#[test]
fn dots_of_other_kinds_are_found_and_remarked() {
    let view = &expectations().view;
    let red = simulate(Variation::default(), 37, MILLION, 0.0);
    let kinds: [(&str, Change); 5] = [
        ("", framework_dot),
        ("green", |pixel| pixel.0[1] = 255),
        ("add some red", |pixel| pixel.0[0] = pixel.0[0].saturating_add(64)),
        ("(0, 255, 255)", |pixel| *pixel = Rgb([0, 255, 255])),
        ("(255, 0, 0)", |pixel| *pixel = Rgb([255, 0, 0])),
    ];
    for (words, dot) in kinds {
        let dots = dots_of(&paint(view, &red, dot)).expect("dots are found");
        assert!(dots.red == red, "{words}: other pixels");
        let remarks: Vec<_> = dots.remarks.iter().map(|finding| &finding.found).collect();
        match remarks.as_slice() {
            [] => assert_eq!(words, ""),
            [remark] => assert!(!words.is_empty() && remark.contains(words), "{remark}"),
            _ => panic!("{remarks:?}"),
        }
        assert!(dots.remarks.iter().all(|finding| !finding.is_fault()));
    }
}

#[test]
fn other_direct_light_is_seen_through() {
    let view = &expectations().view;
    let red = simulate(Variation::default(), 38, MILLION, 0.0);
    let plain = paint(view, &red, framework_dot);

    let mut rounded = plain.clone();
    for (at, pixel) in rounded.pixels_mut().enumerate() {
        pixel.0[at % 3] = pixel.0[at % 3].saturating_add(u8::from(pixel.0[at % 3] > 0));
    }
    let dots = dots_of(&rounded).expect("it is the view");
    assert!(dots.red == red && dots.remarks.is_empty(), "{:?}", dots.remarks);

    // Also where there are few dots, or none.
    for emitted in [MILLION, 200_000, 10_000, 0] {
        let red = simulate(Variation::default(), 38, emitted, 0.0);
        let plain = paint(view, &red, framework_dot);
        for gamma in [1.4, 1.8, 2.2, 2.6, 1.0 / 1.4, 1.0 / 2.2] {
            let mut bright = plain.clone();
            for channel in bright.pixels_mut().flat_map(|pixel| &mut pixel.0) {
                *channel = (255.0 * (f64::from(*channel) / 255.0).powf(1.0 / gamma)).round() as u8;
            }
            let dots = dots_of(&bright).expect("it is the view, with a gamma");
            let others = dots.red.iter().zip(&red).filter(|(a, b)| a != b).count();
            assert!(others <= 3, "{emitted} {gamma}: {others} others");
            assert!(dots.remarks[0].found.contains("gamma"), "{:?}", dots.remarks);
        }
    }

    let scale = |factor: f64| {
        let mut scaled = plain.clone();
        for channel in scaled.pixels_mut().flat_map(|pixel| &mut pixel.0) {
            *channel = (factor * f64::from(*channel)).round().min(255.0) as u8;
        }
        scaled
    };
    // Where direct light is full of red, no dot can be seen.
    for factor in [1.5, 1.7, 2.0, 3.0] {
        let remarks = dots_of(&scale(factor)).map(|dots| dots.remarks);
        let reason = remarks.expect_err("dots are lost");
        assert!(reason.contains("so bright"), "{factor}: {reason}");
    }
    for factor in [0.8, 0.9, 1.1, 1.25] {
        let dots = dots_of(&scale(factor)).expect("it is the view, darker or brighter");
        assert!(dots.red == red, "{factor}: other pixels");
        assert!(dots.remarks[0].found.contains("brightness"), "{:?}", dots.remarks);
    }
    // Red alone made brighter is no dot all over.
    let mut warm = plain.clone();
    warm.pixels_mut().for_each(|pixel| pixel.0[0] = pixel.0[0].saturating_add(pixel.0[0] / 4));
    assert!(dots_of(&warm).is_err());

    let mut dark = RgbImage::new(640, 480);
    dark.pixels_mut().zip(&red).filter(|(_, red)| **red).for_each(|(p, _)| *p = Rgb([255, 0, 0]));
    let dots = dots_of(&dark).expect("dots over nothing");
    assert!(dots.red == red && dots.remarks[0].check == "direct light", "{:?}", dots.remarks);
}

#[test]
fn dots_that_are_too_large_are_told_and_not_judged() {
    let view = &expectations().view;
    for (seed, emitted) in [(42, 20_000), (43, MILLION), (44, 5 * MILLION)] {
        let red = simulate(Variation::default(), seed, emitted, 0.0);
        assert!(!DotSize::new(&red, view).expect("there are enough").is_too_large(), "{emitted}");
        for more in [1, 2] {
            let large = enlarged(&red, more);
            let size = DotSize::new(&large, view).expect("there are enough");
            assert!(size.is_too_large(), "{emitted}: {more}");
            // Those that were two wide.
            assert_eq!(size.extent(), [2 + more; 2], "{emitted}");
            assert!(size.reason().contains("too large, up to"), "{emitted}: {}", size.reason());
        }
    }
    // With half as large a radius again: eight cubes, each half a radius off, are one of that size.
    let half = 0.5 * PHOTON_DOT_RADIUS;
    let mut larger = vec![false; PIXELS];
    for record in Simulation::new(Variation::default(), 50, MILLION, 1000).trace(0..MILLION) {
        for corner in 0..8 {
            let side = |axis: u32| if corner >> axis & 1 == 1 { half } else { -half };
            let off = Vec3::new(side(0), side(1), side(2));
            view.for_each_pixel_of(record.position + off, |pixel| larger[pixel] = true);
        }
    }
    assert!(DotSize::new(&larger, view).expect("there are enough").is_too_large());
    let few = simulate(Variation::default(), 46, 2000, 0.0);
    assert!(few.iter().any(|is_red| *is_red) && DotSize::new(&few, view).is_none());
    let hypothesis = misread("direct-stored", 0).expect("it is known");
    let red = simulate(hypothesis.variation, 45, MILLION, 0.0);
    assert!(!DotSize::new(&red, view).expect("there are enough").is_too_large());

    let folder = folder();
    let picture = folder.path().join("large.png");
    let large = enlarged(&simulate(Variation::default(), 47, MILLION, 0.0), 2);
    paint(view, &large, framework_dot).save(&picture).expect("it can be written");
    let grade = grade(&picture, "");
    assert_eq!(grade["verdict"], "unreadable", "{grade:#}");
    assert!(found(&grade).contains("too large, up to 4 x 4 pixels"), "{}", found(&grade));
}

/// The dots `red`, with `more` pixels to the right and downwards.
fn enlarged(red: &[bool], more: usize) -> Vec<bool> {
    let mut large = red.to_vec();
    for (at, _) in red.iter().enumerate().filter(|(_, is_red)| **is_red) {
        for (right, down) in (0..=more).flat_map(|right| (0..=more).map(move |down| (right, down)))
        {
            large[(at + right + 640 * down).min(PIXELS - 1)] = true;
        }
    }
    large
}

#[test]
fn two_misreadings_at_once_are_not_one() {
    let roulette = |roulette| Variation { roulette, ..Variation::default() };
    let cases = [
        Variation { hemisphere: Hemisphere::NoSquareRoot, ..roulette(Roulette::Mean) },
        Variation { hemisphere: Hemisphere::Uniform, ..roulette(Roulette::Mean) },
        Variation { emission: Emission::Cube, ..roulette(Roulette::Red) },
    ];
    for (at, variation) in cases.into_iter().enumerate() {
        let red = simulate(variation, 90, MILLION, 0.0);
        for emitted in [Some(MILLION), None] {
            let judgment = judge(&red, emitted);
            assert!(judgment.is_incorrect(), "{at}: {judgment:?}");
            assert_eq!(named(&judgment), None, "{at}: {judgment:?}");
        }
    }
    // Where no other pair does as well, both are told.
    let both = Variation { hemisphere: Hemisphere::NoSquareRoot, ..roulette(Roulette::Mean) };
    let judgment = judge(&simulate(both, 90, MILLION, 0.0), Some(MILLION));
    let advice =
        judgment.findings.iter().find(|finding| finding.is_fault()).unwrap().advice.clone();
    assert!(advice.contains("r is u1") && advice.contains("the mean of"), "{advice}");
}

#[test]
fn what_hides_behind_a_misreading_shows_in_the_number() {
    let of_number = |emitted| {
        let variation = Variation { roulette: Roulette::Red, ..Variation::default() };
        let judgment = judge(&simulate(variation, 91, emitted, 0.0), None);
        assert_eq!(named(&judgment), Some("red-roulette"), "{judgment:?}");
        let finding = judgment.findings.iter().find(|finding| finding.check == "photons emitted");
        finding.expect("the number is told").passed
    };
    assert!(of_number(MILLION));
    assert!(!of_number(MILLION * 7 / 10));
}

#[test]
fn a_camera_half_a_pixel_off_is_remarked() {
    let all = expectations();
    let view = all.shifted();
    let red = simulate_dots(Variation::default(), 39, MILLION, 0.0, &all.places, view);
    let dots = dots_of(&paint(view, &red, framework_dot)).expect("dots are found");
    assert!(dots.is_shifted && dots.red == red);
    assert_eq!(dots.remarks[0].check, "camera");
    let judgment = judge_dots(&dots.red, view, Some(MILLION as f64), all);
    assert!(!judgment.is_incorrect(), "{judgment:?}");
}

#[test]
fn what_blurs_dots_is_reported_and_not_graded() {
    let view = &expectations().view;
    let red = simulate(Variation::default(), 40, MILLION, 0.0);
    let plain = paint(view, &red, framework_dot);
    let half = imageops::resize(&plain, 320, 240, imageops::FilterType::Triangle);
    let folder = folder();
    let small = folder.path().join("half.png");
    half.save(&small).expect("it can be written");
    let graded = grade(&small, "");
    assert_eq!(graded["verdict"], "unreadable", "{graded:#}");
    let reason = found(&graded);
    assert!(reason.contains("320 x 240") && reason.contains("640 x 480"), "{reason}");
    let resized = imageops::resize(&half, 640, 480, imageops::FilterType::Triangle);
    let reason = dots_of(&resized).expect_err("its dots cannot be told");
    assert!(reason.contains("JPEG") && reason.contains("resizing"), "{reason}");
    let reason = dots_of(&imageops::flip_horizontal(&plain)).expect_err("it is another view");
    assert!(reason.contains("the handout's view"), "{reason}");
    let noise = RgbImage::from_fn(640, 480, |x, y| Rgb([x as u8, y as u8, (x * y) as u8]));
    let reason = dots_of(&noise).expect_err("it is another view");
    assert!(reason.contains("does not show the handout's view"), "{reason}");
}

#[test]
fn red_that_is_no_dot_is_no_dot() {
    let all = expectations();
    let judgment = judge(&dots_of(&all.view.direct).expect("it is the view").red, None);
    assert!(!judgment.has_dots);
    // Red only where the picture shows nothing.
    let mut background = all.view.direct.clone();
    for (at, pixel) in background.pixels_mut().enumerate() {
        if !all.view.shows_surface(at) {
            *pixel = Rgb([255, 0, 0]);
        }
    }
    assert!(!judge(&dots_of(&background).expect("it is the view").red, None).has_dots);
}

#[test]
fn a_picture_without_dots_is_told_so_under_a_gamma_too() {
    let folder = folder();
    for gamma in [1.4, 2.2, 2.6] {
        let mut bright = expectations().view.direct.clone();
        for channel in bright.pixels_mut().flat_map(|pixel| &mut pixel.0) {
            *channel = (255.0 * (f64::from(*channel) / 255.0).powf(1.0 / gamma)).round() as u8;
        }
        let picture = folder.path().join("none.png");
        bright.save(&picture).expect("it can be written");
        let graded = grade(&picture, "");
        assert_eq!(graded["verdict"], "no-dots", "{graded:#}");
        let remarks = graded["findings"].as_array().expect("there are some").iter();
        let mut told = remarks.filter_map(|finding| finding["found"].as_str());
        assert!(told.any(|found| found.contains("gamma")), "{graded:#}");
    }
}

#[test]
fn the_command_line_grades_pictures() {
    let folder = folder();
    run_line("render --quiet --seed 5 --out {}", &[folder.path()]).success();
    let picture = folder.path().join("assignment8.png");
    for more in ["", " --emitted 1000000"] {
        let grade = grade(&picture, more);
        assert_eq!(grade["verdict"], "correct", "{grade:#}");
        assert_eq!(grade["score"], 4.0);
        assert!(grade["stored"].is_null());
    }
    // As for a list, the number counts when it is given.
    let other = grade(&picture, " --emitted 800000");
    assert_eq!(other["verdict"], "incorrect", "{other:#}");
    assert_eq!(other["score"], 3.0);

    let none = folder.path().join("none.png");
    expectations().view.direct.save(&none).expect("it can be written");
    let grade = grade(&none, "");
    assert_eq!((&grade["verdict"], &grade["score"]), (&"no-dots".into(), &1.0.into()));
}

#[test]
fn dots_straight_from_the_light_are_not_plausible() {
    let folder = folder();
    let picture = folder.path().join("light.png");
    let hypothesis = misread("direct-stored", 0).expect("it is known");
    let red = simulate(hypothesis.variation, 48, MILLION, 0.0);
    let painted = paint(&expectations().view, &red, framework_dot);
    painted.save(&picture).expect("it can be written");
    let grade = grade(&picture, " --emitted 1000000");
    assert_eq!(grade["misreading"], "direct-stored", "{grade:#}");
    assert_eq!((&grade["verdict"], &grade["score"]), (&"incorrect".into(), &2.0.into()));
}

#[test]
fn a_list_and_a_picture_of_one_student() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = crate::support::reference_csv(folder.path(), 200_000);
    let text = fs::read_to_string(&list).expect("it is there");
    let all = expectations();
    let checks = |grade: &Value| -> Vec<String> {
        let findings = grade["findings"].as_array().expect("there are some");
        findings.iter().map(|f| f["check"].as_str().expect("it has a name").to_owned()).collect()
    };
    let seed = photon_mapping::assignment8::SEED;
    // A picture of another camera, and one of a run that emitted more of the same photons.
    for (name, emitted, view, odd) in [
        ("camera", 200_000, all.shifted(), "camera"),
        ("longer", MILLION, &all.view, "list and picture"),
    ] {
        let student = at(name);
        fs::create_dir(&student).expect("it can be made");
        fs::write(student.join("photons.csv"), &text).expect("it can be written");
        let red = simulate_dots(Variation::default(), seed, emitted, 0.0, &all.places, view);
        let picture = paint(view, &red, framework_dot);
        picture.save(student.join("picture.png")).expect("it can be written");
        let graded = grade(&student, "");
        assert_eq!(graded["verdict"], "correct", "{graded:#}");
        let remarks = graded["findings"].as_array().expect("there are some").iter();
        let remarks = remarks.filter(|finding| finding["passed"] == false);
        assert_eq!(remarks.map(|it| &it["check"]).collect::<Vec<_>>(), [odd], "{graded:#}");
    }
    // A picture that is wrong costs nothing beside a list that is right.
    let misread = misread("uniform-hemisphere", 3).expect("it is known");
    let student = at("misread");
    fs::create_dir(&student).expect("it can be made");
    fs::write(student.join("photons.csv"), &text).expect("it can be written");
    let picture = paint(&all.view, &simulate(misread.variation, 49, MILLION, 0.0), framework_dot);
    picture.save(student.join("picture.png")).expect("it can be written");
    let graded = grade(&student, "");
    assert_eq!((&graded["verdict"], &graded["score"]), (&"correct".into(), &4.0.into()));
    let odd = graded["findings"].as_array().expect("there are some").iter();
    let odd: Vec<_> = odd.filter(|finding| finding["passed"] == false).collect();
    assert!(odd.iter().any(|it| it["check"] == "density of dots"), "{odd:#?}");
    assert!(odd.iter().all(|it| it["weight"] == "remark"), "{odd:#?}");
    for (seed, is_together) in [(seed, true), (seed + 1, false)] {
        let student = at(&format!("student-{seed}"));
        fs::create_dir(&student).expect("it can be made");
        fs::write(student.join("photons.csv"), &text).expect("it can be written");
        let red = simulate(Variation::default(), seed, 200_000, 0.0);
        let picture = paint(&all.view, &red, framework_dot);
        picture.save(student.join("picture.png")).expect("it can be written");
        let graded = grade(&student, " --emitted 200000");
        assert_eq!(graded["verdict"], "correct", "{graded:#}");
        assert_eq!(!checks(&graded).contains(&"list and picture".to_owned()), is_together);
        // A list that cannot be read leaves the picture.
        fs::write(student.join("photons.csv"), "x;why\n1;2\n").expect("it can be written");
        let graded = grade(&student, " --emitted 200000");
        assert_eq!((&graded["verdict"], &graded["score"]), (&"correct".into(), &4.0.into()));
        assert!(checks(&graded).contains(&"photon list".to_owned()), "{graded:#}");
        fs::write(student.join("picture.png"), b"\xff\xd8\xff").expect("it can be written");
        let graded = grade(&student, "");
        assert_eq!(graded["verdict"], "unreadable", "{graded:#}");
        assert_eq!(checks(&graded), ["readable", "photon list"]);
    }
}

#[test]
fn a_picture_is_known_by_its_bytes() {
    let folder = folder();
    let red = simulate(Variation::default(), 41, MILLION, 0.0);
    let picture = paint(&expectations().view, &red, framework_dot);
    let png = folder.path().join("picture.csv");
    picture.save_with_format(&png, image::ImageFormat::Png).expect("it can be written");
    assert_eq!(grade(&png, "")["verdict"], "correct");
    for name in ["picture.png", "picture.jpg"] {
        let jpeg = folder.path().join(name);
        fs::write(&jpeg, b"\xff\xd8\xff\xe0\0\x10JFIF and more").expect("it can be written");
        let grade = grade(&jpeg, "");
        assert_eq!(grade["verdict"], "unreadable");
        assert!(found(&grade).contains("JPEG"), "{grade}");
    }
    // Other ways to write the same colors are read.
    for (name, same) in [
        ("deep.png", DynamicImage::ImageRgb16(DynamicImage::from(picture.clone()).to_rgb16())),
        ("alpha.png", DynamicImage::ImageRgba8(DynamicImage::from(picture.clone()).to_rgba8())),
    ] {
        let path = folder.path().join(name);
        same.save(&path).expect("it can be written");
        assert_eq!(grade(&path, "")["verdict"], "correct", "{name}");
    }
}

#[test]
fn hostile_pictures_are_unreadable_soon() {
    let folder = folder();
    let mut good = Vec::new();
    let mut bytes = std::io::Cursor::new(&mut good);
    expectations()
        .view
        .direct
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("it is written");
    let header = |width: u32, height: u32, depth: u8, color: u8| {
        let mut header = [width.to_be_bytes(), height.to_be_bytes()].concat();
        header.extend([depth, color, 0, 0, 0]);
        header
    };
    let png = |chunks: &[(&[u8; 4], &[u8])]| {
        let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
        chunks.iter().for_each(|(name, data)| png.extend(chunk(name, data)));
        png
    };
    // A picture of very many rows, which are all alike and take little room, in one of few.
    let tall = RgbImage::new(640, 20_000);
    let mut bomb = Vec::new();
    tall.write_to(&mut std::io::Cursor::new(&mut bomb), image::ImageFormat::Png).expect("written");
    let bomb = [&good[..33], &bomb[33..]].concat();
    let mut transparent = DynamicImage::from(expectations().view.direct.clone()).to_rgba8();
    transparent.pixels_mut().take(9).for_each(|pixel| pixel.0[3] = 0);
    let encode = |picture: DynamicImage| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        picture.write_to(&mut bytes, image::ImageFormat::Png).expect("it is written");
        bytes.into_inner()
    };
    let gray = DynamicImage::from(expectations().view.direct.clone()).to_luma8();
    let control = [0_u8, 0, 0, 2, 0, 0, 0, 0];
    let animated = [&good[..33], &chunk(b"acTL", &control), &good[33..]].concat();
    let huge = png(&[(b"IHDR", &header(100_000, 100_000, 8, 2)), (b"IDAT", &[0; 99])]);
    let indexed = png(&[(b"IHDR", &header(640, 480, 8, 3)), (b"IDAT", b"no zlib"), (b"IEND", b"")]);
    let large = [good.as_slice(), &vec![0; 5 << 20]].concat();
    let cases: [(&str, Vec<u8>, &str); 10] = [
        ("huge", huge, "100000 x 100000"),
        ("bomb", bomb, ""),
        ("cut", good[..good.len() / 2].to_vec(), "broken"),
        ("start", good[..12].to_vec(), "ends too early"),
        ("animated", animated, "animated"),
        ("gray", encode(gray.into()), "gray"),
        ("transparent", encode(transparent.into()), "transparent"),
        ("indexed", indexed, "broken"),
        ("large", large, "more than 4 MB"),
        ("gif", b"GIF89a\x80\x02\xe0\x01\xf7\0\0\0\0\0".to_vec(), "GIF"),
    ];
    for (name, bytes, reason) in cases {
        let path = folder.path().join(format!("{name}.png"));
        fs::write(&path, bytes).expect("it can be written");
        let start = Instant::now();
        let grade = grade(&path, "");
        assert!(start.elapsed() < Duration::from_secs(20), "{name}");
        if name == "bomb" {
            // What there is too much is not looked at.
            assert_ne!(grade["verdict"], "correct", "{grade:#}");
            continue;
        }
        assert_eq!(grade["verdict"], "unreadable", "{name}: {grade:#}");
        assert_eq!(grade["score"], 0.0);
        assert!(found(&grade).contains(reason), "{name}: {grade:#}");
    }
    let reason = read_picture(folder.path()).expect_err("a folder is no picture");
    assert!(reason.contains("regular file"), "{reason}");
}

/// A chunk of a PNG file: its length, name, data, and the CRC-32 of the last two.
fn chunk(name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let named = [name.as_slice(), data].concat();
    let mut crc = u32::MAX;
    for byte in &named {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
        }
    }
    [&(data.len() as u32).to_be_bytes(), named.as_slice(), &(!crc).to_be_bytes()].concat()
}

#[test]
fn what_is_found_without_the_number_is_found_with_it() {
    let small = 200_000;
    let mut found = 0;
    for id in ["cube-directions", "no-square-root", "uniform-hemisphere", "start-not-moved"] {
        for seed in 70..73 {
            let way = misread(id, seed).expect("it is known");
            let red = simulate(way.variation, seed, small, 0.0);
            let [alone, with_number] = [None, Some(small)].map(|it| judge(&red, it).is_incorrect());
            assert!(with_number || !alone, "{id} {seed}");
            found += usize::from(with_number);
        }
    }
    assert!(found >= 10, "{found} of 12");
}
