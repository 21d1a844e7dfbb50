//! The schemas that a track carries with it, as Protobuf file descriptors.
//!
//! Built in code, because protoc would be one more program to install, for four messages.
//! The layout of `foxglove.*` is that of the schemas published at
//! github.com/foxglove/foxglove-sdk (schemas/proto); viewers go by their exact names.

use prost::Message;
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::{
    DescriptorProto, EnumDescriptorProto, EnumValueDescriptorProto, FieldDescriptorProto,
    FileDescriptorProto, FileDescriptorSet,
};

use crate::SessionState;

/// Full name of the schema of `/tf` and `/tf_static`.
pub const FRAME_TRANSFORMS: &str = "foxglove.FrameTransforms";
/// Full name of the schema of `/particles`.
pub const POINT_CLOUD: &str = "foxglove.PointCloud";
/// Full name of the schema of `/film`.
pub const COMPRESSED_VIDEO: &str = "foxglove.CompressedVideo";
/// Full name of the schema of measurements.
pub const MEASUREMENTS: &str = "vitriol.Measurements";
/// Full name of the schema of `/xr/input/left` and `/xr/input/right`.
pub const INPUT: &str = "vitriol.xr.Input";
/// Full name of the schema of `/xr/frame`.
pub const FRAME: &str = "vitriol.xr.Frame";
/// Full name of the schema of `/scenario`.
pub const SWITCH: &str = "vitriol.xr.Switch";

/// An encoded `FileDescriptorSet` with [`FRAME_TRANSFORMS`] and all that it refers to.
pub fn frame_transforms() -> Vec<u8> {
    let transform = message(
        "FrameTransform",
        vec![
            reference("timestamp", 1, ".google.protobuf.Timestamp"),
            field("parent_frame_id", 2, Type::String),
            field("child_frame_id", 3, Type::String),
            reference("translation", 4, ".foxglove.Vector3"),
            reference("rotation", 5, ".foxglove.Quaternion"),
        ],
    );
    let transforms = message(
        "FrameTransforms",
        vec![repeated("transforms", 1, ".foxglove.FrameTransform")],
    );
    let imports = [
        TIMESTAMP,
        "foxglove/Vector3.proto",
        "foxglove/Quaternion.proto",
    ];
    encoded(vec![
        timestamp(),
        vector(),
        quaternion(),
        foxglove(&imports, transform),
        foxglove(&["foxglove/FrameTransform.proto"], transforms),
    ])
}

/// An encoded `FileDescriptorSet` with [`POINT_CLOUD`] and all that it refers to.
pub fn point_cloud() -> Vec<u8> {
    let pose = message(
        "Pose",
        vec![
            reference("position", 1, ".foxglove.Vector3"),
            reference("orientation", 2, ".foxglove.Quaternion"),
        ],
    );
    let mut kind = reference("type", 3, ".foxglove.PackedElementField.NumericType");
    kind.set_type(Type::Enum);
    let mut packed = message(
        "PackedElementField",
        vec![
            field("name", 1, Type::String),
            field("offset", 2, Type::Fixed32),
            kind,
        ],
    );
    let names = [
        "UNKNOWN", "UINT8", "INT8", "UINT16", "INT16", "UINT32", "INT32", "FLOAT32", "FLOAT64",
    ];
    let names = names.map(str::to_owned);
    packed.enum_type.push(enumeration("NumericType", names));
    let cloud = message(
        "PointCloud",
        vec![
            reference("timestamp", 1, ".google.protobuf.Timestamp"),
            field("frame_id", 2, Type::String),
            reference("pose", 3, ".foxglove.Pose"),
            field("point_stride", 4, Type::Fixed32),
            repeated("fields", 5, ".foxglove.PackedElementField"),
            field("data", 6, Type::Bytes),
        ],
    );
    let imports = [
        TIMESTAMP,
        "foxglove/PackedElementField.proto",
        "foxglove/Pose.proto",
    ];
    let of_pose = ["foxglove/Vector3.proto", "foxglove/Quaternion.proto"];
    encoded(vec![
        timestamp(),
        vector(),
        quaternion(),
        foxglove(&of_pose, pose),
        foxglove(&[], packed),
        foxglove(&imports, cloud),
    ])
}

/// An encoded `FileDescriptorSet` with [`COMPRESSED_VIDEO`] and all that it refers to.
pub fn compressed_video() -> Vec<u8> {
    let video = message(
        "CompressedVideo",
        vec![
            reference("timestamp", 1, ".google.protobuf.Timestamp"),
            field("frame_id", 2, Type::String),
            field("data", 3, Type::Bytes),
            field("format", 4, Type::String),
        ],
    );
    encoded(vec![timestamp(), foxglove(&[TIMESTAMP], video)])
}

/// An encoded `FileDescriptorSet` with [`MEASUREMENTS`], a message of a double for each name.
pub fn measurements(names: &[String]) -> Vec<u8> {
    let fields = alike(names, Type::Double);
    let numbers = message("Measurements", fields);
    let file = file("vitriol/measurements.proto", "vitriol", &[], numbers);
    encoded(vec![file])
}

