//! Numbers and endings in the names of files.

/// Endings of depth images.
const IMAGES: [&str; 4] = ["png", "pgm", "tif", "tiff"];

/// The name without folder and ending, where it is that of an image.
pub(super) fn image_stem(name: &str) -> Option<&str> {
    let file = name.rsplit('/').next()?;
    let (stem, ending) = file.rsplit_once('.')?;
    IMAGES.iter().any(|known| known.eq_ignore_ascii_case(ending)).then_some(stem)
}

/// The folder of a name, empty for files of the folder itself.
pub(super) fn folder_of(name: &str) -> &str {
    name.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// A whole number without sign.
pub(super) fn number(text: &str) -> Option<u64> {
    let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| text.parse().ok()).flatten()
}
