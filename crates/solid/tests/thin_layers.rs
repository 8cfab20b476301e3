//! Layers as thin as a jitter: what passes a segment there does so next to one of its ends.

use solid::{Label, Point3, Polyhedron, check, tetrahedralize};

/// What is left of a union of two views of one wall, jittered by 1e-8 m, when edges are drawn together as long as
/// four segments from vertex 8 to the wall pass everything but their ends 1e-8 m before it.
const VERTICES: [[f64; 3]; 13] = [
    [-8.006853147007954e-9, 2.359437954431658, 1.5347456022572454],
    [-7.73350711223797e-9, 2.3539566011314856, 2.081975982727134],
    [-7.672304598376824e-9, 3.103153202064995, 1.2483721443658695],
    [1.3099652854236765, 3.5716647718131096, 0.9969483339652249],
    [1.30780281422683, 3.571664768561027, 1.3325586625831591],
    [-7.562028326892786e-9, 1.1056759817782356, 2.5067224885559356],
    [-1.0187645070105459e-8, 1.6078553183428728, 2.335848309580052],
    [-8.95177494244926e-9, 2.0158785206265124, 2.1970121978836916],
    [1.8678608220993331, 4.900667923678993, 0.8548901616030941],
    [1.3072696475036278, 3.5716647713113514, 1.4153072604467882],
    [-7.899895950137736e-9, 3.2929918799084152, 0.9472729327821471],
    [1.3951404647267724, 3.5716647712862937, 1.3983466946752043],
    [1.837878620555135, 4.883855515435394, 0.8489623679773519],
];

const FACES: [[u32; 3]; 22] = [
    [0, 1, 2],
    [3, 4, 0],
    [4, 5, 0],
    [0, 5, 6],
    [0, 6, 7],
    [0, 7, 1],
    [6, 8, 7],
    [6, 5, 8],
    [5, 4, 9],
    [0, 2, 10],
    [10, 2, 8],
    [2, 1, 8],
    [7, 8, 1],
    [0, 10, 3],
    [4, 11, 9],
    [5, 9, 8],
    [4, 3, 11],
    [9, 11, 8],
    [11, 3, 8],
    [8, 12, 10],
    [12, 3, 10],
    [12, 8, 3],
];

#[test]
fn a_segment_that_is_passed_next_to_its_end_is_brought_in() {
    let vertices: Vec<Point3> = VERTICES.map(Point3::from).to_vec();
    let mesh = Polyhedron::try_new(vertices, FACES.to_vec(), vec![Label::Obstacle; FACES.len()])
        .expect("a mesh");
    assert!(check(&mesh).is_valid());
    let found = tetrahedralize(&mesh).expect("TetGen fills it, too");
    assert_eq!(found.boundary.len(), FACES.len());
    assert!((found.volume_m3() - mesh.volume_m3()).abs() < 1e-12);
    assert!(found.steiner_points <= 1, "{}", found.steiner_points);
}
