//! The signs of a user's first minute.

use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_run::Failure;
use vitriol_shaders::Library;
use vitriol_sim::solver::Census;
use vitriol_sim::world::World;
use vitriol_xr::{PoseFrame, Side};

use crate::first_minute::{FirstMinute, FirstMinuteReport, Handled, Lesson};
use crate::sign::Sign;
use crate::sign::drawing::{MovedBy, Pictogram};
use crate::sign::place::{Stands, spot};

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

    /// Takes in the frame that is shown at `time` (s), and shows what is to be done next. `seen` are head and hands in the scene's
    /// stage, if they are known; `bare` is true of a hand without a controller.
    pub fn update(&mut self, world: &World, seen: Option<&PoseFrame>, bare: [bool; 2], time: f64) {
        let Some(sign) = &mut self.sign else {
            return;
        };
        let handled = handled(world);
        self.minute.update(&handled, time);
        let flasks = stand(world, &self.millilitres);
        let can_pour = flasks.iter().filter(|it| !it.broken).count() > 1;
        let next = self.minute.next(can_pour);
        // It would lie over the stream, and over the flask that is looked at.
        let in_hand = self.minute.flask().and_then(|it| handled.get(it));
        let pours = in_hand.is_some_and(|it| it.held && it.upright < TILTED);
        let waits = self.minute.waits() || pours;
        let (Some(lesson), Some(seen), false) = (next, seen, waits) else {
            sign.hide();
            return;
        };
        let head = seen.stage_from_view.position;
        let hands = seen.hands.each_ref().map(|hand| {
            let known = hand.active && hand.valid;
            known.then_some(hand.stage_from_grip.position)
        });
        let is_full = |flask: &usize| flasks.get(*flask).is_some_and(Stands::can_be_poured);
        let (lesson, of) = match (lesson, self.minute.flask()) {
            // It was let go, and the rest is still to be done.
            (_, None) => (Lesson::Take, None),
            // Nothing is in it, and something in another one: that is to be taken.
            (Lesson::Pour, Some(flask))
                if !is_full(&flask) && flasks.iter().any(Stands::can_be_poured) =>
            {
                (Lesson::Take, None)
            }
            same => same,
        };
        let Some(spot) = spot(lesson, of, self.before, &flasks, head, hands) else {
            sign.hide();
            return;
        };
        self.before = Some(spot.flask);
        let holder = of.and_then(|flask| world.holder(flask)).or(spot.side);
        if let Some(side) = holder.and_then(|side| Side::BOTH.get(side)) {
            self.side = *side;
        }
        let by = match (self.pointer, bare[self.side as usize]) {
            (true, _) => MovedBy::Mouse,
            (false, true) => MovedBy::Fingers,
            (false, false) => MovedBy::Controller,
        };
        let pictogram = Pictogram {
            lesson,
            side: self.side,
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
