//! From frames to messages.

use std::f64::consts::FRAC_1_SQRT_2;

use super::message::{
    FrameTransform, FrameTransforms, Input, Quaternion, SwitchMessage, Timestamp, Vector3,
};
use super::{message, names};
use crate::{Hand, Pose, PoseFrame, Side};

/// All transforms of a frame, for `/tf`.
pub fn transforms(frame: &PoseFrame, stage_from_flasks: &[Pose]) -> FrameTransforms {
    let at = |pose: &Pose, child: &str| transform(frame.time_ns, pose, child);
    let mut transforms = vec![at(&frame.stage_from_view, names::VIEW)];
    for side in Side::BOTH {
        let hand = frame.hand(side);
        transforms.push(at(&hand.stage_from_grip, names::GRIP[side as usize]));
        transforms.push(at(&hand.stage_from_aim, names::AIM[side as usize]));
    }
    transforms.extend(flasks(frame.time_ns, stage_from_flasks));
    FrameTransforms { transforms }
}

/// The transforms of flasks.
pub fn flasks(time_ns: i64, stage_from_flasks: &[Pose]) -> Vec<FrameTransform> {
    let numbered = stage_from_flasks.iter().enumerate();
    numbered
        .map(|(index, flask)| transform(time_ns, flask, &format!("{}{index}", names::FLASK)))
        .collect()
}

/// `world_from_stage`, for `/tf_static`: viewers expect Z up, the stage has Y up. A quarter
/// turn about X takes +Y to +Z.
pub fn world_from_stage(time_ns: i64) -> FrameTransforms {
    let mut root = transform(time_ns, &Pose::IDENTITY, names::STAGE);
    root.parent_frame_id = names::WORLD.into();
    root.rotation = Some(Quaternion {
        x: Some(FRAC_1_SQRT_2),
        y: Some(0.0),
        z: Some(0.0),
        w: Some(FRAC_1_SQRT_2),
    });
    FrameTransforms {
        transforms: vec![root],
    }
}

/// A time of the track.
pub fn timestamp(time_ns: i64) -> Timestamp {
    const NS: i64 = 1_000_000_000;
    Timestamp {
        seconds: Some(time_ns.div_euclid(NS)),
        // Below 10^9, so that it always fits.
        nanos: Some(time_ns.rem_euclid(NS) as i32),
    }
}

fn transform(time_ns: i64, stage_from_child: &Pose, child: &str) -> FrameTransform {
    let p = stage_from_child.position.as_dvec3();
    let q = stage_from_child.orientation.as_dquat();
    FrameTransform {
        timestamp: Some(timestamp(time_ns)),
        parent_frame_id: names::STAGE.into(),
        child_frame_id: child.into(),
        translation: Some(Vector3 {
            x: Some(p.x),
            y: Some(p.y),
            z: Some(p.z),
        }),
        rotation: Some(Quaternion {
            x: Some(q.x),
            y: Some(q.y),
            z: Some(q.z),
            w: Some(q.w),
        }),
    }
}

/// A hand's inputs, for `/xr/input/left` or `/xr/input/right`.
pub fn input(hand: &Hand) -> Input {
    Input {
        active: Some(hand.active),
        valid: Some(hand.valid),
        tracked: Some(hand.tracked),
        squeeze: Some(hand.squeeze),
        trigger: Some(hand.trigger),
        thumbstick_x: Some(hand.thumbstick[0]),
        thumbstick_y: Some(hand.thumbstick[1]),
        button_a: Some(hand.button_a),
        button_b: Some(hand.button_b),
        profile: Some(hand.profile.to_string()),
    }
}

/// The display frame, for `/xr/frame`.
pub fn frame(frame: &PoseFrame) -> message::Frame {
    message::Frame {
        xr_time: Some(frame.info.xr_time),
        period_ns: Some(frame.info.period_ns),
        fov: frame
            .info
            .fov
            .iter()
            .map(|fov| message::FovMessage {
                left: Some(fov.left),
                right: Some(fov.right),
                up: Some(fov.up),
                down: Some(fov.down),
            })
            .collect(),
        session_state: Some(frame.info.session_state as i32),
    }
}

/// One switch, for `/scenario`.
pub fn switch(switch: &crate::Switch) -> SwitchMessage {
    SwitchMessage {
        key: Some(switch.key.clone()),
        value: Some(switch.value.clone()),
    }
}
