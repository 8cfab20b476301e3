//! A depth image made ready: cropped, its invalid values told, its gaps filled.
//!
//! | file | stage |
//! |---|---|
//! | `prepare.rs` | crop, invalid values, missing data at the far distance (\[Mos15\] 5.4, eq. 5.1) |
//! | `cloud.rs` | organised clouds: duplicates (\[Mos15\] 5.4.1), the camera that took them |

mod cloud;
mod prepare;

pub use cloud::{CloudOptions, Duplicates, Fitted, depth_image_of, fit_camera};
pub use prepare::{
    FARTHEST_M, FilledImage, LARGEST_SIDE, NEAREST_M, Pixel, PrepareOptions, prepare,
};
