//! Observations of the liquid, one behind each step, and the events that are found in them.
//!
//! An observation uses the inputs of its step and nothing that a recording does not keep, so a replay finds what the session found.

use std::collections::VecDeque;

use vitriol_gpu::{QueueKind, Ticket};
use vitriol_lesson::{Dipped, Event, Finder, Limits, Seen, Sight, Stream};
use vitriol_render::Bone;
use vitriol_sim::bodies::{Break, Strike, Worn};
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::Census;
use vitriol_sim::world::{Look, World, WorldError};
use vitriol_xr::PoseFrame;

use crate::failure::{Blame, Failure};
use crate::hands::Gloves;
use crate::skin::skin;
use crate::thermometer::Thermometer;

/// An observation that is under way, and the state of bench and user in its step.
struct UnderWay {
    /// `None` where the device was lost in it.
    look: Option<Look>,
    before: f64,
    t: f64,
    poses: Vec<Pose>,
    held: Vec<bool>,
    strikes: Vec<Strike>,
    breaks: Vec<Break>,
    worn: Worn,
    sash_open: Option<f64>,
    dipped: Vec<Dipped>,
    hands: [Vec<Bone>; 2],
}

/// The result of an observation.
pub struct Looked {
    /// Where the liquid is, and how much went where.
    pub census: Census,
    /// The run's time, s.
    pub t: f64,
    /// Simulated time since the observation before, s.
    pub elapsed: f64,
    /// stage_from_flask at that step, in the world.
    pub poses: Vec<Pose>,
    /// The bones of the gloves that it was made with, real metres.
    pub hands: [Vec<Bone>; 2],
    /// Events that are over with it.
    pub events: Vec<Event>,
    /// The part of it that a lesson judges.
    pub sight: Sight,
}

/// Makes the observations of a run's scene, and finds events in them.
pub struct Looks {
    gloves: Gloves,
    finder: Finder,
    thermometer: Thermometer,
    under_way: VecDeque<UnderWay>,
}

impl Looks {
    /// At a scene at its start, which is called `name`.
    pub fn of(name: &str, scene: &Scene) -> Self {
        Self {
            gloves: Gloves::of(scene),
            finder: Finder::new(name, scene, Limits::default()),
            thermometer: Thermometer::of(scene),
            under_way: VecDeque::new(),
        }
    }

    /// Observes `world` behind the step that was taken with that frame, [near](crate::stage) the scene's own origin, on that queue.
    /// The run's time is `before` that step and `t` behind it (s). Does not wait; gives the submission that it is in.
    ///
    /// # Errors
    /// An error of the device.
    pub fn look(
        &mut self,
        world: &mut World,
        queue: QueueKind,
        near: &PoseFrame,
        [before, t]: [f64; 2],
    ) -> Result<Ticket, Failure> {
        let scale = world.scene().scale.length_scale;
        // Tracked fingers are not recorded, so they are as a controller's would be.
        let hands = self.gloves.worn(world, &near.hands, &[None, None]);
        let parts = skin(
            hands.each_ref().map(Vec::as_slice),
            &near.stage_from_view,
            scale,
        );
        let look = world.look_on(queue, &parts).other();
        let flasks = 0..world.scene().flasks.len();
        self.under_way.push_back(UnderWay {
            look: None,
            before,
            t,
            poses: world.poses().to_vec(),
            held: flasks.map(|flask| world.holder(flask).is_some()).collect(),
            strikes: world.strikes().to_vec(),
            breaks: world.breaks().to_vec(),
            worn: world.worn(),
            sash_open: world.sash_open(),
            dipped: dipped(world),
            hands,
        });
        let under_way = self.under_way.back_mut();
        let look = look?;
        let ticket = look.ticket().clone();
        if let Some(under_way) = under_way {
            under_way.look = Some(look);
        }
        Ok(ticket)
    }

    /// The oldest observation that was not collected yet, if it has come; does not wait.
    ///
    /// # Errors
    /// An error of the device.
    pub fn collect(&mut self) -> Result<Option<Looked>, Failure> {
        self.oldest(Look::try_get)
    }

    /// The oldest observation that was not collected yet, if there is one; waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn wait(&mut self) -> Result<Option<Looked>, Failure> {
        self.oldest(|look| look.get().map(Some))
    }

    /// The oldest observation that was not collected yet, if `get` returns its census.
    fn oldest(
        &mut self,
        get: impl Fn(&Look) -> Result<Option<Census>, WorldError>,
    ) -> Result<Option<Looked>, Failure> {
        let oldest = self.under_way.front().and_then(|it| it.look.as_ref());
        let Some(look) = oldest else {
            return Ok(None);
        };
        let elapsed = look.elapsed;
        let Some(census) = get(look).other()? else {
            return Ok(None);
        };
        let oldest = self.under_way.pop_front();
        Ok(oldest.map(|it| self.seen(it, census, elapsed)))
    }

    /// What the thermometer shows, °C.
    pub fn thermometer(&self) -> f64 {
        self.thermometer.celsius()
    }

    /// The pour under way in the last observation that was collected.
    pub fn pouring(&self) -> Option<Stream> {
        self.finder.pouring()
    }

    /// Observations that are not collected yet.
    pub fn under_way(&self) -> usize {
        self.under_way.len()
    }

    /// Forgets observations on a device that is gone: they will not come.
    pub fn forget(&mut self) {
        self.under_way.clear();
    }

    /// Takes the observations of a world that was brought back on another device, oldest first, in the place of those that were under way:
    /// the last ones are the same. What was under way from before them is lost.
    pub fn take_again(&mut self, again: Vec<Look>) {
        let lost = self.under_way.len().saturating_sub(again.len());
        self.under_way.drain(..lost);
        let known = again.len().saturating_sub(self.under_way.len());
        let looks = again.into_iter().skip(known);
        for (under_way, look) in self.under_way.iter_mut().zip(looks) {
            under_way.look = Some(look);
        }
    }

    /// Ends the attempt, and returns its last events. Observations under way are not waited for.
    pub fn end(&mut self) -> Vec<Event> {
        self.finder.end()
    }

    /// The events that [`Looks::end`] would return now.
    pub fn so_far(&self) -> Vec<Event> {
        self.finder.clone().end()
    }

    fn seen(&mut self, of: UnderWay, census: Census, elapsed: f64) -> Looked {
        let seen = Seen {
            t: of.t,
            before: of.before,
            elapsed,
            census: &census,
            poses: &of.poses,
            held: &of.held,
            strikes: &of.strikes,
            breaks: &of.breaks,
            worn: of.worn,
            sash_open: of.sash_open,
            dipped: &of.dipped,
        };
        let events = self.finder.looked(&seen);
        let sight = self.finder.sight(&seen);
        self.thermometer.looked(&sight, elapsed);
        Looked {
            census,
            t: of.t,
            elapsed,
            poses: of.poses,
            hands: of.hands,
            events,
            sight,
        }
    }
}

/// The world's tools that are dipped into liquid.
fn dipped(world: &World) -> Vec<Dipped> {
    let tools = world.scene().tools.iter().zip(world.tools()).enumerate();
    tools
        .filter(|(_, (tool, _))| tool.kind.is_dipped())
        .map(|(index, (tool, pose))| Dipped {
            kind: tool.kind,
            tip: pose.position,
            speed: world.tool_speed(index),
        })
        .collect()
}
