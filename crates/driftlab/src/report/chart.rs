//! One plot as SVG text.

use plotters::prelude::*;

use super::legend;

/// Width and height of a plot without its names, pixels.
const SIZE: (u32, u32) = (460, 310);

/// From the left to where the values begin, pixels.
const LEFT: u32 = 72;

/// Height of the title, pixels.
const TITLE: u32 = 32;

/// Colours that most people can tell apart (Okabe and Ito, 2008).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(90, 90, 90),
];

/// A point with an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bar {
    /// Where it stands.
    pub(crate) x: f64,
    /// The value.
    pub(crate) y: f64,
    /// Lower end of the interval.
    pub(crate) low: f64,
    /// Upper end.
    pub(crate) high: f64,
}

/// One method in a plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Series {
    /// Its name in the legend.
    pub(crate) name: String,
    /// Which colour.
    pub(crate) colour: usize,
    /// A line through these.
    pub(crate) line: Vec<(f64, f64)>,
    /// A band: x, lower and upper end.
    pub(crate) band: Vec<(f64, f64, f64)>,
    /// Points with intervals, joined by a thin line.
    pub(crate) bars: Vec<Bar>,
    /// Whether the points are rings.
    pub(crate) hollow: bool,
}

/// A plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Chart {
    /// What is above it.
    pub(crate) title: String,
    /// What runs to the right.
    pub(crate) x_label: String,
    /// What runs up.
    pub(crate) y_label: String,
    /// Names of the places 0, 1, ... to the right, where these are no numbers.
    pub(crate) places: Vec<String>,
    /// The top, where it is given; else the greatest value.
    pub(crate) top: Option<f64>,
    /// What is drawn.
    pub(crate) series: Vec<Series>,
}

impl Chart {
    /// Whether there is anything to see.
    pub(crate) fn is_empty(&self) -> bool {
        self.series.iter().all(|one| one.line.is_empty() && one.bars.is_empty())
    }

    fn only_lines(&self) -> bool {
        self.series.iter().all(|one| one.bars.is_empty())
    }

    fn x_range(&self) -> (f64, f64) {
        if !self.places.is_empty() {
            return (-0.5, self.places.len() as f64 - 0.5);
        }
        let bars = self.series.iter().flat_map(|one| one.bars.iter().map(|bar| bar.x));
        let lines = self.series.iter().flat_map(|one| one.line.iter().map(|point| point.0));
        let only_lines = self.only_lines();
        let all = || bars.clone().chain(lines.clone());
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        if !low.is_finite() {
            return (0.0, 1.0);
        }
        let margin = if only_lines { 0.0 } else { 0.06 * (high - low).max(1e-9) };
        ((if only_lines { 0.0 } else { low }) - margin, high.max(low + 1e-9) + margin)
    }

    fn y_top(&self) -> f64 {
        let bars = self.series.iter().flat_map(|one| one.bars.iter().map(|bar| bar.high));
        let lines = self.series.iter().flat_map(|one| one.line.iter().map(|point| point.1));
        let highest = bars.chain(lines).fold(0.0, f64::max);
        self.top.unwrap_or(if highest > 0.0 { 1.08 * highest } else { 1.0 })
    }

    /// The text of the SVG file: the same for the same plot.
    ///
    /// # Errors
    /// What the plotter says.
    pub(crate) fn to_svg(&self) -> Result<String, String> {
        let mut text = String::new();
        self.draw(&mut text).map_err(|error| error.to_string())?;
        Ok(text)
    }

