//! What interrupts a session: a headset that shows nothing, and a device that is lost.

use vitriol_run::Failure;
use vitriol_xr::Headset;

use super::Session;
use super::ended::NoFrameOpen;
use crate::panel::Panel;

impl Session {
    /// A device that is lost is no end: the headset gets another one, and the bench is brought back on it.
    pub(super) fn bear(
        &mut self,
        headset: &mut dyn Headset,
        failure: Failure,
    ) -> Result<(), Failure> {
        if !headset.gpu().is_lost() || !self.losses.may_go_on(self.counts.frames) {
            return Err(failure);
        }
        tracing::warn!("{failure}; another device is opened");
        headset.lose_device();
        Ok(())
    }

    /// What is lost where the pictures have nowhere to go.
    fn lost(&self) -> String {
        match self.pointer {
            true => self.texts.panel.card_failed.clone(),
            false => self.texts.panel.headset_lost.clone(),
        }
    }

    /// The headset shows nothing, for this reason: time stands still.
    pub(super) fn pause(&mut self, why: &str) -> Result<(), Failure> {
        let info = self.info();
        if let Some(mirror) = &mut self.mirror {
            mirror.entitle(&info, &self.texts.panel, Some(why));
            mirror.label(None);
        }
        self.steps.clock.pause();
        self.placement.interrupt();
        self.counts.pause();
        self.tell(false);
        match self.catch_up(&NoFrameOpen::in_a_turn_without()) {
            // Nothing comes from it any more; what is due is taken on the next one.
            Err(_) if self.run.world.gpu().is_lost() => Ok(()),
            caught_up => caught_up,
        }
    }

    /// Moves everything to the headset's new device.
    pub(super) fn renew(&mut self, headset: &dyn Headset) -> Result<(), Failure> {
        self.pause(&self.lost())?;
        self.renewals += 1;
        if !self.run.world.gpu().is_lost() {
            self.observe(true)?;
        }
        let gpu = headset.gpu();
        if self.benches.move_to(headset, &mut self.run)? {
            self.losses.brought_back(self.counts.frames);
        }
        self.checkpoints.forget();
        let (library, eyes) = (&self.benches.library, &self.benches.eyes);
        self.panel = Panel::new(gpu, library)?.in_words(&self.texts.panel);
        self.hints.move_to(gpu, library)?;
        if let Some(mirror) = &mut self.mirror {
            mirror.move_to(gpu, library, eyes.extent)?;
        }
        if let Some(view) = &mut self.instructor.view {
            view.move_to(gpu, library, eyes.extent)?;
        }
        // What was under way on the old device will not come, and its times do not apply to the new one.
        self.pacing.forget();
        self.pacing.forget_rates();
        self.counts.tally.restart();
        self.steps.submitted();
        // What a lost device has left due belongs to the hands as they were before.
        let no_frame = NoFrameOpen::in_a_turn_without();
        self.steps.take_rest(&mut self.run, &no_frame)?;
        self.steps.submitted();
        Ok(())
    }
}
