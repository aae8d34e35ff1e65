//! Progress bars.

use std::io::{self, IsTerminal};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A sign on a terminal that something goes on which has no parts to count, with the time it takes;
/// nothing elsewhere, nor when `quiet`.
pub fn waiting(quiet: bool, what: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {msg} {elapsed}");
    let style = style.expect("the template is well formed");
    let waiting = bar(quiet, what, 0).with_style(style);
    waiting.enable_steady_tick(Duration::from_millis(100));
    waiting
}

/// A bar for `length` of `what` on a terminal; nothing elsewhere, nor when `quiet`.
pub fn bar(quiet: bool, what: &'static str, length: u64) -> ProgressBar {
    let hidden = quiet || !io::stderr().is_terminal();
    let target = if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let style = "{msg:8} {wide_bar} {human_pos}/{human_len} {eta}";
    let style = ProgressStyle::with_template(style).expect("the template is well formed");
    ProgressBar::with_draw_target(Some(length), target).with_style(style).with_message(what)
}
