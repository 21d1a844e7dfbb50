//! The glass from close by, for who watches the session at the console.

use glam::Vec3;
use vitriol_render::View;
use vitriol_run::{Carriers, Failure};

use super::Session;
use crate::picture::{Outlook, Sight};
use crate::view::close_up_of;

impl Session {
    /// Draws the glass from close by, behind the picture that is shown at `time` (ns), where a page shows it and the next one is due: of the
    /// same particles, which are not copied again, without panel, sign, and splashes on the goggles.
    pub(super) fn show_close_up(&mut self, time: i64) -> Result<(), Failure> {
        let lowered = self.pacing.effort(&self.benches.current).is_some();
        let due = (self.instructor).close_up_is_due(time, self.counts.skipped, lowered);
        let Some(elapsed) = due else {
            return Ok(());
        };
        let (world, picture) = (&self.run.world, &mut self.benches.current.picture);
        let extent = close_up_of(picture.image().desc().extent);
        let aspect = extent[0] as f32 / extent[1] as f32;
        let tripod = &mut self.instructor.close_up;
        let view = tripod.look(world, self.run.seen(), elapsed, aspect);
        let tools = vitriol_run::tools(world, self.run.thermometer());
        let resting = (self.run.marks()).drawn(Carriers::of(world, &self.gloves));
        let sight = Sight {
            eyes: Outlook {
                extent,
                views: [view, upwards(&view)],
            },
            inset: None,
            hands: self.gloves.each_ref().map(Vec::as_slice),
            tools: &tools,
            resting: &resting,
            panel: None,
            sign: None,
            goggles: 0.0,
            shown: 1.0,
            foveation: None,
        };
        picture.draw_again(world, &sight)?;
        self.instructor.take_close_up(picture.image(), extent)
    }
}

/// The second eye of a picture that is looked at with one: it has the ceiling alone, which costs least.
fn upwards(view: &View) -> View {
    let eye = Vec3::from(view.stage_from_eye.translation);
    View::look_at(eye, eye + Vec3::Y, view.fov)
}
