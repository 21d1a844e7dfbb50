//! The signs of a user's first minute.

use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_run::Failure;
use vitriol_shaders::Library;
use vitriol_sim::scene::ToolKind;
use vitriol_sim::solver::Census;
use vitriol_sim::world::World;
use vitriol_xr::{PoseFrame, Side};

use crate::first_minute::{FirstMinute, FirstMinuteReport, Handled, Lesson};
use crate::sign::Sign;
use crate::sign::asked::Asked;
use crate::sign::drawing::{MovedBy, Pictogram};
use crate::sign::place::{Stands, Target, beside_pour, spot};

/// Cosine of the tilt from which on a held flask pours, and no sign is shown: 45°. A beaker of 250 mL that is filled to two thirds pours
/// from there on.
const TILTED: f32 = 0.707;

/// Shows a first user the next action as a sign, until each has been done once.
pub(super) struct Hints {
    minute: FirstMinute,
    /// What is shown; `None` where no hints are wanted.
    pub sign: Option<Sign>,
    /// Whether another press lets go of what a controller or a mouse holds.
    toggles: bool,
    /// Whether a mouse moves the hands.
    pointer: bool,
    /// Volume of the liquid in each flask at the last observation, mL.
    millilitres: Vec<f64>,
    /// The flask that the sign was at.
    before: Option<usize>,
    /// The hand that the sign was for.
    side: Side,
}

impl Hints {
    /// The hints of a session; none are shown unless they are `wanted`. `pointer` is true where a mouse moves the hands.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(
        wanted: bool,
        (toggles, pointer): (bool, bool),
        gpu: &Gpu,
        library: &Library,
    ) -> Result<Self, Failure> {
        let sign = wanted.then(|| Sign::new(gpu, library)).transpose()?;
        Ok(Self {
            minute: FirstMinute::default(),
            sign,
            toggles,
            pointer,
            millilitres: Vec::new(),
            before: None,
            side: Side::Right,
        })
    }

    /// Goes on with another device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn move_to(&mut self, gpu: &Gpu, library: &Library) -> Result<(), Failure> {
        if let Some(sign) = &mut self.sign {
            *sign = Sign::new(gpu, library)?;
        }
        Ok(())
    }

    /// Another bench, or this one anew.
    pub fn begin(&mut self) {
        self.minute.begin();
        self.millilitres.clear();
        self.before = None;
    }

    /// Takes in an observation, in the frame that is shown at `time` (s).
    pub fn looked(&mut self, world: &World, census: &Census, time: f64) {
        let real = 1e6 * world.scene().scale.length_scale.powi(3);
        let volumes = census.flasks.iter().map(|held| real * held.volume);
        self.millilitres = volumes.collect();
        self.minute.looked(&self.millilitres, time);
    }

    /// Takes in the frame that is shown at `time` (s), and shows what is to be done next of what is `asked`. `seen` are head and hands in
    /// the scene's stage, if they are known; `bare` is true of a hand without a controller.
    pub fn update(
        &mut self,
        (world, asked): (&World, Asked),
        seen: Option<&PoseFrame>,
        bare: [bool; 2],
        time: f64,
    ) {
        let Some(sign) = &mut self.sign else {
            return;
        };
        let handled = handled(world);
        self.minute.update(&handled, time);
        let flasks = stand(world, &self.millilitres);
        let next = asked.sign(&self.minute, &flasks, |kind| tool(world, kind));
        // It would lie over the stream, and over the flask that is looked at.
        let in_hand = self.minute.flask().and_then(|it| handled.get(it));
        let pours = in_hand.is_some_and(|it| it.held && it.upright < TILTED);
        let waits = self.minute.waits() || pours;
        let (Some((lesson, target)), Some(seen), false) = (next, seen, waits) else {
            sign.hide();
            return;
        };
        let head = seen.stage_from_view.position;
        let hands = seen.hands.each_ref().map(|hand| {
            let known = hand.active && hand.valid;
            known.then_some(hand.stage_from_grip.position)
        });
        let Some(spot) = spot(target, self.before, &flasks, head, hands) else {
            sign.hide();
            return;
        };
        self.before = spot.flask;
        let holder = match (lesson, target) {
            (Lesson::Take, _) | (_, Target::Any | Target::Thing(_)) => spot.side,
            (_, Target::Flask(flask) | Target::Into { from: flask, .. }) => world.holder(flask),
        };
        if let Some(side) = holder.and_then(|side| Side::BOTH.get(side)) {
            self.side = *side;
        }
        let mut side = self.side;
        if let (true, Target::Into { from, .. }) = (self.pointer, target)
            && let (Some(from), Some(into)) =
                (flasks.get(from), spot.flask.and_then(|it| flasks.get(it)))
        {
            // A mouse tilts to either side, whichever hand holds the flask.
            let right = seen.stage_from_view.orientation * Vec3::X;
            side = beside_pour(from, into, right);
        }
        let by = match (self.pointer, bare[self.side as usize]) {
            (true, _) => MovedBy::Mouse,
            (false, true) => MovedBy::Fingers,
            (false, false) => MovedBy::Controller,
        };
        let pictogram = Pictogram {
            lesson,
            tool: match (asked, target) {
                (Asked::Tool(kind), Target::Thing(_)) => Some(kind),
                _ => None,
            },
            side,
            by,
            toggles: self.toggles,
            step: 0,
        };
        sign.show(pictogram, spot.middle, head, time);
    }

    /// What was done, and when; `None` where nothing was to be shown.
    pub fn report(&self) -> Option<FirstMinuteReport> {
        self.sign.is_some().then(|| self.minute.report())
    }
}

/// The flasks as hands have them; real metres.
fn handled(world: &World) -> Vec<Handled> {
    let scale = world.scene().scale.length_scale as f32;
    let poses = world.poses().iter().enumerate();
    poses
        .map(|(flask, pose)| Handled {
            held: world.holder(flask).is_some(),
            height: scale * pose.position.y,
            upright: (pose.orientation * Vec3::Y).y,
            broken: world.is_broken(flask),
        })
        .collect()
}

/// A tool that no hand holds, as a sign is put over it; real metres.
fn tool(world: &World, kind: ToolKind) -> Option<Stands> {
    let scene = world.scene();
    let index = scene.tools.iter().position(|tool| tool.kind == kind)?;
    let pose = world.tools().get(index)?;
    if world.tool_holder(index).is_some() {
        return None;
    }
    let height = kind.cylinder()[1] as f32;
    let scale = scene.scale.length_scale as f32;
    Some(Stands {
        middle: scale * pose.position + 0.5 * height * (pose.orientation * Vec3::Y),
        height,
        millilitres: 0.0,
        can_be_taken: true,
        broken: false,
    })
}

/// The flasks as signs are put over them; real metres.
fn stand(world: &World, millilitres: &[f64]) -> Vec<Stands> {
    let scene = world.scene();
    let scale = scene.scale.length_scale as f32;
    let flasks = scene.flasks.iter().zip(world.poses()).enumerate();
    flasks
        .map(|(index, (flask, pose))| {
            let height = scale * flask.profile.rim_height() as f32;
            let axis = pose.orientation * Vec3::Y;
            Stands {
                middle: scale * pose.position + 0.5 * height * axis,
                height,
                millilitres: millilitres.get(index).copied().unwrap_or(0.0),
                can_be_taken: !flask.fixed && !world.is_broken(index),
                broken: world.is_broken(index),
            }
        })
        .collect()
}
