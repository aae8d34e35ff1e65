//! Which pixels of a picture have a dot? Those that differ from the direct light in the way of
//! dots.

use image::RgbImage;

use super::reading::WANTED;
use super::view::{PIXELS, View};
use crate::limits::dots::{
    DARK, FEW_ASTRAY, FEWEST_FULL, LEAST_RAISE, MOST_ASTRAY, MOST_BLIND, MOST_LIT_BACKGROUND,
    ROUNDING, ROUNDING_OF_CURVE, SAME_VIEW,
};
use crate::verdict::Finding;

/// The dots of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundDots {
    /// By pixel: whether it has one.
    pub red: Vec<bool>,
    /// Whether its rays go through the middles of pixels, half a pixel off the framework's.
    pub is_shifted: bool,
    /// What is odd about the picture, and costs nothing.
    pub remarks: Vec<Finding>,
}

/// What kind of dots a picture has.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Style {
    /// These channels are raised.
    Raised([bool; 3]),
    /// The color is replaced by this one.
    Replaced([u8; 3]),
}

/// One way to take a picture apart.
struct Attempt {
    red: Vec<bool>,
    astray: usize,
    /// How many pixels of surfaces are full of red without a dot, so that none could show there.
    blind: usize,
    remark: Option<(&'static str, String)>,
}

/// The dots of `picture`, which has the size of the view. `views` gives the framework's view and,
/// if it is asked for, the one that is shifted by half a pixel.
///
/// # Errors
/// The reason, in words, if it is not the handout's view, or cannot be told apart into direct light
/// and dots.
pub fn find_dots<'a>(
    picture: &RgbImage,
    view: &'a View,
    shifted: impl FnOnce() -> &'a View,
) -> Result<FoundDots, String> {
    let pixels: &[[u8; 3]] = picture.as_raw().as_chunks().0;
    let surface = (0..PIXELS).filter(|pixel| view.shows_surface(*pixel)).count() as f64;
    let is_few = |attempt: &Attempt, part: f64| attempt.astray as f64 <= part * surface;
    let plain = take_apart(pixels, view);
    let mut is_shifted = false;
    let mut best = plain;
    if !is_few(&best, FEW_ASTRAY) {
        let other = take_apart(pixels, shifted());
        if 2 * other.astray < best.astray {
            best = other;
            is_shifted = true;
        }
    }
    // What seems to be brighter nearly everywhere may be all of the picture.
    let is_nearly_all = 2 * best.red.iter().filter(|is_red| **is_red).count() > surface as usize;
    if is_nearly_all && best.remark.is_some() {
        let curved = with_curve(pixels, view).filter(|curved| is_few(curved, MOST_ASTRAY));
        is_shifted &= curved.is_none();
        best = curved.unwrap_or(best);
    }
    if !is_few(&best, MOST_ASTRAY) {
        best = [without_direct_light(pixels, view), with_curve(pixels, view)]
            .into_iter()
            .flatten()
            .find(|attempt| is_few(attempt, MOST_ASTRAY))
            .ok_or_else(|| reason(pixels, view, best.astray as f64 / surface))?;
        is_shifted = false;
    }
    if best.blind as f64 > MOST_BLIND * surface {
        return Err(format!(
            "it is so bright that {} pixels are full of red without a dot, where none can be seen: \
             {WANTED}",
            best.blind
        ));
    }
    // Only red may show where no surface does: a photon that is near everything is near nothing,
    // too.
    let background = || (0..PIXELS).filter(|pixel| !view.shows_surface(*pixel));
    let is_lit = |pixel: &usize| pixels[*pixel][1..].iter().any(|channel| *channel > DARK);
    if background().filter(is_lit).count() as f64
        > MOST_LIT_BACKGROUND * background().count() as f64
    {
        return Err(format!("its background is not black: {WANTED}"));
    }
    let mut remarks = Vec::new();
    if is_shifted {
        let found = "rays through their middles".to_owned();
        remarks.push(remark("camera", "rays through the upper left corners of pixels", found));
    }
    if let Some((check, found)) = best.remark {
        let expected = if check == "dot color" {
            "dots add (1, 0, 0) to the color"
        } else {
            "the framework's direct light"
        };
        remarks.push(remark(check, expected, found));
    }
    Ok(FoundDots { red: best.red, is_shifted, remarks })
}

fn remark(check: &'static str, expected: &str, found: String) -> Finding {
    let advice = "The dots are judged all the same; leave this to the framework.";
    Finding::new(check, expected, found, advice)
}

