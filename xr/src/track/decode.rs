//! From messages to frames.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DQuat, DVec3};
use prost::Message;

use super::check::{self, Flaw};
use super::message::{self, FrameTransform, FrameTransforms};
use super::{limits, names};
use crate::{Fov, FrameInfo, Hand, Pose, PoseFrame, SessionState, Side, Switch};

/// The messages of one frame as they come in.
#[derive(Default)]
pub struct Partial {
    transforms: Option<FrameTransforms>,
    inputs: [Option<message::Input>; 2],
    frame: Option<message::Frame>,
    scenario: Vec<Switch>,
}

impl Partial {
    /// Takes in the message `data` of `topic`, which must be one of a track's own.
    pub fn add(&mut self, topic: &str, data: &[u8]) -> Result<(), Flaw> {
        check::at_most(topic, "length of message", data.len(), limits::MESSAGE)?;
        match topic {
            names::TF => once(topic, &mut self.transforms, data),
            names::FRAME => once(topic, &mut self.frame, data),
            names::SCENARIO => {
                let message: message::SwitchMessage = parse(topic, data)?;
                let switch = Switch {
                    key: message.key.unwrap_or_default(),
                    value: message.value.unwrap_or_default(),
                };
                check::switch_texts(&switch.key, &switch.value)?;
                check::at_most(topic, "switches", self.scenario.len() + 1, limits::SWITCHES)?;
                self.scenario.push(switch);
                Ok(())
            }
            _ => {
                let side = usize::from(topic == names::INPUT[Side::Right as usize]);
                once(topic, &mut self.inputs[side], data)
            }
        }
    }

    /// Whether each message is in that a step must have; it may have switches besides.
    pub fn is_complete(&self) -> bool {
        self.transforms.is_some() && self.frame.is_some() && self.inputs.iter().all(Option::is_some)
    }

    /// The frame, and its flasks, once all of its messages are in. `profiles` are those of the frame before,
    /// which most frames share.
    pub fn finish(
        self,
        step: u64,
        time_ns: i64,
        profiles: &mut [Arc<str>; 2],
    ) -> Result<(PoseFrame, Vec<Pose>), Flaw> {
        let transforms = self
            .transforms
            .ok_or_else(|| incomplete(names::TF))?
            .transforms;
        let transforms = by_child(&transforms)?;
        let info = self.frame.ok_or_else(|| incomplete(names::FRAME))?;
        let [left, right] = self.inputs;
        let [of_left, of_right] = profiles;
        let stage_from_view = find(&transforms, names::VIEW)?;
        let frame = PoseFrame {
            step,
            time_ns,
            stage_from_view,
            hands: [
                hand(left, &transforms, Side::Left, of_left)?,
                hand(right, &transforms, Side::Right, of_right)?,
            ],
            scenario: self.scenario,
            info: frame_info(info)?,
        };
        Ok((frame, flasks(&transforms)?))
    }
}

fn once<M: Message + Default>(topic: &str, slot: &mut Option<M>, data: &[u8]) -> Result<(), Flaw> {
    if slot.replace(parse(topic, data)?).is_some() {
        return Err(Flaw::new(
            topic,
            "sequence",
            "is that of another message of this topic",
            "each step has one",
        ));
    }
    Ok(())
}

fn parse<M: Message + Default>(topic: &str, data: &[u8]) -> Result<M, Flaw> {
    M::decode(data).map_err(|error| {
        Flaw::new(
            topic,
            "message",
            format!("does not decode ({error})"),
            "it is a protobuf message of the topic's schema",
        )
    })
}

fn incomplete(topic: &str) -> Flaw {
    Flaw::new(
        topic,
        "message",
        "is missing in this step, or lies apart from its other messages",
        "each step has one, and a step's messages follow one another: sort the file by log time",
    )
}

fn hand(
    input: Option<message::Input>,
    transforms: &ByChild<'_>,
    side: Side,
    profile: &mut Arc<str>,
) -> Result<Hand, Flaw> {
    let input = input.ok_or_else(|| incomplete(names::INPUT[side as usize]))?;
    if **profile != *input.profile() {
        *profile = Arc::from(input.profile());
    }
    Ok(Hand {
        active: input.active(),
        valid: input.valid(),
        tracked: input.tracked(),
        stage_from_grip: find(transforms, names::GRIP[side as usize])?,
        stage_from_aim: find(transforms, names::AIM[side as usize])?,
        squeeze: input.squeeze(),
        trigger: input.trigger(),
        thumbstick: [input.thumbstick_x(), input.thumbstick_y()],
        button_a: input.button_a(),
        button_b: input.button_b(),
        profile: Arc::clone(profile),
    })
}

