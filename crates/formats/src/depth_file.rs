//! Any file that a depth camera's image comes in.

use crate::depth::{self, DepthPixels};
use crate::error::Position;
use crate::{Cloud, FormatError, pcd, pgm, ply_cloud, png, tiff};

/// What a depth file holds.
#[derive(Clone, Debug)]
pub enum DepthFile {
    /// Depths, one per pixel.
    Image(DepthPixels),
    /// Points, one per pixel where the cloud is organised.
    Cloud(Cloud),
}

/// How a depth file is to be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthFileOptions {
    /// Units of the levels or floats of an image per metre; clouds are in metres.
    pub units_per_metre: f64,
    /// Columns and rows of floats without a header.
    pub size: Option<[usize; 2]>,
}

/// Reads a grey PNG of 16 bits, a PGM or TIFF image, a PCD or PLY cloud, told by content; or with a size, floats without
/// a header, told by the extension `raw`, `f32`, `bin` or `dat`.
///
/// # Errors
/// That of the reader; [`FormatError::Unexpected`] for what is none of these.
pub fn read(
    bytes: &[u8],
    extension: Option<&str>,
    options: &DepthFileOptions,
) -> Result<DepthFile, FormatError> {
    let scale = options.units_per_metre;
    let image = |pixels| Ok(DepthFile::Image(pixels));
    match bytes {
        [b'I', b'I', b'*', 0, ..] | [b'M', b'M', 0, b'*', ..] => image(tiff::read(bytes, scale)?),
        _ if bytes.starts_with(b"\x89PNG") => {
            image(depth::from_levels(&png::read_levels(bytes)?, scale)?)
        }
        [b'P', b'2' | b'5', ..] => image(depth::from_levels(&pgm::read(bytes)?, scale)?),
        _ if bytes.starts_with(b"ply") => Ok(DepthFile::Cloud(ply_cloud::read(bytes)?)),
        _ => match (extension.map(str::to_ascii_lowercase).as_deref(), options.size) {
            (Some("raw" | "f32" | "bin" | "dat"), Some([columns, rows])) => {
                image(depth::read_raw(bytes, columns, rows, scale)?)
            }
            (Some("raw" | "f32" | "bin" | "dat"), None) => {
                let found = "floats without a header";
                Err(FormatError::unexpected(Position::Byte(0), found, "their columns and rows"))
            }
            (extension, _) if extension == Some("pcd") || looks_like_pcd(bytes) => {
                Ok(DepthFile::Cloud(pcd::read(bytes)?))
            }
            _ => {
                let found = "no known kind of depth image";
                let expected = "grey PNG of 16 bits, PGM, TIFF, PCD, PLY, or floats as .raw";
                Err(FormatError::unexpected(Position::Byte(0), found, expected))
            }
        },
    }
}

fn looks_like_pcd(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(1024)]);
    let mut lines = head.lines().filter(|line| !line.trim_start().starts_with('#'));
    lines.next().is_some_and(|line| line.starts_with("VERSION") || line.starts_with("FIELDS"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GrayImage;

    #[test]
    fn files_are_told_by_content() {
        let options = DepthFileOptions { units_per_metre: 1000.0, size: None };
        let grey = GrayImage::new(2, 1, 65535, vec![1000, 2000]).expect("fits");
        let shown = |bytes: &[u8], extension, options: &DepthFileOptions| match read(
            bytes, extension, options,
        ) {
            Ok(DepthFile::Image(image)) => format!("{:?}", image.depths_m),
            Ok(DepthFile::Cloud(cloud)) => format!("{:?}", cloud.points_in_sensor),
            Err(error) => error.to_string(),
        };
        assert_eq!(shown(&pgm::write(&grey), None, &options), "[1.0, 2.0]");
        assert_eq!(
            shown(&png::write(&grey).expect("encodes"), Some("pgm"), &options),
            "[1.0, 2.0]"
        );
        let pcd =
            b"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n";
        assert_eq!(shown(pcd, None, &options), "[[1.0, 2.0, 3.0]]");
        let raw = [1500.0_f32, 250.0].map(f32::to_le_bytes).concat();
        let sized = DepthFileOptions { size: Some([1, 2]), ..options };
        assert_eq!(shown(&raw, Some("raw"), &sized), "[1.5, 0.25]");
        assert!(shown(&raw, Some("RAW"), &options).contains("their columns and rows"));
        assert!(shown(b"what", Some("txt"), &options).contains("no known kind"));
    }
}
