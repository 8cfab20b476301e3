//! The listener of a replay.

use std::time::{Duration, Instant};

use geometry::Point2;
use places::PlaceEvent;
use pose::Se2;
use probe::Probe;

use super::ReplayOptions;
use super::matched::Matches;
use super::page;
use super::pictures::Pictures;
use crate::columns::{EventTexts, Now, Numbers, Rgba, eye, rgb};
use crate::recording::{CONFIG, RESULT};
use crate::stage::Stage;
use crate::{InstrumentError, Level, MapOptions, Recorder, layout, palette};

/// Rows are sent when this much memory is held,
const HELD_BYTES: usize = 4 << 20;
/// or when the oldest row is this old: what a killed replay may lose.
const HELD_FOR: Duration = Duration::from_millis(1000);

/// Relative placement is drawn at every so many keyframes below [`Level::Full`].
const EVERY_AT_SUMMARY: u64 = 4;

/// The names of the events of place recognition.
pub const PLACE_EVENTS: &[&str] = PlaceEvent::VARIANTS;

/// A keyframe, as it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct KeyframeSeen<'a> {
    /// Where its scan met something, in its frame.
    pub returns: &'a [Point2],
    /// Where the log's odometry has it, from the first keyframe on.
    pub odom_from_keyframe: Se2,
    /// Where it lies in the frame of the last one, the scans heard.
    pub last_from_keyframe: Se2,
    /// Keyframes around it, each along its shortest path in its frame, with the position in this list of
    /// the one before it on that path; itself first.
    pub around: &'a [(usize, Se2, Option<usize>)],
}

/// All keyframes once the graph was optimised, as they are drawn.
#[derive(Clone, Copy, Debug)]
pub struct SettledSeen<'a> {
    /// Where they are.
    pub map_from_keyframe: &'a [Se2],
    /// Frontier that counts, its pieces in the same frame.
    pub frontier_in_map: &'a [(Point2, Point2)],
}

/// The recording of a replay: pictures, matches, and the maps' own recorders.
///
/// It is a probe of place recognition. Errors of writing are reported by [`keyframe`](Self::keyframe).
pub struct ReplayRecording {
    inner: Option<Box<Inner>>,
    options: ReplayOptions,
}

struct Inner {
    stage: Stage,
    now: Now,
    full: bool,
    pictures: Pictures,
    matches: Matches,
    events: EventTexts,
    residual: Numbers,
    sigma: Numbers,
    proposed: Numbers,
    accepted: Numbers,
    counts: (u64, u64),
    last_sent: Instant,
    /// The first refusal, until it is told.
    refusal: Option<InstrumentError>,
}

impl ReplayRecording {
    /// Creates the file, with the layout, the text page and the config; at [`Level::Off`] nothing.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: ReplayOptions) -> Result<Self, InstrumentError> {
        if options.level == Level::Off {
            return Ok(Self { inner: None, options });
        }
        let stage = Stage::create(&options.path, &options.name)?;
        layout::send_replay(&stage.stream, &options).map_err(|reason| stage.refused(reason))?;
        stage.about(page::about(&options))?;
        stage.text(CONFIG, format!("```toml\n{}\n```\n", options.config.trim_end()))?;
        let classes = palette::CELL_CLASSES.map(|(id, label, colour)| {
            let colour = rerun::datatypes::Rgba32(colour);
            rerun::AnnotationInfo::from((u16::from(id), label, colour))
        });
        let context = rerun::AnnotationContext::new(classes);
        crate::columns::fixed(&stage.stream, &"/".into(), &context)?;
        eye(&stage.stream, "/eye")?;
        stage.flush()?;
        let full = options.level == Level::Full;
        let plot = |name: &str, title: &str, colour: Rgba| {
            Numbers::new(&format!("plots/{name}"), title.to_owned(), colour)
        };
        let inner = Inner {
            stage,
            now: Now::default(),
            full,
            pictures: Pictures::new(if full { 1 } else { EVERY_AT_SUMMARY }),
            matches: Matches::new(),
            events: EventTexts::new("events/places", rgb(120, 190, 255)),
            residual: plot("residual_m", "residual of the match, m", rgb(160, 60, 170)),
            sigma: plot("sigma_m", "deviation along its worst axis, m", rgb(40, 150, 70)),
            proposed: plot("proposed", "closures tried", palette::ODOMETRY),
            accepted: plot("accepted", "closures believed", palette::PLACE),
            counts: (0, 0),
            last_sent: Instant::now(),
            refusal: None,
        };
        Ok(Self { inner: Some(Box::new(inner)), options })
    }

    /// Whether anything is recorded.
    pub fn is_on(&self) -> bool {
        self.inner.is_some()
    }

    /// A recorder for a map.
    pub fn recorder(&self, name: &str) -> Recorder {
        let Some(inner) = &self.inner else { return Recorder::off() };
        let known = self.options.maps.iter().position(|map| map.name == name);
        let map =
            known.map_or_else(|| MapOptions::of_kind(name), |at| self.options.maps[at].clone());
        let colour = known.map_or(rgb(80, 80, 80), |at| palette::MAPS[at % palette::MAPS.len()]);
        let stream = inner.stage.stream.clone();
        Recorder::new(stream, &map, colour, self.options.level, self.options.every)
    }

    /// A keyframe begins; all events until the next belong to it. Distance in metres, time in seconds.
    pub fn begin(&mut self, step: u64, distance_m: f64, time_secs: f64) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.step = step as i64;
        inner.now.distance_mm = (distance_m * 1e3).round() as i64;
        inner.now.sim_time_ns = (time_secs * 1e9).round() as i64;
    }

    /// Draws a keyframe, and sends rows if it is time to.
    ///
    /// # Errors
    /// Where rows could not be written.
    pub fn keyframe(&mut self, seen: &KeyframeSeen<'_>) -> Result<(), InstrumentError> {
        let Some(inner) = &mut self.inner else { return Ok(()) };
        let now = inner.now;
        inner.pictures.keyframe(seen, &now);
        inner.proposed.push(inner.counts.0 as f64, &now);
        inner.accepted.push(inner.counts.1 as f64, &now);
        if let Some(refusal) = inner.refusal.take() {
            return Err(refusal);
        }
        let held = inner.pictures.held_bytes() + inner.matches.held_bytes();
        if held >= HELD_BYTES || inner.last_sent.elapsed() >= HELD_FOR {
            return inner.send();
        }
        Ok(())
    }

    /// Draws all keyframes where the optimised graph has them.
    pub fn settled(&mut self, seen: &SettledSeen<'_>) {
        if let Some(inner) = &mut self.inner {
            let now = inner.now;
            inner.pictures.settle(seen, &now);
        }
    }

    /// A place that somebody else found became a place edge.
    pub fn closed(&mut self, known: usize, current: usize) {
        if let Some(inner) = &mut self.inner {
            inner.pictures.closed(known, current);
            inner.counts.0 += 1;
            inner.counts.1 += 1;
        }
    }

    /// Ends the recording with its final metrics; all recorders must have sent their rows.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file could not be written.
    pub fn finish(self, metrics: &serde_json::Value) -> Result<(), InstrumentError> {
        let Some(mut inner) = self.inner else { return Ok(()) };
        inner.send()?;
        inner.stage.text(RESULT, layout::result(metrics))?;
        inner.stage.metrics(metrics)?;
        inner.stage.end()
    }
}