    fn draw(
        &self,
        text: &mut String,
    ) -> Result<(), DrawingAreaErrorKind<<SVGBackend<'static> as DrawingBackend>::ErrorType>> {
        let names = legend::height(&self.series, SIZE.0 - LEFT);
        let root = SVGBackend::with_string(text, (SIZE.0, SIZE.1 + names)).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(TITLE + names);
        let (title, names) = head.split_vertically(TITLE);
        title.titled(&self.title, ("sans-serif", 18))?;
        let colour_of = |one: &Series| COLOURS[one.colour % COLOURS.len()];
        legend::draw(&names.margin(0, 0, LEFT, 0), &self.series, colour_of)?;
        let (left, right) = self.x_range();
        let mut context = ChartBuilder::on(&body)
            .margin(8)
            .margin_right(14)
            .x_label_area_size(38)
            .y_label_area_size(LEFT - 8)
            .build_cartesian_2d(left..right, 0.0..self.y_top())?;
        let place = |x: &f64| {
            let at = x.round();
            let name = (at >= 0.0 && (x - at).abs() < 1e-6).then(|| self.places.get(at as usize));
            name.flatten().cloned().unwrap_or_default()
        };
        let number = |x: &f64| format!("{}", (x * 1e6).round() / 1e6);
        let labels: &dyn Fn(&f64) -> String = if self.places.is_empty() { &number } else { &place };
        context
            .configure_mesh()
            .x_desc(self.x_label.as_str())
            .y_desc(self.y_label.as_str())
            .x_labels(if self.places.is_empty() { 7 } else { 2 * self.places.len() + 1 })
            .y_labels(6)
            .label_style(("sans-serif", 15))
            .axis_desc_style(("sans-serif", 15))
            .x_label_formatter(labels)
            .y_label_formatter(&number)
            .light_line_style(WHITE.mix(0.0))
            .bold_line_style(BLACK.mix(0.12))
            .draw()?;
        for one in &self.series {
            let colour = colour_of(one);
            if !one.band.is_empty() {
                let there = one.band.iter().map(|&(x, low, _)| (x, low));
                let back = one.band.iter().rev().map(|&(x, _, high)| (x, high));
                let outline: Vec<(f64, f64)> = there.chain(back).collect();
                context.draw_series([Polygon::new(outline, colour.mix(0.15))])?;
            }
            let thin: Vec<(f64, f64)> = one.bars.iter().map(|bar| (bar.x, bar.y)).collect();
            if self.places.is_empty() {
                context.draw_series(LineSeries::new(thin.clone(), colour.mix(0.5)))?;
            }
            context.draw_series(one.bars.iter().map(|bar| {
                ErrorBar::new_vertical(bar.x, bar.low, bar.y, bar.high, colour.stroke_width(1), 7)
            }))?;
            let fill = if one.hollow { WHITE.filled() } else { colour.filled() };
            context.draw_series(thin.iter().map(|&at| Circle::new(at, 4, fill)))?;
            context
                .draw_series(thin.iter().map(|&at| Circle::new(at, 4, colour.stroke_width(2))))?;
            let line = LineSeries::new(one.line.iter().copied(), colour.stroke_width(2));
            context.draw_series(line)?;
        }
        root.present()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_is_one_svg_and_the_same_each_time() {
        let series = Series {
            name: "relative & co".into(),
            line: vec![(0.0, 0.1), (10.0, 1.0)],
            band: vec![(0.0, 0.05, 0.2), (10.0, 0.9, 1.0)],
            bars: vec![Bar { x: 5.0, y: 0.5, low: 0.4, high: 0.6 }],
            ..Series::default()
        };
        let chart = Chart { title: "a < b".into(), series: vec![series], ..Chart::default() };
        assert!(!chart.is_empty());
        let svg = chart.to_svg().expect("a plot");
        assert_eq!(svg, chart.to_svg().expect("a plot"));
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{svg}");
        assert!(svg.contains("a &lt; b") && svg.contains("relative &amp; co"), "{svg}");
        assert!(!svg.contains("NaN"), "{svg}");
    }

    #[test]
    fn a_plot_of_nothing_is_drawn_too() {
        let chart = Chart { places: vec!["here".into()], ..Chart::default() };
        assert!(chart.is_empty());
        assert!(!chart.to_svg().expect("a plot").contains("NaN"));
        assert!(!Chart::default().to_svg().expect("a plot").contains("NaN"));
    }
}
