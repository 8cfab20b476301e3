//! What the construction of a volume tells.

use pose::Se2;
use probe::{Probe, VertexId};
use sensing::Scan;

use super::{LocalVolume, Samples};
use crate::{MapProbe, Standing};

/// Steps of building a local volume (\[ISRR19\] 4.1, \[Zie18\] 2.4).
#[derive(Clone, Copy, Debug)]
pub enum VolumeEvent<'a> {
    /// A scan arrived: rays, hits and misses.
    Measured {
        /// The vertex it belongs to.
        vertex: VertexId,
        /// The scan, in the sensor frame.
        scan: &'a Scan,
        /// The sensor in the frame of the vertex.
        anchor_from_sensor: Se2,
    },
    /// Its samples were put in order, together with those of scans before from the same place.
    Sampled {
        /// The vertex.
        vertex: VertexId,
        /// Everything seen from there.
        samples: &'a Samples,
    },
    /// A volume was built for a new vertex.
    Built {
        /// The vertex.
        vertex: VertexId,
        /// The volume, in the frame of the vertex.
        volume: &'a LocalVolume,
    },
    /// A scan taken after turning in place was merged into the volume of the same place.
    Merged {
        /// The vertex.
        vertex: VertexId,
        /// The volume that takes the place of the one before.
        volume: &'a LocalVolume,
    },
}

probe::variants!(VolumeEvent<'_>: Measured, Sampled, Built, Merged);

/// Tells of a scan and of the volume that came of it; `merged` where there was one at its vertex.
pub(crate) fn tell_of_volume(
    standing: &Standing,
    scan: &Scan,
    (samples, volume): (&Samples, &LocalVolume),
    merged: bool,
    probe: &mut dyn MapProbe,
) {
    if !Probe::<VolumeEvent<'_>>::on(probe) {
        return;
    }
    let (vertex, anchor_from_sensor) = (standing.vertex, standing.vertex_from_body);
    probe.emit(VolumeEvent::Measured { vertex, scan, anchor_from_sensor });
    probe.emit(VolumeEvent::Sampled { vertex, samples });
    probe.emit(if merged {
        VolumeEvent::Merged { vertex, volume }
    } else {
        VolumeEvent::Built { vertex, volume }
    });
}
