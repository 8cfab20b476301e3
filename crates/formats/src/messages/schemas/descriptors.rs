//! Definitions of protocol buffers: Foxglove's schemas and this project's own, as descriptors.
//!
//! A recording holds the descriptor of its messages, which a compiler mostly makes from `.proto`
//! files. Here it is made from the table below, so that the build needs none.

use crate::messages::proto::Writer;

/// The type of a field.
#[derive(Clone, Copy)]
enum Kind {
    Double,
    Int64,
    Int32,
    Uint32,
    Bool,
    Text,
    Bytes,
    /// An enumeration inside the message itself.
    Enum(&'static str),
    /// A message, with its package.
    Message(&'static str),
    /// A list of doubles.
    Doubles,
    /// A list of `fixed32`.
    Fixed32s,
    /// A list of messages.
    Messages(&'static str),
}

/// A message: its name, its enumeration if it has one, its fields by number.
type Type = (
    &'static str,
    Option<(&'static str, &'static [&'static str])>,
    &'static [(u32, &'static str, Kind)],
);

use Kind::{
    Bool, Bytes, Double, Doubles, Enum, Fixed32s, Int32, Int64, Message, Messages, Text, Uint32,
};

const TYPES: &[Type] = &[
    ("google.protobuf.Timestamp", None, &[(1, "seconds", Int64), (2, "nanos", Int32)]),
    ("google.protobuf.Duration", None, &[(1, "seconds", Int64), (2, "nanos", Int32)]),
    (
        "driftlab.Pose2",
        None,
        &[(1, "x", Double), (2, "y", Double), (3, "cos", Double), (4, "sin", Double)],
    ),
    (
        "driftlab.Edge",
        None,
        &[
            (1, "timestamp", Message("google.protobuf.Timestamp")),
            (2, "a", Uint32),
            (3, "b", Uint32),
            (4, "place", Bool),
            (5, "a_from_b", Message("driftlab.Pose2")),
        ],
    ),
    (
        "driftlab.Standing",
        None,
        &[
            (1, "timestamp", Message("google.protobuf.Timestamp")),
            (2, "vertex", Uint32),
            (3, "vertex_from_body", Message("driftlab.Pose2")),
        ],
    ),
    ("driftlab.Point2", None, &[(1, "x", Double), (2, "y", Double)]),
    (
        "driftlab.Decision",
        None,
        &[
            (1, "timestamp", Message("google.protobuf.Timestamp")),
            (2, "map", Text),
            (3, "vertex", Uint32),
            (4, "vertex_from_body", Message("driftlab.Pose2")),
            (5, "goal_in_body", Message("driftlab.Point2")),
            (6, "radius", Double),
            (7, "everywhere", Bool),
            (8, "looked_again", Bool),
        ],
    ),
    ("foxglove.Vector3", None, &[(1, "x", Double), (2, "y", Double), (3, "z", Double)]),
    (
        "foxglove.Quaternion",
        None,
        &[(1, "x", Double), (2, "y", Double), (3, "z", Double), (4, "w", Double)],
    ),
    ("foxglove.Point3", None, &[(1, "x", Double), (2, "y", Double), (3, "z", Double)]),
    (
        "foxglove.Pose",
        None,
        &[
            (1, "position", Message("foxglove.Vector3")),
            (2, "orientation", Message("foxglove.Quaternion")),
        ],
    ),
    (
        "foxglove.Color",
        None,
        &[(1, "r", Double), (2, "g", Double), (3, "b", Double), (4, "a", Double)],
    ),
    ("foxglove.KeyValuePair", None, &[(1, "key", Text), (2, "value", Text)]),
    (
        "foxglove.LaserScan",
        None,
        &[
            (1, "timestamp", Message("google.protobuf.Timestamp")),
            (2, "frame_id", Text),
            (3, "pose", Message("foxglove.Pose")),
            (4, "start_angle", Double),
            (5, "end_angle", Double),
            (6, "ranges", Doubles),
            (7, "intensities", Doubles),
        ],
    ),
    (
        "foxglove.SceneEntityDeletion",
        Some(("Type", &["MATCHING_ID", "ALL"])),
        &[
            (1, "timestamp", Message("google.protobuf.Timestamp")),
            (2, "type", Enum("Type")),
            (3, "id", Text),
        ],
    ),
    (
        "foxglove.ArrowPrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "shaft_length", Double),
            (3, "shaft_diameter", Double),
            (4, "head_length", Double),
            (5, "head_diameter", Double),
            (6, "color", Message("foxglove.Color")),
        ],
    ),
    (
        "foxglove.CubePrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "size", Message("foxglove.Vector3")),
            (3, "color", Message("foxglove.Color")),
        ],
    ),
    (
        "foxglove.SpherePrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "size", Message("foxglove.Vector3")),
            (3, "color", Message("foxglove.Color")),
        ],
    ),
    (
        "foxglove.CylinderPrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "size", Message("foxglove.Vector3")),
            (3, "bottom_scale", Double),
            (4, "top_scale", Double),
            (5, "color", Message("foxglove.Color")),
        ],
    ),
    (
        "foxglove.LinePrimitive",
        Some(("Type", &["LINE_STRIP", "LINE_LOOP", "LINE_LIST"])),
        &[
            (1, "type", Enum("Type")),
            (2, "pose", Message("foxglove.Pose")),
            (3, "thickness", Double),
            (4, "scale_invariant", Bool),
            (5, "points", Messages("foxglove.Point3")),
            (6, "color", Message("foxglove.Color")),
            (7, "colors", Messages("foxglove.Color")),
            (8, "indices", Fixed32s),
        ],
    ),
    (
        "foxglove.TriangleListPrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "points", Messages("foxglove.Point3")),
            (3, "color", Message("foxglove.Color")),
            (4, "colors", Messages("foxglove.Color")),
            (5, "indices", Fixed32s),
        ],
    ),
    (
        "foxglove.TextPrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "billboard", Bool),
            (3, "font_size", Double),
            (4, "scale_invariant", Bool),
            (5, "color", Message("foxglove.Color")),
            (6, "text", Text),
        ],
    ),
    (
        "foxglove.ModelPrimitive",
        None,
        &[
            (1, "pose", Message("foxglove.Pose")),
            (2, "scale", Message("foxglove.Vector3")),
            (3, "color", Message("foxglove.Color")),
            (4, "override_color", Bool),
            (5, "url", Text),
            (6, "media_type", Text),
            (7, "data", Bytes),
        ],
    ),
    (
        "foxglove.SceneEntity",
        None,
        &[
            (1, "timestamp", Message("google.protobuf.Timestamp")),
            (2, "frame_id", Text),
            (3, "id", Text),
            (4, "lifetime", Message("google.protobuf.Duration")),
            (5, "frame_locked", Bool),
            (6, "metadata", Messages("foxglove.KeyValuePair")),
            (7, "arrows", Messages("foxglove.ArrowPrimitive")),
            (8, "cubes", Messages("foxglove.CubePrimitive")),
            (9, "spheres", Messages("foxglove.SpherePrimitive")),
            (10, "cylinders", Messages("foxglove.CylinderPrimitive")),
            (11, "lines", Messages("foxglove.LinePrimitive")),
            (12, "triangles", Messages("foxglove.TriangleListPrimitive")),
            (13, "texts", Messages("foxglove.TextPrimitive")),
            (14, "models", Messages("foxglove.ModelPrimitive")),
        ],
    ),
    (
        "foxglove.SceneUpdate",
        None,
        &[
            (1, "deletions", Messages("foxglove.SceneEntityDeletion")),
            (2, "entities", Messages("foxglove.SceneEntity")),
        ],
    ),
];

