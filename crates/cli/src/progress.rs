//! Progress bars.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar for `length` of `what` on a terminal; nothing elsewhere, nor when `quiet`.
pub fn bar(quiet: bool, what: &'static str, length: u64) -> ProgressBar {
    let hidden = quiet || !io::stderr().is_terminal();
    let target = if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let style = "{msg:8} {wide_bar} {human_pos}/{human_len} {eta}";
    let style = ProgressStyle::with_template(style).expect("the template is well formed");
    ProgressBar::with_draw_target(Some(length), target).with_style(style).with_message(what)
}
