//! ROS 2 messages as CDR, little-endian.

use pose::Se3;

use crate::log::{
    CameraMessage, CloudMessage, Content, DepthMessage, Header, OdometryMessage, PoseMessage,
    ScanMessage, Transform,
};

/// The ROS 2 type that a content is written as, `package/Name`; `None` where ROS has none.
pub(crate) fn type_of(content: &Content) -> Option<&'static str> {
    Some(match content {
        Content::Scan(_) => "sensor_msgs/LaserScan",
        Content::Odometry(_) => "nav_msgs/Odometry",
        Content::Transforms(_) => "tf2_msgs/TFMessage",
        Content::Cloud(_) => "sensor_msgs/PointCloud2",
        Content::Depth(_) => "sensor_msgs/Image",
        Content::Camera(_) => "sensor_msgs/CameraInfo",
        Content::Pose(_) => "geometry_msgs/PoseStamped",
        Content::Edge(_) | Content::Standing(_) | Content::Decision(_) => return None,
    })
}

/// The bytes of a message; empty where ROS has no type for it.
pub(crate) fn encode(content: &Content) -> Vec<u8> {
    let mut cdr = Cdr { bytes: vec![0, 1, 0, 0] };
    match content {
        Content::Scan(message) => cdr.scan(message),
        Content::Odometry(message) => cdr.odometry(message),
        Content::Transforms(list) => cdr.transforms(list),
        Content::Cloud(message) => cdr.cloud(message),
        Content::Depth(message) => cdr.depth(message),
        Content::Camera(message) => cdr.camera(message),
        Content::Pose(PoseMessage { header, frame_from_body }) => {
            cdr.header(header);
            cdr.pose(frame_from_body);
        }
        Content::Edge(_) | Content::Standing(_) | Content::Decision(_) => cdr.bytes.clear(),
    }
    cdr.bytes
}

struct Cdr {
    bytes: Vec<u8>,
}

impl Cdr {
    fn align(&mut self, size: usize) {
        // The four bytes before the message do not count, and four are no multiple of eight.
        let length = (self.bytes.len() - 4).next_multiple_of(size) + 4;
        self.bytes.resize(length, 0);
    }

    fn u8(&mut self, value: u8) {
        self.bytes.push(value);
    }

    fn u32(&mut self, value: u32) {
        self.align(4);
        self.bytes.extend(value.to_le_bytes());
    }

    fn f32(&mut self, value: f64) {
        self.align(4);
        self.bytes.extend((value as f32).to_le_bytes());
    }

    fn f64(&mut self, value: f64) {
        self.align(8);
        self.bytes.extend(value.to_le_bytes());
    }

    fn f64s(&mut self, values: &[f64]) {
        values.iter().for_each(|&value| self.f64(value));
    }

    fn text(&mut self, text: &str) {
        self.u32(text.len() as u32 + 1);
        self.bytes.extend_from_slice(text.as_bytes());
        self.u8(0);
    }

    fn header(&mut self, header: &Header) {
        let (secs, nanos) = header.stamp.parts();
        self.u32(secs.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32 as u32);
        self.u32(nanos);
        self.text(&header.frame);
    }

    fn pose(&mut self, pose: &Se3) {
        self.f64s(pose.translation.as_slice());
        self.f64s(pose.rotation.coords.as_slice());
    }

    fn scan(&mut self, message: &ScanMessage) {
        let scan = &message.scan;
        self.header(&message.header);
        self.f32(scan.first_bearing_rad);
        self.f32(scan.first_bearing_rad + scan.span_rad());
        self.f32(scan.bearing_step_rad);
        self.f32(0.0);
        self.f32(0.0);
        self.f32(message.range_min_m);
        self.f32(scan.range_max_m);
        self.u32(scan.len() as u32);
        scan.ranges_m.iter().for_each(|&range_m| self.f32(range_m));
        self.u32(0);
    }

    fn odometry(&mut self, message: &OdometryMessage) {
        self.header(&message.header);
        self.text(&message.child_frame);
        self.pose(&message.odom_from_body);
        self.f64s(&[0.0; 36 + 6 + 36]);
    }

    fn transforms(&mut self, list: &[Transform]) {
        self.u32(list.len() as u32);
        for one in list {
            self.header(&one.header);
            self.text(&one.child_frame);
            self.pose(&one.parent_from_child);
        }
    }

    fn cloud(&mut self, message: &CloudMessage) {
        let cloud = &message.cloud;
        self.header(&message.header);
        self.u32(cloud.rows as u32);
        self.u32(cloud.columns as u32);
        self.u32(3);
        for (at, name) in ["x", "y", "z"].into_iter().enumerate() {
            self.text(name);
            self.u32(at as u32 * 4);
            self.u8(7);
            self.u32(1);
        }
        self.u8(0);
        self.u32(12);
        self.u32(cloud.columns as u32 * 12);
        self.u32(cloud.points_in_sensor.len() as u32 * 12);
        let numbers = cloud.points_in_sensor.iter().flatten();
        self.bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        let dense = cloud.points_in_sensor.iter().flatten().all(|number| number.is_finite());
        self.u8(u8::from(dense));
    }

    fn depth(&mut self, message: &DepthMessage) {
        let pixels = &message.pixels;
        self.header(&message.header);
        self.u32(pixels.rows as u32);
        self.u32(pixels.columns as u32);
        self.text("32FC1");
        self.u8(0);
        self.u32(pixels.columns as u32 * 4);
        self.u32(pixels.depths_m.len() as u32 * 4);
        self.bytes.extend(pixels.depths_m.iter().flat_map(|depth| depth.to_le_bytes()));
    }

    fn camera(&mut self, message: &CameraMessage) {
        let camera = &message.camera;
        self.header(&message.header);
        self.u32(message.rows);
        self.u32(message.columns);
        self.text(&message.distortion_model);
        self.u32(message.distortion.len() as u32);
        self.f64s(&message.distortion);
        self.f64s(&[camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0]);
        self.f64s(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        self.f64s(&[camera.fx, 0.0, camera.cx, 0.0]);
        self.f64s(&[0.0, camera.fy, camera.cy, 0.0]);
        self.f64s(&[0.0, 0.0, 1.0, 0.0]);
        // No binning, the whole image.
        (0..6).for_each(|_| self.u32(0));
        self.u8(0);
    }
}
