//! Greedy insertion, and what polishes it.

use probe::Probe;

use super::delaunay::Delaunay;
use super::fit::fit;
use super::flips::Flips;
use super::guide::median_of_nine;
use super::options::InverseDepth;
use super::plane::{LiftedPlane, farthest_pixel};
use super::scan::{Count, Scanned, Sheet, scan, worst_pixel};
use super::thin::thin;
use crate::DepthEvent;
use crate::image::{FilledImage, Pixel};
use crate::reduce::Stop;
use crate::reduce::heap::IndexedHeap;
use crate::triangulate::{ImageMesh, orient};

/// Reduces an image to `stop.vertices()`, or until no pixel is farther than `stop.error_m()` from the
/// plane of its face.
///
/// 1. Two faces cover the image.
/// 2. Every pixel of a new face is measured against the face's plane, in metres.
/// 3. The face that is worst by largest and summed distance gets its worst pixel as a vertex; sides
///    are turned until the triangulation is Delaunay again. Back to 2.
/// 4. For a count of vertices, not for a bound: depths are fitted, sides turned, depths fitted again.
///    Below [`COARSE`] vertices, four times as many are put in, and taken out again before that.
///
/// With a bound, vertices keep their measured depths, no median is taken, missing pixels count like
/// others and step 4 is left out: the bound then holds for every pixel. O(pixels log vertices) for
/// images in which detail is spread.
pub(in crate::reduce) fn grow<P>(
    image: &FilledImage,
    options: &InverseDepth,
    stop: &Stop,
    ladder: &[usize],
    probe: &mut P,
) -> ImageMesh
where
    P: for<'e> Probe<DepthEvent<'e>>,
{
    let exact = InverseDepth::exact();
    let options = if stop.error_m().is_some() { &exact } else { options };
    let signed = options.missing_weight < 1.0;
    let sheet = Sheet::new(image, image.depths_m().to_vec(), signed);
    let median = options.median && stop.vertices().is_some_and(InverseDepth::is_few);
    let smooth = median.then(|| Sheet::new(image, median_of_nine(image), signed));
    let guide = smooth.as_ref().unwrap_or(&sheet);
    let mut grown = Grown::new(image, guide, &sheet, options);
    let mut steps: Vec<usize> = ladder.to_vec();
    steps.sort_unstable_by(|a, b| b.cmp(a));
    // Few vertices are chosen from more of them.
    let count = stop.vertices();
    let most = count.map(InverseDepth::first_of);
    loop {
        grown.measure_changed();
        let vertices = grown.mesh.pixels.len();
        while steps.last().is_some_and(|&step| step <= vertices) {
            if steps.pop() == Some(vertices) && probe.on() {
                probe.emit(DepthEvent::Reached { image, mesh: &grown.image_mesh() });
            }
        }
        if most.is_some_and(|most| vertices >= most) {
            break;
        }
        let bound_m = stop.error_m();
        let next = grown.worst(bound_m.unwrap_or(0.0));
        let next = next.or_else(|| bound_m.and_then(|bound_m| grown.beyond(bound_m)));
        let Some((triangle, pixel)) = next else { break };
        let error_m = f64::from(grown.scans[triangle as usize].worst_m);
        grown.insert(triangle, pixel);
        if probe.on() {
            probe.emit(DepthEvent::Inserted { pixel, error_m, vertices: vertices + 1 });
        }
    }
    if options.fit_m > 0.0 {
        grown.fit(probe);
    }
    if let Some(count) = count.filter(|&count| count < grown.mesh.pixels.len()) {
        grown.thin(count, probe);
    }
    let mut flips = None;
    for round in 0..options.flip_rounds {
        let start = || Flips::new(image, &sheet, &grown.mesh, &grown.inverse, options);
        let sides = flips.get_or_insert_with(start).round(&mut grown.mesh);
        probe.emit(DepthEvent::Flipped { round, sides });
    }
    if options.fit_m > 0.0 && options.flip_rounds > 0 {
        grown.fit(probe);
    }
    grown.image_mesh()
}

struct Grown<'a> {
    image: &'a FilledImage,
    /// What vertices are chosen by.
    guide: &'a Sheet,
    /// The image's depths.
    sheet: &'a Sheet,
    options: &'a InverseDepth,
    mesh: Delaunay,
    /// Inverse depth of each vertex.
    inverse: Vec<f64>,
    scans: Vec<Scanned>,
    heap: IndexedHeap,
    /// Faces for which a bound is not yet known to hold to the last digit; none before scans say that it
    /// holds everywhere.
    unsure: Option<Vec<u32>>,
}

impl<'a> Grown<'a> {
    fn new(
        image: &'a FilledImage,
        guide: &'a Sheet,
        sheet: &'a Sheet,
        options: &'a InverseDepth,
    ) -> Self {
        let mesh = Delaunay::new(image.corners());
        let at = |&pixel: &_| 1.0 / guide.depth_m(pixel);
        let inverse = mesh.pixels.iter().map(at).collect();
        let (scans, heap) = (Vec::new(), IndexedHeap::default());
        Self { image, guide, sheet, options, mesh, inverse, scans, heap, unsure: None }
    }