/// Takes the picture of the framework apart: direct light, and dots of any one style.
fn take_apart(pixels: &[[u8; 3]], view: &View) -> Attempt {
    let direct: &[[u8; 3]] = view.direct.as_raw().as_chunks().0;
    let differs =
        |at: usize, channel: usize| pixels[at][channel].abs_diff(direct[at][channel]) > ROUNDING;
    let marked: Vec<usize> = (0..PIXELS)
        .filter(|at| view.shows_surface(*at) && (0..3).any(|channel| differs(*at, channel)))
        .collect();
    let raised = |at: usize| {
        std::array::from_fn(|channel| {
            // Dots that add all of a channel cannot add more where there is much of it already.
            let is_full = pixels[at][channel] == 255;
            let raise = pixels[at][channel].saturating_sub(direct[at][channel]);
            raise >= LEAST_RAISE || (is_full && raise > 0)
        })
    };
    let styles = [
        Some(Style::Raised([true, false, false])),
        most_frequent(marked.iter().map(|at| raised(*at))).map(Style::Raised),
        most_frequent(marked.iter().map(|at| pixels[*at])).map(Style::Replaced),
    ];
    let attempts = styles.into_iter().flatten().map(|style| {
        let is_dot = |at: usize| match style {
            Style::Raised(channels) => (0..3).all(|channel| {
                if channels[channel] { raised(at)[channel] } else { !differs(at, channel) }
            }),
            // A dot may happen to have the color of what it lies on.
            Style::Replaced(color) => pixels[at] == color && color.iter().any(|c| *c > DARK),
        };
        let mut red = vec![false; PIXELS];
        let mut astray = 0;
        let mut is_full = true;
        for at in &marked {
            red[*at] = is_dot(*at);
            astray += usize::from(!red[*at]);
            is_full &= !red[*at] || pixels[*at][0] == 255;
            // At a surface's edge the direct light may be another one: what is full of red is a
            // dot.
            if style == Style::Raised([true, false, false]) && pixels[*at][0] == 255 {
                red[*at] = true;
            }
        }
        let remark = match style {
            Style::Raised([true, false, false]) if is_full => None,
            Style::Raised(_) if marked.is_empty() => None,
            Style::Raised(channels) => {
                let names = ["red", "green", "blue"];
                let names = names.iter().zip(channels).filter(|(_, is_raised)| *is_raised);
                let names: Vec<_> = names.map(|(name, _)| *name).collect();
                Some(("dot color", format!("dots that add some {}", names.join(" and "))))
            }
            Style::Replaced([r, g, b]) => {
                Some(("dot color", format!("dots that replace the color by ({r}, {g}, {b})")))
            }
        };
        Attempt { red, astray, blind: 0, remark }
    });
    // The first of those that leave as little: the framework's before others.
    attempts.min_by_key(|attempt| attempt.astray).expect("the framework's style is among them")
}

/// Dots over nothing.
fn without_direct_light(pixels: &[[u8; 3]], view: &View) -> Option<Attempt> {
    let surface = || (0..PIXELS).filter(|at| view.shows_surface(*at));
    let is_dot =
        |at: usize| pixels[at][0] >= 128 && pixels[at][1] <= ROUNDING && pixels[at][2] <= ROUNDING;
    let is_black = |at: usize| pixels[at].iter().all(|channel| *channel <= ROUNDING);
    let red: Vec<bool> = (0..PIXELS).map(|at| view.shows_surface(at) && is_dot(at)).collect();
    let astray = surface().filter(|at| !is_dot(*at) && !is_black(*at)).count();
    let remark = Some(("direct light", "none: all but the dots is black".to_owned()));
    Some(Attempt { red, astray, blind: 0, remark })
}

