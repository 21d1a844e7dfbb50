//! A session's state, as the panel and the window's title show it.

use vitriol_lesson::Tone;

use vitriol_run::Action;
use vitriol_run::texts::{AcidOnTexts, EffortTexts, PanelTexts, SpiltTexts};

/// A session's state in words and numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Info {
    /// Name of the scene.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// Its flasks.
    pub flasks: Vec<FlaskLine>,
    /// Whether there is acid with a tint, which is explained.
    pub acid: bool,
    /// Liquid beside the flasks.
    pub spilt: Lying,
    /// Whether acid has touched the left hand, the right hand, the face.
    pub burns: [bool; 3],
    /// What can be heard, in words.
    pub heard: Option<String>,
    /// Whether the device was lost a short time ago, and all is on another one.
    pub device_lost: bool,
    /// Speed of simulated time in per cent of real time; `None` at full speed.
    pub slow: Option<u32>,
    /// Seconds that are recorded; `None` without a recording.
    pub recording: Option<u64>,
    /// Whether the recording waits for a disk that refuses it.
    pub waits_for_disk: bool,
    /// Steps that could not be recorded.
    pub unwritten: u64,
    /// Display periods without a frame.
    pub missed: u64,
    /// The effort of solver and picture, where it is less than was asked for.
    pub effort: Option<Effort>,
    /// The scene that is being set up.
    pub coming: Option<String>,
    /// How far a hold of the button for a new start has come, per cent.
    pub holding: Option<u32>,
    /// How far the hold of a key has come, per cent; 0 also for a short time after a tap, which is too short.
    pub key_held: Option<u32>,
    /// The pour under way.
    pub pouring: Option<Pouring>,
    /// The end was asked for once.
    pub ends: bool,
    /// Whether mouse and keyboard move the hands: their keys are shown, and no button to recentre.
    pub pointer: bool,
    /// The summary of the attempt, where the panel shows it.
    pub happened: Option<Happened>,
    /// The instructor's message and actions.
    pub told: Told,
    /// The lesson, as the panel shows it.
    pub lesson: Option<Shown>,
}

impl Info {
    /// The pour under way in words. A user who is examined is told nothing that the lesson is judged by.
    pub fn pouring_text(&self, words: &PanelTexts) -> Option<String> {
        let quiet = self.lesson.as_ref().is_some_and(|it| it.quiet);
        let pouring = self.pouring.filter(|_| !quiet);
        pouring.map(|it| it.text(words))
    }
}

/// What the panel shows of a lesson.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// The step that is to be done, or the lesson's result.
    pub step: String,
    /// Its steps, where they are listed.
    pub steps: Vec<(Mark, String)>,
    /// How many steps there are, or beside those that are listed.
    pub note: Option<String>,
    /// How to do it; `None` where no hint is shown.
    pub hint: Option<String>,
    /// Why something failed a short time ago.
    pub failed: Option<String>,
    /// The answers to its question, in the order of their numbers.
    pub answers: Vec<String>,
    /// The actions that the user can ask for.
    pub acts: Vec<ActLine>,
    /// Whether the panel shows nothing of what happened before the end, as in an examination.
    pub quiet: bool,
}

/// How a step stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// It is done.
    Done,
    /// It was not done, and is not tried again.
    Missed,
    /// It is to be done.
    Open,
    /// Others come first.
    Waiting,
}

/// A button of the lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct ActLine {
    /// The action that it asks for.
    pub act: Action,
    /// Its text.
    pub text: String,
    /// Whether the action can be asked for now.
    pub on: bool,
}

/// The instructor's message and actions, as the panel shows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Told {
    /// That time is held, while it is.
    pub paused: Option<String>,
    /// Her last action.
    pub done: Option<String>,
    /// Her message.
    pub message: Option<String>,
}

/// What happened in an attempt, as far as it fits the panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Happened {
    /// Its title.
    pub title: String,
    /// Points, of how many; `None` where nothing could be judged.
    pub points: Option<String>,
    /// Sentences.
    pub said: Vec<(Tone, String)>,
    /// Note that some sentences do not fit; `None` where all do.
    pub more: Option<String>,
    /// Text of the button that closes the summary.
    pub back: String,
}

/// Liquid beside the flasks, in tenths of a mL, to which the panel shows it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lying {
    bench: u32,
    floor: u32,
}

impl Lying {
    /// Rounds these volumes on bench and floor, mL.
    pub fn of(bench: f64, floor: f64) -> Self {
        let tenths = |millilitres: f64| (10.0 * millilitres).round() as u32;
        Self {
            bench: tenths(bench),
            floor: tenths(floor),
        }
    }

    /// In a sentence; `None` where all is in its place.
    pub fn text(&self, words: &SpiltTexts) -> Option<String> {
        let places = [(self.bench, &words.bench), (self.floor, &words.floor)];
        let said = places.into_iter().filter(|(tenths, _)| *tenths > 0);
        let parts: Vec<_> = said
            .map(|(tenths, place)| {
                let volume = match tenths {
                    // A drop has some 0.05 mL.
                    ..10 => format!("0{}{tenths}", words.decimal),
                    _ => ((tenths + 5) / 10).to_string(),
                };
                place.replace("{volume}", &volume)
            })
            .collect();
        (!parts.is_empty()).then(|| words.text.replace("{places}", &parts.join(&words.next)))
    }
}

/// A pour under way, in tenths of a mL and of a mL/s, to which it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pouring {
    volume: u32,
    rate: u32,
}

