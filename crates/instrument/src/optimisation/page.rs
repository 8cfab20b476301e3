//! The text pages of a recorded optimisation.

use posegraph::{Fill, Report};

use super::draw::{FAR_OFF, FITS};

/// What the recording shows, how to step, and what the colours mean.
pub(super) fn about(name: &str, about: &str, fill: Option<&Fill>) -> String {
    let mut page = format!("# {name}\n\n{}\n", about.trim());
    page.push_str(
        "\n## Step through it\n\n\
         Ctrl + Right and Ctrl + Left go one iteration on and back, Space plays. Iteration 0 is the \
         start. Drag to turn or move the view, scroll to zoom, double-click to see everything.\n\n\
         ## Colours\n\n| edge | means |\n|---|---|\n",
    );
    page.push_str(&format!(
        "| grey | fits: residual up to {FITS} standard deviations |\n\
         | yellow | strains |\n\
         | red | far off: {FAR_OFF} standard deviations or more |\n\
         | magenta | rejected: weighs less than half |\n\n\
         The residual is the square root of e' I e per degree of freedom, with the information of \
         the file: where that is too confident, everything strains. Thick lines lead from one pose \
         to the next, thin ones close loops.\n"
    ));
    if let Some(fill) = fill {
        page.push_str(&format!(
            "\n## Linear systems\n\n{} unknowns. {} numbers in the lower triangle of the matrix, {} \
             in its factor: the ordering fills in {:.2} times as many.\n",
            fill.unknowns,
            fill.matrix,
            fill.factor,
            fill.factor as f64 / fill.matrix.max(1) as f64
        ));
    }
    page
}

/// How it ended, and each iteration in a table.
pub(super) fn result(report: &Report, rejected: &[String]) -> String {
    let mut page = format!(
        "# Result\n\n- ended: {} ({:?})\n- chi2: {:.9e} at the start, {:.9e} at the end\n- cost: \
         {:.9e}\n- components: {}, held poses: {}\n",
        report.termination.name(),
        report.termination,
        report.chi2_initial,
        report.chi2,
        report.cost,
        report.components,
        report.held.len(),
    );
    if report.information.projected > 0 {
        page.push_str(&format!(
            "- information matrices with negative eigenvalues, which were set to 0: {} (the \
             smallest was {:.3e})\n",
            report.information.projected, report.information.smallest_eigenvalue
        ));
    }
    const SHOWN: usize = 50;
    if !rejected.is_empty() {
        let more = if rejected.len() > SHOWN { ", ..." } else { "" };
        let first = rejected[..rejected.len().min(SHOWN)].join(", ");
        page.push_str(&format!("- rejected edges: {} ({first}{more})\n", rejected.len()));
    }
    page.push_str(
        "\n| iteration | cost | damping | step | gain ratio | accepted |\n|--:|--:|--:|--:|--:|---|\n",
    );
    for iteration in &report.iterations {
        page.push_str(&format!(
            "| {} | {:.6e} | {:.2e} | {:.2e} | {:.3} | {} |\n",
            iteration.index,
            iteration.cost,
            iteration.damping,
            iteration.step_norm,
            iteration.gain_ratio,
            if iteration.accepted { "yes" } else { "no" }
        ));
    }
    page
}
