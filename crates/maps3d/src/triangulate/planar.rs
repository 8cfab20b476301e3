//! The proof that a mesh is a planar triangulation of the image.

use crate::Maps3dError;

use super::{ImageMesh, orient};

/// Proves, in whole numbers, that the faces cover an image of `columns` x `rows` pixels once.
///
/// 1. Every face turns positively, and its corners are three pixels of the image.
/// 2. No directed edge is used twice. An edge without a partner in the other direction lies on one
///    side of the image.
/// 3. Those edges form one loop around the image.
/// 4. The areas of all faces add up to that of the image.
///
/// By 1 to 3 the faces wind around every point inside the image equally often, by 4 once: no two
/// overlap. The lifted surface then meets each ray from the camera once, so it does not intersect
/// itself. O(n log n).
///
/// # Errors
/// [`Maps3dError::NotPlanar`] with the first fault.
pub fn check_planar(mesh: &ImageMesh, columns: usize, rows: usize) -> Result<(), Maps3dError> {
    let fault = |fault: String| Err(Maps3dError::NotPlanar { fault });
    if mesh.depths_m.len() != mesh.pixels.len() {
        return fault(format!("{} depths, {} pixels", mesh.depths_m.len(), mesh.pixels.len()));
    }
    let mut area = 0;
    let mut edges = Vec::with_capacity(mesh.triangles.len() * 3);
    for (face, &triangle) in mesh.triangles.iter().enumerate() {
        if let Some(&vertex) = triangle.iter().find(|&&v| v as usize >= mesh.pixels.len()) {
            return fault(format!("face {face} has the unknown vertex {vertex}"));
        }
        let [a, b, c] = mesh.corner_pixels(triangle);
        let doubled = orient(a, b, c);
        if doubled <= 0 {
            return fault(format!("face {face} turns the wrong way: {a:?} {b:?} {c:?}"));
        }
        area += doubled;
        for side in 0..3 {
            edges.push((triangle[side], triangle[(side + 1) % 3]));
        }
    }
    let (right, bottom) = (columns as i64 - 1, rows as i64 - 1);
    for (vertex, pixel) in mesh.pixels.iter().enumerate() {
        if i64::from(pixel[0]) > right || i64::from(pixel[1]) > bottom {
            return fault(format!("vertex {vertex} at {pixel:?} is outside of the image"));
        }
    }
    edges.sort_unstable();
    if let Some(pair) = edges.windows(2).find(|pair| pair[0] == pair[1]) {
        return fault(format!("edge {:?} has two faces on one side", pair[0]));
    }
    let border: Vec<(u32, u32)> =
        edges.iter().copied().filter(|&(a, b)| edges.binary_search(&(b, a)).is_err()).collect();
    let mut length = 0;
    for &(a, b) in &border {
        let [[ac, ar], [bc, br]] = [a, b].map(|v| mesh.pixels[v as usize].map(i64::from));
        // Positive turns: right along the top, down, left, up.
        let along = match () {
            () if ar == 0 && br == 0 => bc - ac,
            () if ac == right && bc == right => br - ar,
            () if ar == bottom && br == bottom => ac - bc,
            () if ac == 0 && bc == 0 => ar - br,
            () => 0,
        };
        if along <= 0 {
            return fault(format!("edge {:?} has a face on one side only", (a, b)));
        }
        length += along;
    }
    if length != 2 * (right + bottom) {
        return fault(format!("the border is {length} pixels long, not {}", 2 * (right + bottom)));
    }
    if area != 2 * right * bottom {
        return fault(format!("the faces cover {area} half pixels, not {}", 2 * right * bottom));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> ImageMesh {
        ImageMesh {
            pixels: vec![[0, 0], [3, 0], [3, 2], [0, 2]],
            depths_m: vec![1.0; 4],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    #[test]
    fn what_is_planar_passes() {
        assert_eq!(check_planar(&square(), 4, 3), Ok(()));
    }

    #[test]
    fn each_fault_is_told() {
        let broken = |change: fn(&mut ImageMesh)| {
            let mut mesh = square();
            change(&mut mesh);
            check_planar(&mesh, 4, 3).expect_err("broken").to_string()
        };
        for (change, words) in [
            (broken(|m| m.triangles[0] = [1, 0, 2]), "wrong way"),
            (broken(|m| m.triangles[0] = [0, 0, 2]), "wrong way"),
            (broken(|m| m.triangles[0] = [0, 1, 9]), "unknown vertex"),
            (broken(|m| m.triangles.truncate(1)), "one side only"),
            (broken(|m| m.triangles.push([0, 1, 2])), "two faces"),
            (broken(|m| m.triangles.clear()), "0 pixels long"),
            (broken(|m| m.pixels[2] = [4, 2]), "outside"),
            (broken(|m| m.depths_m.truncate(3)), "3 depths"),
        ] {
            assert!(change.contains(words), "{change}");
        }
        assert!(check_planar(&square(), 5, 3).is_err());
    }

    #[test]
    fn a_second_sheet_is_told() {
        // Two sheets over the same image, each closed by itself: only the areas tell.
        let mut mesh = square();
        mesh.pixels.extend(mesh.pixels.clone());
        mesh.depths_m.extend([2.0; 4]);
        mesh.triangles.extend([[4, 5, 6], [4, 6, 7]]);
        assert!(check_planar(&mesh, 4, 3).is_err());
    }
}