/// Google's own timestamp.
const TIMESTAMP: &str = "google/protobuf/timestamp.proto";

fn timestamp() -> FileDescriptorProto {
    let fields = vec![
        field("seconds", 1, Type::Int64),
        field("nanos", 2, Type::Int32),
    ];
    file(
        TIMESTAMP,
        "google.protobuf",
        &[],
        message("Timestamp", fields),
    )
}

fn vector() -> FileDescriptorProto {
    let fields = alike(&["x", "y", "z"], Type::Double);
    foxglove(&[], message("Vector3", fields))
}

fn quaternion() -> FileDescriptorProto {
    let fields = alike(&["x", "y", "z", "w"], Type::Double);
    foxglove(&[], message("Quaternion", fields))
}

/// An encoded `FileDescriptorSet` with [`INPUT`], [`FRAME`] and [`SWITCH`].
pub fn xr() -> Vec<u8> {
    let input = message(
        "Input",
        vec![
            field("active", 1, Type::Bool),
            field("valid", 2, Type::Bool),
            field("tracked", 3, Type::Bool),
            field("squeeze", 4, Type::Float),
            field("trigger", 5, Type::Float),
            field("thumbstick_x", 6, Type::Float),
            field("thumbstick_y", 7, Type::Float),
            field("button_a", 8, Type::Bool),
            field("button_b", 9, Type::Bool),
            field("profile", 10, Type::String),
        ],
    );
    let fov = message("Fov", alike(&["left", "right", "up", "down"], Type::Float));
    let mut state = reference("session_state", 4, ".vitriol.xr.SessionState");
    state.set_type(Type::Enum);
    let frame = message(
        "Frame",
        vec![
            field("xr_time", 1, Type::Int64),
            field("period_ns", 2, Type::Int64),
            repeated("fov", 3, ".vitriol.xr.Fov"),
            state,
        ],
    );
    let switch = message("Switch", alike(&["key", "value"], Type::String));
    let mut xr = file("vitriol/xr.proto", "vitriol.xr", &[], input);
    xr.message_type.extend([fov, frame, switch]);
    let states = (0..).map_while(|number| SessionState::try_from(number).ok());
    let states = states.map(|state| format!("{state:?}"));
    xr.enum_type.push(enumeration("SessionState", states));
    encoded(vec![xr])
}

fn encoded(file: Vec<FileDescriptorProto>) -> Vec<u8> {
    FileDescriptorSet { file }.encode_to_vec()
}

/// An enumeration of these values, numbered from 0.
fn enumeration(name: &str, values: impl IntoIterator<Item = String>) -> EnumDescriptorProto {
    let values = (0..).zip(values);
    let values = values.map(|(number, name)| EnumValueDescriptorProto {
        name: Some(name),
        number: Some(number),
        options: None,
    });
    EnumDescriptorProto {
        name: Some(name.into()),
        value: values.collect(),
        ..Default::default()
    }
}

fn file(
    name: &str,
    package: &str,
    imports: &[&str],
    holds: DescriptorProto,
) -> FileDescriptorProto {
    FileDescriptorProto {
        name: Some(name.into()),
        package: Some(package.into()),
        dependency: imports.iter().map(|&import| import.into()).collect(),
        message_type: vec![holds],
        syntax: Some("proto3".into()),
        ..Default::default()
    }
}

/// A file of one message, called like it.
fn foxglove(imports: &[&str], holds: DescriptorProto) -> FileDescriptorProto {
    let name = format!("foxglove/{}.proto", holds.name());
    file(&name, "foxglove", imports, holds)
}

fn message(name: &str, field: Vec<FieldDescriptorProto>) -> DescriptorProto {
    DescriptorProto {
        name: Some(name.into()),
        field,
        ..Default::default()
    }
}

/// Fields of one type, numbered from 1.
fn alike(names: &[impl AsRef<str>], kind: Type) -> Vec<FieldDescriptorProto> {
    (1..)
        .zip(names)
        .map(|(number, name)| field(name.as_ref(), number, kind))
        .collect()
}

fn field(name: &str, number: i32, kind: Type) -> FieldDescriptorProto {
    FieldDescriptorProto {
        name: Some(name.into()),
        number: Some(number),
        label: Some(Label::Optional as i32),
        r#type: Some(kind as i32),
        ..Default::default()
    }
}

fn reference(name: &str, number: i32, type_name: &str) -> FieldDescriptorProto {
    FieldDescriptorProto {
        type_name: Some(type_name.into()),
        ..field(name, number, Type::Message)
    }
}

fn repeated(name: &str, number: i32, type_name: &str) -> FieldDescriptorProto {
    FieldDescriptorProto {
        label: Some(Label::Repeated as i32),
        ..reference(name, number, type_name)
    }
}
