//! A bar for anything over a second.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::out::Out;

const QUIET_FOR: Duration = Duration::from_secs(1);

/// A bar that shows itself after a second, on a terminal.
pub(super) struct Bar {
    bar: Option<ProgressBar>,
    label: String,
    since: Instant,
    drawn: bool,
}

impl Bar {
    /// A bar that is full when the true coverage is 1.
    pub(super) fn new(label: &str, out: &Out) -> Self {
        let bar = out.shows_progress().then(|| {
            let style = ProgressStyle::with_template("{prefix:>10} {bar:30} {percent:>3} % {msg}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            let hidden = ProgressDrawTarget::hidden();
            ProgressBar::with_draw_target(Some(1000), hidden).with_style(style)
        });
        Self { bar, label: label.to_owned(), since: Instant::now(), drawn: false }
    }

    /// Tells how far it got: the share of the place that was seen.
    pub(super) fn update(&mut self, share: f64, message: impl FnOnce() -> String) {
        let Some(bar) = &self.bar else { return };
        if self.since.elapsed() < QUIET_FOR {
            return;
        }
        if !self.drawn {
            bar.set_draw_target(ProgressDrawTarget::stderr());
            bar.set_prefix(self.label.clone());
            self.drawn = true;
        }
        bar.set_position((share * 1000.0) as u64);
        bar.set_message(message());
    }

    /// Takes the bar away.
    pub(super) fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