fn frame_info(frame: message::Frame) -> Result<FrameInfo, Flaw> {
    let views = frame.fov.len();
    let fov = <&[message::FovMessage; 2]>::try_from(&frame.fov[..]).map_err(|_| {
        Flaw::new(
            names::FRAME,
            "fov",
            format!("has {views} views"),
            "it has two, the left and the right eye's",
        )
    })?;
    let number = frame.session_state.unwrap_or_default();
    let session_state = SessionState::try_from(number).map_err(|_| {
        Flaw::new(
            names::FRAME,
            "session_state",
            format!("is {number}"),
            "it is one of OpenXR's session states, 0 to 8",
        )
    })?;
    Ok(FrameInfo {
        xr_time: frame.xr_time(),
        period_ns: frame.period_ns(),
        fov: fov.each_ref().map(|fov| Fov {
            left: fov.left(),
            right: fov.right(),
            up: fov.up(),
            down: fov.down(),
        }),
        session_state,
    })
}

/// A frame's own transforms by the name of the child frame.
type ByChild<'a> = BTreeMap<&'a str, &'a FrameTransform>;

fn by_child(transforms: &[FrameTransform]) -> Result<ByChild<'_>, Flaw> {
    check::at_most(
        names::TF,
        "transforms",
        transforms.len(),
        limits::TRANSFORMS,
    )?;
    let mut by_child = ByChild::new();
    for transform in transforms {
        let child = transform.child_frame_id.as_str();
        let before = by_child.insert(child, transform);
        if before.is_some() && is_ours(child) {
            return Err(Flaw::new(
                names::TF,
                child,
                "is there twice",
                "each frame has one transform a step",
            ));
        }
    }
    Ok(by_child)
}

/// Whether a transform of this name is one of a track's, which other programs must not use.
fn is_ours(child: &str) -> bool {
    let hands = names::GRIP.iter().chain(&names::AIM);
    child == names::VIEW
        || child.starts_with(names::FLASK)
        || hands.into_iter().any(|&hand| hand == child)
}

/// All `flask_N`, in the order of N.
fn flasks(transforms: &ByChild<'_>) -> Result<Vec<Pose>, Flaw> {
    let named = transforms
        .keys()
        .filter(|child| child.starts_with(names::FLASK));
    (0..named.count())
        .map(|index| find(transforms, &format!("{}{index}", names::FLASK)))
        .collect()
}

fn find(transforms: &ByChild<'_>, child: &str) -> Result<Pose, Flaw> {
    let Some(transform) = transforms.get(child) else {
        return Err(Flaw::new(
            names::TF,
            child,
            "is missing",
            "each step has a transform of view, of both hands' grip and aim, and of flasks \
             numbered from 0 without gap",
        ));
    };
    if transform.parent_frame_id != names::STAGE {
        return Err(Flaw::new(
            names::TF,
            format!("{child}.parent_frame_id"),
            format!("is `{}`", transform.parent_frame_id),
            "poses are relative to `stage`",
        ));
    }
    pose(transform, child)
}

/// A message left out means its default, all zero; a rotation of zero is refused by the check
/// of the frame.
fn pose(transform: &FrameTransform, child: &str) -> Result<Pose, Flaw> {
    let p = transform.translation.clone().unwrap_or_default();
    let q = transform.rotation.clone().unwrap_or_default();
    let position = DVec3::new(p.x(), p.y(), p.z());
    let orientation = DQuat::from_xyzw(q.x(), q.y(), q.z(), q.w());
    let narrowed = Pose::new(position.as_vec3(), orientation.as_quat());
    if position.is_finite() && !narrowed.position.is_finite() {
        return Err(Flaw::new(
            names::TF,
            format!("{child}.translation"),
            format!("is {position}"),
            "a position is finite in 32 bits, in metres",
        ));
    }
    Ok(narrowed)
}
