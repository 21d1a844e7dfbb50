//! The glass from close by, for who watches the session at the console.

use vitriol_run::{Carriers, Failure};

use super::Session;
use crate::picture::{Outlook, Sight};
use crate::view::close_up_of;

impl Session {
    /// Draws the glass from close by, behind the picture that is shown at `time` (ns), where a page shows it and the next one is due: of the
    /// same particles, which are not copied again, without panel, sign, and splashes on the goggles.
    ///
    /// It is no part of the frame's times by which the governor chooses what is solved and drawn, so that who looks on takes nothing from the
    /// student. It gives way to the headset's frames by three means. It is drawn every 200 ms only while it fits beside them by its own
    /// last time on the device, and every 3 s otherwise. While the governor has lowered something, and after a missed period, it is drawn
    /// every 3 s as well. And the governor lowers nothing for periods that are missed right behind it.
    pub(super) fn show_close_up(&mut self, time: i64) -> Result<(), Failure> {
        let last = self.placement.last.as_ref();
        let period = last.map_or(0.0, |last| 1e-6 * last.info.period_ns as f64);
        let fits = (self.pacing).has_room_for(self.counts.tally.close_up_ms, period);
        let lowered = self.pacing.effort(&self.benches.current).is_some();
        let yields = lowered || !fits;
        let (pages, missed) = (self.instructor.view.as_mut(), self.counts.skipped);
        let due = pages.and_then(|it| it.close_up_is_due(time, missed, yields));
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
                views: [view; 2],
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
        let drawn = picture.draw_again(world, &sight)?;
        self.counts.tally.close_up(drawn);
        self.pacing.drew_close_up();
        match &mut self.instructor.view {
            Some(pages) => pages.take_close_up(picture.image(), extent),
            None => Ok(()),
        }
    }
}
