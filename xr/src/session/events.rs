//! Events of the runtime: states of the session, losses, moves of the stage.

use openxr as xr;

use super::convert::{CallFailure, failed, state};
use super::live::Live;
use super::mask::Mask;
use super::stage::tells_of_recentring;
use crate::HeadsetError;

impl Live {
    /// Handles all waiting events.
    pub(super) fn take_events(&mut self) -> Result<(), CallFailure> {
        let mut buffer = xr::EventDataBuffer::new();
        // A clone, so that the event's borrow does not hold `self`.
        let instance = self.instance.clone();
        while let Some(event) = instance
            .poll_event(&mut buffer)
            .map_err(failed("xrPollEvent"))?
        {
            self.take(event)?;
        }
        Ok(())
    }

    fn take(&mut self, event: xr::Event<'_>) -> Result<(), CallFailure> {
        match event {
            xr::Event::SessionStateChanged(change) => self.change_state(change.state())?,
            xr::Event::InstanceLossPending(_) => {
                return Err(CallFailure::Lost("the runtime is ending".to_owned()));
            }
            xr::Event::EventsLost(lost) => {
                // A change of state among them is repeated only by the next one; the rest is queried.
                tracing::warn!(count = lost.lost_event_count(), "OpenXR events lost");
                self.refresh()?;
            }
            xr::Event::InteractionProfileChanged(_) => {
                self.actions.name_profiles(&self.instance, &self.session)?;
            }
            xr::Event::ReferenceSpaceChangePending(change)
                if tells_of_recentring(change.reference_space_type()) =>
            {
                // If several spaces move, poses follow ours from its time on.
                let ours = change.reference_space_type() == self.stage.kind;
                let known = self.moves_at.filter(|_| !ours);
                self.moves_at = known.or(Some(change.change_time()));
            }
            xr::Event::VisibilityMaskChangedKHR(change)
                if change.view_configuration_type() == self.views.kind() =>
            {
                self.refresh_masks();
            }
            xr::Event::UserPresenceChangedEXT(change) => self.present = change.is_user_present(),
            _ => {}
        }
        Ok(())
    }

    fn change_state(&mut self, to: xr::SessionState) -> Result<(), CallFailure> {
        self.state = state(to);
        tracing::info!(state = ?self.state, "OpenXR session");
        match to {
            xr::SessionState::READY => {
                let begun = self.session.begin(self.views.kind());
                match begun.map_err(failed("xrBeginSession")) {
                    // READY is sent once: the next session is tried with the eyes' own views.
                    Err(CallFailure::Fatal(HeadsetError::Refused { call, cause }))
                        if self.inset.is_some() =>
                    {
                        return Err(self.refusals.give_up(call, &cause));
                    }
                    begun => begun?,
                };
                self.running = true;
            }
            xr::SessionState::STOPPING => {
                self.session.end().map_err(failed("xrEndSession"))?;
                self.running = false;
            }
            xr::SessionState::EXITING => self.ended = true,
            xr::SessionState::LOSS_PENDING => {
                return Err(CallFailure::Lost("the session is ending".to_owned()));
            }
            _ => {}
        }
        Ok(())
    }

    fn refresh(&mut self) -> Result<(), CallFailure> {
        self.refresh_masks();
        self.actions.name_profiles(&self.instance, &self.session)
    }

    fn refresh_masks(&mut self) {
        self.masks = Mask::of_eyes(&self.session, self.views);
    }
}