/// Dots over direct light whose channels all went through one curve, which green and blue tell,
/// since dots leave them as they are.
fn with_curve(pixels: &[[u8; 3]], view: &View) -> Option<Attempt> {
    let direct: &[[u8; 3]] = view.direct.as_raw().as_chunks().0;
    let surface = || (0..PIXELS).filter(|at| view.shows_surface(*at));
    let mut seen: [Vec<Vec<u8>>; 2] = [vec![Vec::new(); 256], vec![Vec::new(); 256]];
    for at in surface() {
        for channel in 0..3 {
            let is_red = usize::from(channel == 0);
            seen[is_red][usize::from(direct[at][channel])].push(pixels[at][channel]);
        }
    }
    let [others, reds] = seen;
    let curve: Vec<Option<u8>> = others
        .into_iter()
        .zip(reds)
        .map(|(mut others, mut reds)| {
            others.sort_unstable();
            reds.sort_unstable();
            // Dots leave green and blue as they are, and make red brighter, of not nearly all
            // pixels.
            others.get(others.len() / 2).or_else(|| reds.get(reds.len() / 5)).copied()
        })
        .collect();
    let known: Vec<u8> = curve.iter().flatten().copied().collect();
    let rises = known.windows(2).all(|pair| pair[0] <= pair[1].saturating_add(ROUNDING));
    let (first, last) = (*known.first()?, *known.last()?);
    // What is dark at first and bright at last.
    if !rises || last.saturating_sub(first) < 64 {
        return None;
    }
    let expected =
        |at: usize, channel: usize| along(&curve, usize::from(direct[at][channel])).unwrap_or(0);
    let is_off = |at: usize, channel: usize| {
        pixels[at][channel].abs_diff(expected(at, channel)) > ROUNDING_OF_CURVE
    };
    // The framework's dots are full of red, which the curve takes to one value: the largest.
    let mut counts = [0; 256];
    surface().for_each(|at| counts[usize::from(pixels[at][0])] += 1);
    let full = counts.iter().rposition(|count| *count >= FEWEST_FULL).unwrap_or(255) as u8;
    let is_blind = |at: &usize| full.saturating_sub(expected(*at, 0)) <= 2 * ROUNDING_OF_CURVE;
    let is_full = |at: &usize| pixels[*at][0].abs_diff(full) <= ROUNDING_OF_CURVE && !is_blind(at);
    let mut red = vec![false; PIXELS];
    surface().filter(is_full).for_each(|at| red[at] = true);
    let is_astray = |at: &usize| is_off(*at, 1) || is_off(*at, 2) || (!red[*at] && is_off(*at, 0));
    let astray = surface().filter(is_astray).count();
    let found = "all colors changed by a curve, such as a gamma or a brightness".to_owned();
    // Without dots, the brightest is direct light.
    let blind = if full == 255 { surface().filter(is_blind).count() } else { 0 };
    Some(Attempt { red, astray, blind, remark: Some(("direct light", found)) })
}

/// What `curve`, which is known at some values only, makes of `value`: between two that are known
/// in proportion, beyond them all as far from the last as before.
fn along(curve: &[Option<u8>], value: usize) -> Option<u8> {
    let known = |at: usize| Some((at as f64, f64::from(curve[at]?)));
    let below = (0..=value).rev().find_map(known);
    let above = (value..curve.len()).find_map(known);
    let value = value as f64;
    let found = match (below, above) {
        (Some(a), Some(b)) if b.0 > a.0 => a.1 + (b.1 - a.1) * (value - a.0) / (b.0 - a.0),
        (Some(only), _) | (None, Some(only)) => only.1 + value - only.0,
        (None, None) => return None,
    };
    Some(found.round().clamp(0.0, 255.0) as u8)
}

/// Why a picture cannot be taken apart.
fn reason(pixels: &[[u8; 3]], view: &View, astray: f64) -> String {
    let direct: &[[u8; 3]] = view.direct.as_raw().as_chunks().0;
    let pairs = || (0..PIXELS).map(|at| (f64::from(pixels[at][1]), f64::from(direct[at][1])));
    let count = PIXELS as f64;
    let mean_x = pairs().map(|pair| pair.0).sum::<f64>() / count;
    let mean_y = pairs().map(|pair| pair.1).sum::<f64>() / count;
    let sum = |product: fn(f64, f64) -> f64| {
        pairs().map(|(x, y)| product(x - mean_x, y - mean_y)).sum::<f64>()
    };
    let spread = (sum(|x, _| x * x) * sum(|_, y| y * y)).sqrt();
    let correlation = if spread > 0.0 { sum(|x, y| x * y) / spread } else { 0.0 };
    if correlation > SAME_VIEW {
        format!(
            "it shows the handout's view, but {:.1} % of its pixels are neither direct light nor a \
             dot, as after JPEG compression, resizing, a change of colors or a screenshot: \
             {WANTED}",
            100.0 * astray
        )
    } else {
        format!("it does not show the handout's view: {WANTED}")
    }
}

fn most_frequent<T: Ord + Copy>(values: impl Iterator<Item = T>) -> Option<T> {
    let mut sorted: Vec<T> = values.collect();
    sorted.sort_unstable();
    let groups = sorted.chunk_by(|a, b| a == b);
    groups.max_by_key(|group| group.len()).map(|group| group[0])
}
