//! The voices that sound now, limited in number.

use crate::voice::Voice;

/// Voices at once: 40 for each of the six vessels of a scene. One core renders them in a tenth of the time that they
/// sound.
pub(crate) const MOST: usize = 256;

/// Voices, each of an emitter's slot.
#[derive(Debug, Default)]
pub(crate) struct Pool {
    voices: Vec<(usize, Voice)>,
}

impl Pool {
    /// Adds a voice. A full pool gives up its quietest for one that is louder.
    pub(crate) fn add(&mut self, slot: usize, voice: Voice) {
        if voice.is_over() {
            return;
        }
        if self.voices.len() < MOST {
            self.voices.push((slot, voice));
            return;
        }
        let levels = self.voices.iter().map(|(_, voice)| voice.level());
        let quietest = levels.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((index, level)) = quietest
            && level < voice.level()
        {
            self.voices[index] = (slot, voice);
        }
    }

    /// Adds the samples of `slot`'s voices to `bus`, and removes those that are over. Returns whether there was any.
    pub(crate) fn render(&mut self, slot: usize, bus: &mut [f32]) -> bool {
        let mut any = false;
        self.voices.retain_mut(|(of, voice)| {
            if *of != slot {
                return true;
            }
            any = true;
            voice.add_to(bus);
            !voice.is_over()
        });
        any
    }

    /// Number of voices that sound or are about to.
    pub(crate) fn len(&self) -> usize {
        self.voices.len()
    }
}