    /// The plane of a face, and how much distances from it count.
    fn plane_of(&self, triangle: u32) -> (LiftedPlane, f64) {
        let pixels = self.mesh.pixels_of(triangle);
        let inverse = self.mesh.corners[triangle as usize].map(|v| self.inverse[v as usize]);
        let plane = LiftedPlane::through(self.image.camera(), pixels, inverse);
        let emphasis = plane.emphasis(inverse, self.options.edge_on);
        (plane, emphasis)
    }

    fn measure_changed(&mut self) {
        self.scans.resize(self.mesh.corners.len(), Scanned::default());
        if let Some(unsure) = &mut self.unsure {
            unsure.extend(&self.mesh.changed);
        }
        for at in 0..self.mesh.changed.len() {
            let triangle = self.mesh.changed[at];
            let [a, b, c] = self.mesh.pixels_of(triangle);
            self.measure(triangle, self.options.stride_of(orient(a, b, c)));
        }
    }

    /// A face with a pixel that is farther off than the bound, once scans find none: these measure in
    /// single precision. O(pixels) in all.
    fn beyond(&mut self, bound_m: f64) -> Option<(u32, Pixel)> {
        let faces = 0..self.mesh.corners.len() as u32;
        let mut unsure = self.unsure.take().unwrap_or_else(|| faces.collect());
        let mut found = None;
        while found.is_none()
            && let Some(triangle) = unsure.pop()
        {
            let (plane, _) = self.plane_of(triangle);
            let corners = self.mesh.pixels_of(triangle);
            found = farthest_pixel(self.image, corners, &plane, bound_m).map(|p| (triangle, p));
        }
        self.unsure = Some(unsure);
        found
    }

    #[expect(clippy::cast_possible_truncation, reason = "an order, not a measurement")]
    fn measure(&mut self, triangle: u32, stride: usize) {
        let (plane, emphasis) = self.plane_of(triangle);
        let (weight, emphasis) = (self.options.sum_weight as f32, emphasis as f32);
        let cap_m = self.options.cap_at(self.mesh.pixels.len()) as f32 / emphasis;
        let count = Count { cap_m, missing: self.options.missing_weight as f32, stride };
        let found = scan(self.guide, self.mesh.pixels_of(triangle), &plane, &count);
        let largest = found.worst_m.min(cap_m);
        let key = if weight == 0.0 {
            largest
        } else {
            largest.powf(1.0 - weight) * found.sum_m.powf(weight)
        } * emphasis;
        self.scans[triangle as usize] = found;
        if found.worst_m <= 0.0 && stride > 1 {
            return self.measure(triangle, 1);
        }
        self.heap.set(triangle, if found.worst_m <= 0.0 { 0.0 } else { -key });
    }

    /// The face to split next, and where: the worst, if it is off by more than the bound.
    #[expect(clippy::cast_possible_truncation, reason = "weights are shares")]
    fn worst(&mut self, bound_m: f64) -> Option<(u32, Pixel)> {
        loop {
            let (key, triangle) = self.heap.first()?;
            let found = self.scans[triangle as usize];
            if key >= 0.0 || f64::from(found.worst_m) <= bound_m {
                return None;
            }
            let corners = self.mesh.pixels_of(triangle);
            let (plane, _) = self.plane_of(triangle);
            let missing = self.options.missing_weight as f32;
            match worst_pixel(self.guide, corners, &plane, missing, &found) {
                Some(pixel) if !corners.contains(&pixel) => return Some((triangle, pixel)),
                // A corner is off by rounding alone: such a face has nothing left to give, unless
                // rows of it were left out.
                _ if found.stride > 1 => self.measure(triangle, 1),
                _ => self.heap.set(triangle, 0.0),
            }
        }
    }

    fn insert(&mut self, triangle: u32, pixel: Pixel) {
        self.mesh.insert(pixel, triangle);
        self.inverse.push(1.0 / self.guide.depth_m(pixel));
    }

    fn thin<P: for<'e> Probe<DepthEvent<'e>>>(&mut self, count: usize, probe: &mut P) {
        let mesh = thin(self.image, self.sheet, &self.image_mesh(), count, self.options);
        self.mesh = Delaunay::of_mesh(&mesh);
        self.inverse = mesh.depths_m.iter().map(|depth_m| 1.0 / depth_m).collect();
        probe.emit(DepthEvent::Thinned { mesh: &mesh });
        if self.options.fit_m > 0.0 {
            self.fit(probe);
        }
    }

    fn fit<P: for<'e> Probe<DepthEvent<'e>>>(&mut self, probe: &mut P) {
        let mut mesh = self.image_mesh();
        fit(self.image, self.sheet, &mut mesh, self.options);
        self.inverse = mesh.depths_m.iter().map(|depth_m| 1.0 / depth_m).collect();
        probe.emit(DepthEvent::Fitted { mesh: &mesh });
    }

    fn image_mesh(&self) -> ImageMesh {
        ImageMesh {
            pixels: self.mesh.pixels.clone(),
            depths_m: self.inverse.iter().map(|inverse| 1.0 / inverse).collect(),
            triangles: self.mesh.corners.clone(),
        }
    }
}