/// The set of files that describes a message and all that it needs; empty for unknown names.
pub(crate) fn descriptor_set(name: &str) -> Vec<u8> {
    let mut wanted: Vec<&Type> = TYPES.iter().filter(|kind| kind.0 == name).collect();
    let mut next = 0;
    while let Some(kind) = wanted.get(next).copied() {
        for needed in needs(kind) {
            // What is needed moves behind what needs it.
            wanted.retain(|known| known.0 != needed);
            wanted.extend(TYPES.iter().filter(|kind| kind.0 == needed));
        }
        next = wanted.iter().position(|known| known.0 == kind.0).map_or(next, |at| at + 1);
    }
    let mut set = Writer::default();
    for kind in wanted.iter().rev() {
        set.message(1, |file| write_file(file, kind));
    }
    set.bytes
}

/// The messages that stand in fields of this one, each once.
fn needs(kind: &Type) -> Vec<&'static str> {
    let mut needs = Vec::new();
    for (_, _, kind) in kind.2 {
        if let Message(name) | Messages(name) = kind
            && !needs.contains(name)
        {
            needs.push(*name);
        }
    }
    needs
}

fn file_name(name: &str) -> String {
    match name.rsplit_once('.') {
        Some(("google.protobuf", name)) => {
            format!("google/protobuf/{}.proto", name.to_lowercase())
        }
        _ => format!("{}.proto", name.replace('.', "/")),
    }
}

