//! The text page of a replay, and events in a line.

use std::fmt;

use places::{Candidate, Matched};

use super::ReplayOptions;

/// What the recording shows, how to step, and what the colours mean.
pub(super) fn about(options: &ReplayOptions) -> String {
    let mut page = format!("# {}\n\n{}\n", options.name, options.about.trim());
    page.push_str(
        "\n## Step through it\n\n\
         Ctrl + Right and Ctrl + Left go one keyframe on and back, Space plays. The time panel below \
         switches the timeline: `step` (keyframes), `distance_mm` (driven), `sim_time` (since the log began), \
         and `event`, which counts everything that place recognition tried. Double-click a view to reset its \
         zoom, drag to pan, Ctrl + scroll to zoom.\n\
         \n## What is shown\n\n\
         - **by odometry only**: the scans where the log's odometry puts them.\n\
         - **optimised**: the same once the pose graph is optimised, every so many keyframes and at the end. \
         Grey walls were added since by steps alone. Orange is frontier that the relative map has left: where \
         the person should have gone. Pink lines are recognised places.\n\
         - **around the robot**: keyframes within the scope, each placed along its shortest path through the \
         graph; nothing is optimised. Thin lines are those paths.\n\
         - **before** and **after**: the last match of scans, in the frame of the known keyframe. Grey: what is \
         known there. Blue: the current scan where the graph expected it. Green: where the match has it, believed; \
         yellow: it waits for others that agree; red: refused. The ellipse is three standard deviations.\n\
         - Below, behind tabs: what each map believes.\n\
         \n## Colours of the maps\n\n| colour | means |\n|---|---|\n\
         | orange, thick | frontier: nobody knows what lies behind |\n\
         | pale yellow | frontier too short to count |\n\
         | dark red | obstacle |\n\
         | green, thin | was frontier; lies inside another volume: free |\n\
         | grey, thin | was frontier; runs along a wall that another volume saw |\n\
         | pale blue cell | a grid believes it free; stronger blue: since this keyframe |\n",
    );
    page
}

/// A match in a line.
pub(super) struct Line<'a>(pub &'a Matched<'a>);

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Matched { known, current, residual_m, agreement, verdict, .. } = self.0;
        let moved = self.0.before.inverse_mul(&self.0.after);
        write!(
            f,
            "{} against {}: {}; moved {:.2} m, {:.1} deg, residual {:.3} m, {:.0} % explained, {:.0} % \
             contradicted",
            current,
            known,
            verdict.name(),
            moved.distance(),
            moved.angle().to_degrees(),
            residual_m,
            100.0 * agreement.overlap,
            100.0 * agreement.contradiction
        )
    }
}

/// Candidates in a line.
pub(super) struct Ranked<'a>(pub &'a [Candidate]);

impl fmt::Display for Ranked<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} candidates", self.0.len())?;
        for (i, candidate) in self.0.iter().enumerate() {
            let sign = if i == 0 { ":" } else { "," };
            let seen = &candidate.seen;
            let (keyframe, distance_m) = (seen.keyframe, seen.root_from_keyframe.distance());
            let sigma_m = seen.sigma_m();
            let cost = candidate.cost;
            write!(f, "{sign} {keyframe} at {distance_m:.1} +- {sigma_m:.2} m, cost {cost:.2}")?;
        }
        Ok(())
    }
}
