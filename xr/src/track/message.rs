//! The Protobuf messages of a track.
//!
//! Each scalar is an `Option` although the schemas declare plain proto3 fields: prost leaves
//! out a plain field that equals its default, and -0.0 equals 0.0, so that the sign of zero
//! would be lost and a replay would not have the recorded bits. A field that is always
//! written reads the same in every decoder.

use prost::Message;

/// `google.protobuf.Timestamp`
#[derive(Clone, PartialEq, Message)]
pub struct Timestamp {
    #[prost(int64, optional, tag = "1")]
    pub seconds: Option<i64>,
    #[prost(int32, optional, tag = "2")]
    pub nanos: Option<i32>,
}

/// `foxglove.Vector3`
#[derive(Clone, PartialEq, Message)]
pub struct Vector3 {
    #[prost(double, optional, tag = "1")]
    pub x: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub y: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub z: Option<f64>,
}

/// `foxglove.Quaternion`
#[derive(Clone, PartialEq, Message)]
pub struct Quaternion {
    #[prost(double, optional, tag = "1")]
    pub x: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub y: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub z: Option<f64>,
    #[prost(double, optional, tag = "4")]
    pub w: Option<f64>,
}

/// `foxglove.FrameTransform`
#[derive(Clone, PartialEq, Message)]
pub struct FrameTransform {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub parent_frame_id: String,
    #[prost(string, tag = "3")]
    pub child_frame_id: String,
    #[prost(message, optional, tag = "4")]
    pub translation: Option<Vector3>,
    #[prost(message, optional, tag = "5")]
    pub rotation: Option<Quaternion>,
}

/// `foxglove.FrameTransforms`
#[derive(Clone, PartialEq, Message)]
pub struct FrameTransforms {
    #[prost(message, repeated, tag = "1")]
    pub transforms: Vec<FrameTransform>,
}

/// `foxglove.Pose`
#[derive(Clone, PartialEq, Message)]
pub struct PoseMessage {
    #[prost(message, optional, tag = "1")]
    pub position: Option<Vector3>,
    #[prost(message, optional, tag = "2")]
    pub orientation: Option<Quaternion>,
}

/// `foxglove.PackedElementField.NumericType`, as far as it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, prost::Enumeration)]
#[repr(i32)]
pub enum FieldType {
    Unknown = 0,
    Uint8 = 1,
    Float32 = 7,
}

/// `foxglove.PackedElementField`
#[derive(Clone, PartialEq, Message)]
pub struct PackedElementField {
    #[prost(string, tag = "1")]
    pub name: String,
    #[prost(fixed32, tag = "2")]
    pub offset: u32,
    #[prost(enumeration = "FieldType", tag = "3")]
    pub kind: i32,
}

/// `foxglove.PointCloud`
#[derive(Clone, PartialEq, Message)]
pub struct PointCloud {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub frame_id: String,
    #[prost(message, optional, tag = "3")]
    pub pose: Option<PoseMessage>,
    #[prost(fixed32, tag = "4")]
    pub point_stride: u32,
    #[prost(message, repeated, tag = "5")]
    pub fields: Vec<PackedElementField>,
    #[prost(bytes = "vec", tag = "6")]
    pub data: Vec<u8>,
}

/// `foxglove.CompressedVideo`
#[derive(Clone, PartialEq, Message)]
pub struct CompressedVideo {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub frame_id: String,
    #[prost(bytes = "vec", tag = "3")]
    pub data: Vec<u8>,
    #[prost(string, tag = "4")]
    pub format: String,
}

/// `vitriol.xr.Input`
#[derive(Clone, PartialEq, Message)]
pub struct Input {
    #[prost(bool, optional, tag = "1")]
    pub active: Option<bool>,
    #[prost(bool, optional, tag = "2")]
    pub valid: Option<bool>,
    #[prost(bool, optional, tag = "3")]
    pub tracked: Option<bool>,
    #[prost(float, optional, tag = "4")]
    pub squeeze: Option<f32>,
    #[prost(float, optional, tag = "5")]
    pub trigger: Option<f32>,
    #[prost(float, optional, tag = "6")]
    pub thumbstick_x: Option<f32>,
    #[prost(float, optional, tag = "7")]
    pub thumbstick_y: Option<f32>,
    #[prost(bool, optional, tag = "8")]
    pub button_a: Option<bool>,
    #[prost(bool, optional, tag = "9")]
    pub button_b: Option<bool>,
    #[prost(string, optional, tag = "10")]
    pub profile: Option<String>,
}

/// `vitriol.xr.Fov`
#[derive(Clone, PartialEq, Message)]
pub struct FovMessage {
    #[prost(float, optional, tag = "1")]
    pub left: Option<f32>,
    #[prost(float, optional, tag = "2")]
    pub right: Option<f32>,
    #[prost(float, optional, tag = "3")]
    pub up: Option<f32>,
    #[prost(float, optional, tag = "4")]
    pub down: Option<f32>,
}

/// `vitriol.xr.Frame`
#[derive(Clone, PartialEq, Message)]
pub struct Frame {
    #[prost(int64, optional, tag = "1")]
    pub xr_time: Option<i64>,
    #[prost(int64, optional, tag = "2")]
    pub period_ns: Option<i64>,
    #[prost(message, repeated, tag = "3")]
    pub fov: Vec<FovMessage>,
    #[prost(enumeration = "crate::SessionState", optional, tag = "4")]
    pub session_state: Option<i32>,
}

/// `vitriol.xr.Switch`
#[derive(Clone, PartialEq, Message)]
pub struct SwitchMessage {
    #[prost(string, optional, tag = "1")]
    pub key: Option<String>,
    #[prost(string, optional, tag = "2")]
    pub value: Option<String>,
}
