//! Meshes of files, for benches that are given some: OFF, OBJ, STL.

use solid::mesh::weld;
use solid::{Label, Point3, Polyhedron};

/// The mesh of a file, told by its name; polygons as fans, all faces obstacle.
pub fn read(path: &str) -> Polyhedron {
    let bytes = std::fs::read(path).expect("a file");
    let (vertices, faces) = match path.rsplit('.').next() {
        Some("stl") => stl(&bytes),
        Some("obj") => obj(&String::from_utf8_lossy(&bytes)),
        _ => off(&String::from_utf8_lossy(&bytes)),
    };
    let labels = vec![Label::Obstacle; faces.len()];
    weld(&Polyhedron::try_new(vertices, faces, labels).expect("a mesh")).mesh
}

type Parts = (Vec<Point3>, Vec<[u32; 3]>);

fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> + use<'_> {
    (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]])
}

fn off(text: &str) -> Parts {
    let bare = text.lines().flat_map(|line| line.split('#').next()).flat_map(str::split_whitespace);
    let mut words = bare.skip_while(|word| *word == "OFF");
    let mut number = || words.next().expect("a whole file").parse::<f64>().expect("a number");
    let (points, faces) = (number() as usize, number() as usize);
    number();
    let vertices = (0..points).map(|_| Point3::new(number(), number(), number())).collect();
    let mut triangles = Vec::new();
    for _ in 0..faces {
        let count = number() as usize;
        let corners: Vec<u32> = (0..count).map(|_| number() as u32).collect();
        triangles.extend(fan(&corners));
    }
    (vertices, triangles)
}

fn obj(text: &str) -> Parts {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut number = || words.next().and_then(|word| word.parse().ok()).expect("x y z");
                vertices.push(Point3::new(number(), number(), number()));
            }
            Some("f") => {
                let index = |word: &str| word.split('/').next()?.parse::<u32>().ok();
                let corners: Vec<u32> =
                    words.map(|word| index(word).expect("a vertex from 1") - 1).collect();
                triangles.extend(fan(&corners));
            }
            _ => {}
        }
    }
    (vertices, triangles)
}

/// Binary STL.
fn stl(bytes: &[u8]) -> Parts {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for record in bytes.get(84..).expect("a header").as_chunks::<50>().0 {
        let numbers = record[12..48].as_chunks::<4>().0;
        let number = |i: usize| f64::from(f32::from_le_bytes(numbers[i]));
        let first = vertices.len() as u32;
        vertices.extend(
            (0..3).map(|i| Point3::new(number(3 * i), number(3 * i + 1), number(3 * i + 2))),
        );
        triangles.push([first, first + 1, first + 2]);
    }
    // Corners at one place are one before faces are looked at: `weld` drops those that lose a corner.
    (vertices, triangles)
}