impl Inner {
    fn send(&mut self) -> Result<(), InstrumentError> {
        self.last_sent = Instant::now();
        let stream = &self.stage.stream;
        self.pictures.send(stream)?;
        self.matches.send(stream)?;
        self.events.send(stream)?;
        for numbers in [&mut self.residual, &mut self.sigma, &mut self.proposed, &mut self.accepted]
        {
            numbers.send(stream)?;
        }
        Ok(())
    }

    fn hear(&mut self, event: &PlaceEvent<'_>) {
        self.now.event += 1;
        let now = self.now;
        let variant = event.variant();
        match event {
            PlaceEvent::KeyframeAdded { keyframe, surface, travelled_m } => {
                if self.full {
                    let count = surface.len();
                    let line =
                        format_args!("{keyframe}: {count} returns, {travelled_m:.1} m driven");
                    self.events.push(variant, line, &now);
                }
            }
            PlaceEvent::Tracked(matched) => {
                if self.full {
                    self.events.push(variant, format_args!("{}", page::Line(matched)), &now);
                }
            }
            PlaceEvent::CandidatesRanked { current, candidates } => {
                if self.full {
                    let line = format_args!("{current}: {}", page::Ranked(candidates));
                    self.events.push(variant, line, &now);
                }
            }
            PlaceEvent::PlaceMatched(matched) => {
                self.counts.0 += 1;
                self.matches.draw(matched, &now);
                let sigma_m = matched.covariance[(0, 0)].max(matched.covariance[(1, 1)]).sqrt();
                // A match that no surface takes part in has no covariance.
                if sigma_m < 10.0 {
                    self.residual.push(matched.residual_m, &now);
                    self.sigma.push(sigma_m, &now);
                }
                self.events.push(variant, format_args!("{}", page::Line(matched)), &now);
                self.now_on_stream();
                if let Err(refusal) = Matches::tell(matched, &self.stage.stream) {
                    self.refusal.get_or_insert(refusal);
                }
            }
            PlaceEvent::Closed { closures } => {
                for closure in *closures {
                    self.counts.1 += 1;
                    let measured = &closure.measured;
                    self.pictures.closed(measured.from, measured.to);
                    let (known, current) = (measured.from, measured.to);
                    self.events.push(variant, format_args!("{known} is seen from {current}"), &now);
                }
            }
            PlaceEvent::GivenUp { closure } => {
                let (known, current) = (closure.from, closure.to);
                let line = format_args!("{known} from {current}: nothing agrees");
                self.events.push(variant, line, &now);
            }
        }
    }

    /// Puts the stream to the time of now, for what is logged past the rows.
    fn now_on_stream(&self) {
        let stream = &self.stage.stream;
        stream.set_time_sequence("step", self.now.step);
        stream.set_time_sequence("distance_mm", self.now.distance_mm);
        stream.set_time_sequence("event", self.now.event);
        let secs = self.now.sim_time_ns as f64 * 1e-9;
        stream.set_duration_secs("sim_time", secs);
    }
}

impl Probe<PlaceEvent<'_>> for ReplayRecording {
    fn on(&self) -> bool {
        self.inner.is_some()
    }

    fn emit(&mut self, event: PlaceEvent<'_>) {
        if let Some(inner) = &mut self.inner {
            inner.hear(&event);
        }
    }
}