/// The fields of `google.protobuf.FileDescriptorProto`.
fn write_file(file: &mut Writer, kind: &Type) {
    let (package, name) = kind.0.rsplit_once('.').unwrap_or(("", kind.0));
    file.text(1, &file_name(kind.0)).text(2, package);
    for needed in needs(kind) {
        file.text(3, &file_name(needed));
    }
    file.message(4, |message| {
        message.text(1, name);
        for field in kind.2 {
            message.message(2, |writer| write_field(writer, field, kind.0));
        }
        if let Some((name, values)) = kind.1 {
            message.message(4, |writer| {
                writer.text(1, name);
                for (number, value) in values.iter().enumerate() {
                    let number = number as u64;
                    writer.message(2, |writer| _ = writer.text(1, value).varint(2, number));
                }
            });
        }
    });
    file.text(12, "proto3");
}

/// The fields of `google.protobuf.FieldDescriptorProto`.
fn write_field(writer: &mut Writer, field: &(u32, &str, Kind), of: &str) {
    let (number, name, kind) = *field;
    let (repeated, code, named) = match kind {
        Double => (false, 1, None),
        Int64 => (false, 3, None),
        Int32 => (false, 5, None),
        Bool => (false, 8, None),
        Text => (false, 9, None),
        Message(name) => (false, 11, Some(format!(".{name}"))),
        Bytes => (false, 12, None),
        Uint32 => (false, 13, None),
        Enum(name) => (false, 14, Some(format!(".{of}.{name}"))),
        Doubles => (true, 1, None),
        Fixed32s => (true, 7, None),
        Messages(name) => (true, 11, Some(format!(".{name}"))),
    };
    let label = if repeated { 3 } else { 1 };
    writer.text(1, name).varint(3, u64::from(number)).varint(4, label).varint(5, code);
    if let Some(named) = named {
        writer.text(6, &named);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::proto::Fields;

    /// Names of the files of a set, in their order, and what each imports.
    fn files(set: &[u8]) -> Vec<(String, Vec<String>)> {
        let mut files = Vec::new();
        let mut fields = Fields::new(set);
        while let Some(field) = fields.next_field().expect("well formed") {
            let mut file = field.message().expect("a message");
            let (mut name, mut imports) = (String::new(), Vec::new());
            while let Some(part) = file.next_field().expect("well formed") {
                match part.number {
                    1 => name = part.text().expect("a text").to_owned(),
                    3 => imports.push(part.text().expect("a text").to_owned()),
                    _ => {}
                }
            }
            files.push((name, imports));
        }
        files
    }

    #[test]
    fn files_stand_behind_what_they_import() {
        for (name, _, _) in TYPES {
            let files = files(&descriptor_set(name));
            for (at, (file, imports)) in files.iter().enumerate() {
                for import in imports {
                    assert!(
                        files[..at].iter().any(|(known, _)| known == import),
                        "{file}: {import}"
                    );
                }
                assert!(files[..at].iter().all(|(known, _)| known != file), "{file} twice");
            }
            assert_eq!(files.last().map(|(name, _)| name), Some(&file_name(name)));
        }
        assert!(descriptor_set("foxglove.None").is_empty());
        assert_eq!(files(&descriptor_set("foxglove.SceneUpdate")).len(), 19);
    }
}
