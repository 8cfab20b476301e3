//! `manifold-rust` as the engine.

use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGLP, OpType};

use super::{Combined, Kernel, Operation, Refusal};
use crate::{Point3, Polyhedron};

/// The exact engine of `manifold-rust`.
#[derive(Clone, Copy, Debug, Default)]
pub struct ManifoldKernel;

/// The run that all faces belong to: faces of one number are merged only within a run. Numbers that
/// the engine gives out itself start above.
const RUN: u32 = 0;

fn sound(solid: Manifold) -> Result<Manifold, Refusal> {
    match solid.status() {
        Error::NoError => Ok(solid),
        status => Err(Refusal(format!("{status:?}"))),
    }
}

impl Kernel for ManifoldKernel {
    type Solid = Manifold;

    fn take(&self, mesh: &Polyhedron, tags: &[u32]) -> Result<Manifold, Refusal> {
        let taken = MeshGLP::<f64, u32> {
            num_prop: 3,
            vert_properties: mesh.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect(),
            tri_verts: mesh.faces().as_flattened().to_vec(),
            run_original_id: vec![RUN],
            run_index: vec![0, 3 * mesh.faces().len() as u32],
            face_id: tags.to_vec(),
            ..Default::default()
        };
        sound(Manifold::from_mesh_glp(&taken))
    }

    fn combine(
        &self,
        a: &Manifold,
        b: &Manifold,
        operation: Operation,
    ) -> Result<Manifold, Refusal> {
        let operation = match operation {
            Operation::Union => OpType::Add,
            Operation::Intersection => OpType::Intersect,
            Operation::Difference => OpType::Subtract,
            Operation::SymmetricDifference => {
                return Err(Refusal("symmetric difference is made of two differences".into()));
            }
        };
        sound(a.boolean_with_engine(b, operation, BooleanEngine::Exact))
    }

    fn give(&self, solid: &Manifold) -> Combined {
        let given: MeshGLP<f64, u32> = solid.get_mesh_glp(-1);
        let stride = (given.num_prop as usize).max(3);
        let places = given.vert_properties.chunks_exact(stride);
        let mut vertices: Vec<Point3> = places.map(|v| Point3::new(v[0], v[1], v[2])).collect();
        // Vertices exist once for each run; one of each stays.
        let mut joined: Vec<u32> = (0..vertices.len() as u32).collect();
        for (&from, &to) in given.merge_from_vert.iter().zip(&given.merge_to_vert) {
            joined[from as usize] = to;
        }
        let corners = given.tri_verts.as_chunks::<3>().0;
        let mut faces: Vec<[u32; 3]> =
            corners.iter().map(|face| face.map(|vertex| joined[vertex as usize])).collect();
        let mut new_of = vec![u32::MAX; vertices.len()];
        for &vertex in faces.as_flattened() {
            new_of[vertex as usize] = 0;
        }
        let mut kept = 0;
        for (old, new) in new_of.iter_mut().enumerate().filter(|(_, new)| **new == 0) {
            *new = kept;
            vertices[kept as usize] = vertices[old];
            kept += 1;
        }
        vertices.truncate(kept as usize);
        for vertex in faces.as_flattened_mut() {
            *vertex = new_of[*vertex as usize];
        }
        Combined { vertices, faces, tags: given.face_id }
    }
}
