//! A listener that writes down what the maps tell.

use maps2d::correction::CorrectionEvent;
use maps2d::grid::GridEvent;
use maps2d::polygons::PolygonEvent;
use maps2d::relative::ConsolidationEvent;
use maps2d::volume::VolumeEvent;

/// One event: its variant, and what it says, in short.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    pub variant: &'static str,
    pub says: String,
}

impl From<VolumeEvent<'_>> for Told {
    fn from(event: VolumeEvent<'_>) -> Self {
        let says = match &event {
            VolumeEvent::Measured { vertex, scan, .. } => format!("{vertex} {} rays", scan.len()),
            VolumeEvent::Sampled { vertex, samples } => format!("{vertex} {}", samples.len()),
            VolumeEvent::Built { vertex, volume } | VolumeEvent::Merged { vertex, volume } => {
                format!("{vertex} {} frontier edges", volume.frontier.len())
            }
        };
        Self { variant: event.variant(), says }
    }
}

impl From<ConsolidationEvent<'_>> for Told {
    fn from(event: ConsolidationEvent<'_>) -> Self {
        let says = match &event {
            ConsolidationEvent::ScopeTaken { scope, .. } => {
                format!("{:?} {} rows", scope.root(), scope.placed().len())
            }
            ConsolidationEvent::PairCompared { volume, against, closed_m, .. } => {
                format!("{volume} against {against}: {closed_m:.3} m")
            }
            ConsolidationEvent::Closed { volume, edge, span, cause, by, path } => {
                let (from, to) = (span.from, span.to);
                format!(
                    "{volume} {:?} {from:.3}..{to:.3} {cause:?} by {by} along {path:?}",
                    edge.key
                )
            }
            ConsolidationEvent::Reopened { volume, edge, span, cause } => {
                format!("{volume} {:?} {:.3}..{:.3} {cause:?}", edge.key, span.from, span.to)
            }
            ConsolidationEvent::Retired { volume } | ConsolidationEvent::Restored { volume } => {
                volume.to_string()
            }
            ConsolidationEvent::Settled { standing, .. } => standing.to_string(),
        };
        Self { variant: event.variant(), says }
    }
}

impl From<GridEvent<'_>> for Told {
    fn from(event: GridEvent<'_>) -> Self {
        let says = match &event {
            GridEvent::ScanApplied { changed, .. } => format!("{changed:?}"),
            GridEvent::Rebuilt { scans, .. } => format!("{scans} scans"),
        };
        Self { variant: event.variant(), says }
    }
}

impl From<CorrectionEvent<'_>> for Told {
    fn from(event: CorrectionEvent<'_>) -> Self {
        let says = match &event {
            CorrectionEvent::Corrected { new_places, factors, after, moved_max_m, .. } => {
                let count = after.len();
                format!("{new_places} {factors} {count} {moved_max_m:.6}")
            }
            CorrectionEvent::Refused { report } => format!("{:?}", report.termination),
        };
        Self { variant: event.variant(), says }
    }
}

impl From<PolygonEvent<'_>> for Told {
    fn from(event: PolygonEvent<'_>) -> Self {
        let says = match &event {
            PolygonEvent::United { vertex, region, .. } => {
                format!("{vertex} {:.6} m2", region.area_m2())
            }
            PolygonEvent::Rebuilt { views, region } => {
                format!("{views} {:.6} m2", region.area_m2())
            }
            PolygonEvent::Settled { standing, open, .. } => format!("{standing} {open:?}"),
            PolygonEvent::WayPlanned { dual, way } => format!("{} {way:?}", dual.nodes.len()),
            other => format!("{other:?}"),
        };
        Self { variant: event.variant(), says }
    }
}
