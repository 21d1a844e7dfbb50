//! Requirements of a frame, checked alike by writer and reader.

use std::path::Path;

use crate::{Fov, Hand, Pose, PoseFrame, Side};

use super::{TrackError, limits, names, seconds};

/// One thing that is wrong with a frame.
#[derive(Debug)]
pub struct Flaw {
    /// Topic of the message that holds it.
    pub topic: String,
    /// The field, named as in the file.
    pub field: String,
    /// What is wrong.
    pub problem: String,
    /// What would be right.
    pub expected: String,
}

impl Flaw {
    /// A flaw of `field` in `topic`.
    pub fn new(
        topic: impl Into<String>,
        field: impl Into<String>,
        problem: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            topic: topic.into(),
            field: field.into(),
            problem: problem.into(),
            expected: expected.into(),
        }
    }
}

/// Checks one frame and its flasks, and that it follows `before` (step, time in ns).
pub fn frame(
    frame: &PoseFrame,
    stage_from_flasks: &[Pose],
    before: Option<(u64, i64)>,
) -> Result<(), Flaw> {
    order(frame, before)?;
    pose(&frame.stage_from_view, names::VIEW)?;
    for side in Side::BOTH {
        hand(frame.hand(side), side)?;
    }
    for (index, flask) in stage_from_flasks.iter().enumerate() {
        pose(flask, &format!("{}{index}", names::FLASK))?;
    }
    for (view, fov) in frame.info.fov.iter().enumerate() {
        field_of_view(fov, view)?;
    }
    at_most(
        names::TF,
        names::FLASK,
        stage_from_flasks.len(),
        limits::FLASKS,
    )?;
    for switch in &frame.scenario {
        switch_texts(&switch.key, &switch.value)?;
    }
    for side in Side::BOTH {
        let length = frame.hand(side).profile.len();
        at_most(
            names::INPUT[side as usize],
            "length of profile",
            length,
            limits::TEXT,
        )?;
    }
    if frame.scenario.iter().any(|switch| switch.key.is_empty()) {
        return Err(Flaw::new(
            names::SCENARIO,
            "key",
            "is empty",
            "a switch names what it switches",
        ));
    }
    Ok(())
}

fn order(frame: &PoseFrame, before: Option<(u64, i64)>) -> Result<(), Flaw> {
    let refused = |field: &str, problem: String, expected: &str| {
        Err(Flaw::new(names::FRAME, field, problem, expected))
    };
    if u32::try_from(frame.step).is_err() {
        let expected = "an MCAP sequence number has 32 bits";
        return refused("sequence", "is above 4294967295".into(), expected);
    }
    let time = frame.time_ns;
    if time < 0 {
        let problem = "is negative or beyond 292 years".into();
        let expected = "a track's clock is the simulation's, which starts at 0";
        return refused("log_time", problem, expected);
    }
    if time > limits::SECONDS * 1_000_000_000 {
        let expected = format!("a track ends after {} s at most", limits::SECONDS);
        return refused("log_time", format!("is {} s", seconds(time)), &expected);
    }
    let Some((step, time_ns)) = before else {
        return start(frame);
    };
    let now = frame.step;
    if now <= step {
        let expected =
            "each frame has a higher step than the one before: sort the file by log time";
        return refused("sequence", format!("goes from {step} to {now}"), expected);
    }
    if time <= time_ns {
        let problem = match time == time_ns {
            true => format!("is {time_ns} ns in two frames, of steps {step} and {now}"),
            false => format!("goes backwards, from {time_ns} ns to {time} ns"),
        };
        return refused(
            "log_time",
            problem,
            "each frame is later than the one before",
        );
    }
    Ok(())
}

/// Checks that a whole track begins at 0, where the simulation does. A later one was shifted by another program: its first pose would be
/// held until then, and all would come too late. It is not shifted back here, since the file's other topics have the same clock. Where
/// the first step is above 0, steps before it are missing; only a replay refuses that.
fn start(frame: &PoseFrame) -> Result<(), Flaw> {
    if frame.step > 0 || frame.time_ns == 0 {
        return Ok(());
    }
    let late = frame.time_ns;
    Err(Flaw::new(
        names::FRAME,
        "log_time",
        format!("of step 0 is {} s", seconds(late)),
        format!(
            "a track's step 0 is at 0 s: subtract {late} ns from each time in the file, or take the original"
        ),
    ))
}

