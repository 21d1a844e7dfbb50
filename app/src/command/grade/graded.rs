//! What is kept of a graded track: a file for each, by which a later call goes on.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use vitriol_lesson::procedure::Verdict;
use vitriol_lesson::{Attempt, Score, Texts};
use vitriol_run::output::write_over;
use vitriol_run::texts::Otherwise;
use vitriol_run::{Blame, Failure};

use super::agreement::Tolerance;
use super::expected::Asked;
use super::verify::Verified;

/// The version of [`Graded`]'s layout. It goes up where a field goes, or means something else.
const LAYOUT: u32 = 3;

/// Program and version: another one may find and score otherwise.
const PROGRAM: &str = concat!("vitriol ", env!("CARGO_PKG_VERSION"));

/// A graded track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Graded {
    layout: u32,
    program: String,
    /// The track's file, without its folder.
    pub track: String,
    /// Follows from the track's content alone: the identifier of its sitting.
    pub content: String,
    /// What it was graded by.
    pub asked: Asked,
    /// Whether only what is whole of it was taken.
    pub truncated: bool,
    /// What was read in it.
    pub found: Found,
    /// What the lesson came to in each attempt, where one is judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lesson: Vec<Verdict>,
    /// What simulating it again came to; `None` where nobody asked.
    pub verified: Option<Verified>,
}

/// What was read in a track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Found {
    /// What its student did.
    Attempts(Vec<Scored>),
    /// It was made otherwise than was asked for, and is not graded.
    Otherwise(Otherwise),
}

/// An attempt and its points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scored {
    /// What was done.
    pub attempt: Attempt,
    /// What it was worth.
    pub score: Score,
}

impl Graded {
    /// The grade of a track of that name and content.
    pub fn new(
        (track, content): (String, String),
        asked: &Asked,
        truncated: bool,
        found: Found,
    ) -> Self {
        Self {
            layout: LAYOUT,
            program: PROGRAM.into(),
            track,
            content,
            asked: asked.clone(),
            truncated,
            found,
            lesson: Vec::new(),
            verified: None,
        }
    }

    /// The file of a track's result.
    pub fn file(out: &Path, stem: &str) -> PathBuf {
        out.join(format!("{stem}.grade.json"))
    }

    /// What an earlier call left of a track of this content, if it will do: with `verified`, one that was verified by that tolerance, on the device that was
    /// asked for. What is no result, or one of something else, is none.
    pub fn earlier(
        file: &Path,
        content: &str,
        asked: &Asked,
        verified: Option<(Tolerance, Option<&str>)>,
    ) -> Option<Self> {
        let found: Self = serde_json::from_slice(&fs::read(file).ok()?).ok()?;
        let same = found.layout == LAYOUT
            && found.program == PROGRAM
            && found.content == content
            && found.asked == *asked;
        let enough = match (verified, &found.found) {
            (None, _) | (_, Found::Otherwise(_)) => true,
            (Some((by, device)), Found::Attempts(_)) => (found.verified.as_ref())
                .is_some_and(|it| it.tolerance == by && it.asked_device.as_deref() == device),
        };
        (same && enough).then_some(found)
    }

    /// Scores its attempts anew, in these texts: an earlier call may have been for another language.
    pub fn score_again(&mut self, texts: &Texts) {
        if let Found::Attempts(all) = &mut self.found {
            for it in all {
                it.score = Score::of(&it.attempt, &self.asked.rubric, texts);
            }
        }
    }

    /// Keeps it, in place of what an earlier call left.
    ///
    /// # Errors
    /// [`Failure::Other`] where it cannot be written.
    pub fn keep(&self, file: &Path) -> Result<(), Failure> {
        write_over(file, &serde_json::to_vec_pretty(self).other()?)
    }
}
