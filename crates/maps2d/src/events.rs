//! Everything that the maps tell, in one trait that a listener implements.

use probe::Probe;

use crate::correction::CorrectionEvent;
use crate::grid::GridEvent;
use crate::polygons::PolygonEvent;
use crate::relative::ConsolidationEvent;
use crate::volume::VolumeEvent;

/// A listener of all map events; implemented by whatever listens to each family.
pub trait MapProbe:
    for<'a> Probe<VolumeEvent<'a>>
    + for<'a> Probe<ConsolidationEvent<'a>>
    + for<'a> Probe<GridEvent<'a>>
    + for<'a> Probe<CorrectionEvent<'a>>
    + for<'a> Probe<PolygonEvent<'a>>
{
}

impl<P> MapProbe for P where
    P: for<'a> Probe<VolumeEvent<'a>>
        + for<'a> Probe<ConsolidationEvent<'a>>
        + for<'a> Probe<GridEvent<'a>>
        + for<'a> Probe<CorrectionEvent<'a>>
        + for<'a> Probe<PolygonEvent<'a>>
        + ?Sized
{
}