impl Pouring {
    /// Rounds what has arrived so far (m³) and arrives now (m³/s).
    pub fn of(volume_m3: f64, rate_m3_s: f64) -> Self {
        let tenths = |cubic_metres: f64| (1e7 * cubic_metres).round() as u32;
        Self {
            volume: tenths(volume_m3),
            rate: tenths(rate_m3_s),
        }
    }

    /// In a sentence: from ten on in whole numbers.
    pub fn text(&self, words: &PanelTexts) -> String {
        let decimal = &words.spilt.decimal;
        let [volume, rate] = [self.volume, self.rate].map(|tenths| match tenths {
            ..100 => format!("{}{decimal}{}", tenths / 10, tenths % 10),
            _ => ((tenths + 5) / 10).to_string(),
        });
        words.poured(&volume, &rate)
    }
}

/// Where acid has touched the user, in a sentence, of left hand, right hand and face; `None` where nowhere.
pub fn burns_text(burns: [bool; 3], words: &AcidOnTexts) -> Option<String> {
    let places = [&words.left, &words.right, &words.face].map(String::as_str);
    let touched: Vec<_> = (places.into_iter().zip(burns))
        .filter_map(|(place, touched)| touched.then_some(place))
        .collect();
    let places = match touched.split_last()? {
        (last, []) => (*last).to_owned(),
        (last, rest) => format!("{}{}{last}", rest.join(&words.next), words.last),
    };
    Some(words.text.replace("{places}", &places))
}

/// A flask's line.
#[derive(Clone, Debug, PartialEq)]
pub struct FlaskLine {
    /// Its name.
    pub name: String,
    /// Whether it has broken.
    pub broken: bool,
    /// Mean temperature of its liquid, whole °C; `None` where heat is not modelled or it is empty.
    pub temperature: Option<i32>,
    /// Acid by mass, whole per cent.
    pub acid: Option<i32>,
}

/// How much less than was asked for is solved and drawn, so that frames fit the display's period.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// Whether the last change was to more accuracy or pixels.
    pub finer: bool,
    /// Substeps a step and iterations a substep.
    pub solver: [u32; 2],
    /// What was asked for.
    pub asked: [u32; 2],
    /// Each side of the picture, per cent of the display's.
    pub picture: u32,
    /// Whether fewer pixels than were asked for are drawn at the picture's edges.
    pub foveated: bool,
    /// Whether the liquid's surface is drawn by another filter than was asked for.
    pub other_filter: bool,
    /// The display's rate, Hz, where it was higher at first.
    pub rate: Option<u32>,
}

impl Effort {
    /// In a sentence that names only what is less than was asked for.
    pub fn text(&self, words: &EffortTexts) -> String {
        let mut parts = Vec::new();
        if self.solver != self.asked {
            let pair = |[substeps, iterations]: [u32; 2]| format!("{substeps} × {iterations}");
            let solver = words.solver.replace("{now}", &pair(self.solver));
            parts.push(solver.replace("{asked}", &pair(self.asked)));
        }
        if self.foveated {
            parts.push(words.edges.clone());
        }
        if self.other_filter {
            parts.push(words.surface.clone());
        }
        if self.picture < 100 {
            let percent = self.picture.to_string();
            parts.push(words.picture.replace("{percent}", &percent));
        }
        if let Some(rate) = self.rate {
            parts.push(words.display.replace("{rate}", &rate.to_string()));
        }
        let how = if self.finer {
            &words.finer
        } else {
            &words.coarser
        };
        how.replace("{parts}", &parts.join(&words.next))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::Language;
    use vitriol_run::texts::Texts;

    #[test]
    fn what_is_spilt_is_said_to_the_drop_and_then_to_the_millilitre() {
        let words = Texts::english().unwrap().panel.spilt;
        let text = |bench, floor| Lying::of(bench, floor).text(&words);
        assert_eq!(text(0.0, 0.04), None);
        assert_eq!(
            text(0.31, 0.0).as_deref(),
            Some("spilt: 0.3 mL on the bench")
        );
        let both = Some("spilt: 12 mL on the bench, 2 mL on the floor");
        assert_eq!(text(12.4, 1.5).as_deref(), both);
        let german = Texts::of(Language::De).unwrap().panel.spilt;
        let comma = Lying::of(0.31, 0.0).text(&german);
        assert_eq!(comma.as_deref(), Some("verschüttet: 0,3 mL auf dem Tisch"));
    }

    #[test]
    fn a_pour_is_said_to_the_tenth_and_then_to_the_millilitre() {
        let text = |language, volume, rate| {
            let words = Texts::of(language).unwrap().panel;
            Pouring::of(volume, rate).text(&words)
        };
        let slow = text(Language::En, 4.26e-6, 0.04e-6);
        assert_eq!(slow, "poured: 4.3 mL, now 0.0 mL/s");
        let fast = text(Language::De, 9.99e-6, 31.6e-6);
        assert_eq!(fast, "gegossen: 10 mL, jetzt 32 mL/s");
        let comma = text(Language::De, 5e-6, 4.5e-6);
        assert_eq!(comma, "gegossen: 5,0 mL, jetzt 4,5 mL/s");
    }

    #[test]
    fn where_acid_is_is_said() {
        let words = Texts::english().unwrap().panel.acid_on;
        assert_eq!(burns_text([false; 3], &words), None);
        let one = burns_text([false, false, true], &words);
        assert_eq!(one.as_deref(), Some("acid on your face"));
        let all = burns_text([true; 3], &words);
        let said = "acid on your left hand, your right hand and your face";
        assert_eq!(all.as_deref(), Some(said));
    }
}