fn pose(pose: &Pose, child: &str) -> Result<(), Flaw> {
    if pose.is_valid() {
        return Ok(());
    }
    let Pose {
        position,
        orientation,
    } = pose;
    let flaw = |field: &str, problem, expected| {
        Flaw::new(names::TF, format!("{child}.{field}"), problem, expected)
    };
    Err(if !position.is_finite() {
        flaw(
            "translation",
            format!("is {position}"),
            "a position is finite, in metres",
        )
    } else if !orientation.is_finite() {
        flaw(
            "rotation",
            format!("is {orientation}"),
            "an orientation is a finite unit quaternion",
        )
    } else {
        flaw(
            "rotation",
            format!("{orientation} has length {}", orientation.length()),
            "an orientation has length 1 within 0.001",
        )
    })
}

fn hand(hand: &Hand, side: Side) -> Result<(), Flaw> {
    pose(&hand.stage_from_grip, names::GRIP[side as usize])?;
    pose(&hand.stage_from_aim, names::AIM[side as usize])?;
    let values = [
        ("squeeze", hand.squeeze, 0.0),
        ("trigger", hand.trigger, 0.0),
        ("thumbstick_x", hand.thumbstick[0], -1.0),
        ("thumbstick_y", hand.thumbstick[1], -1.0),
    ];
    for (field, value, low) in values {
        if !(low..=1.0).contains(&value) {
            return Err(Flaw::new(
                names::INPUT[side as usize],
                field,
                format!("is {value}"),
                format!("it lies between {low} and 1"),
            ));
        }
    }
    Ok(())
}

fn field_of_view(fov: &Fov, view: usize) -> Result<(), Flaw> {
    use std::f32::consts::FRAC_PI_2;
    for (side, angle) in [
        ("left", fov.left),
        ("right", fov.right),
        ("up", fov.up),
        ("down", fov.down),
    ] {
        if !(-FRAC_PI_2..=FRAC_PI_2).contains(&angle) {
            return Err(Flaw::new(
                names::FRAME,
                format!("fov[{view}].{side}"),
                format!("is {angle}"),
                "an angle of view lies between -pi/2 and pi/2",
            ));
        }
    }
    Ok(())
}

/// Checks that there are at most `most`.
pub fn at_most(topic: &str, field: &str, count: usize, most: usize) -> Result<(), Flaw> {
    if count <= most {
        return Ok(());
    }
    Err(Flaw::new(
        topic,
        field,
        format!("has {count}"),
        format!("at most {most} are read"),
    ))
}

/// Checks that a switch's texts are short.
pub fn switch_texts(key: &str, value: &str) -> Result<(), Flaw> {
    at_most(names::SCENARIO, "length of key", key.len(), limits::TEXT)?;
    at_most(
        names::SCENARIO,
        "length of value",
        value.len(),
        limits::TEXT,
    )
}

/// Checks that a track has few enough switches and frames.
pub fn totals(switches: usize, frames: usize) -> Result<(), Flaw> {
    at_most(names::SCENARIO, "switches", switches, limits::SWITCHES)?;
    at_most(names::FRAME, "frames", frames, limits::FRAMES)
}

/// Checks that a writer's messages stay below the reader's limit, indices and all.
pub fn unpacked(bytes: u64) -> Result<(), Flaw> {
    let megabytes = |bytes: u64| (bytes >> 20) as usize;
    let (count, most) = (megabytes(bytes), megabytes(limits::RECORDS / 2));
    at_most(names::FRAME, "megabytes before it", count, most)
}

/// The flaw of a frame as an error of a file.
pub fn at(file: &Path, flaw: Flaw, step: u64, time_ns: i64) -> TrackError {
    TrackError::Message {
        file: file.into(),
        place: format!("{}, step {step} at {} s", flaw.topic, seconds(time_ns)),
        field: flaw.field,
        problem: flaw.problem,
        expected: flaw.expected,
    }
}
