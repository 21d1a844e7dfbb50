//! Texts of a class's grades: the table and its page.

use serde::Deserialize;

/// Texts of a class's grades.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradesTexts {
    /// Title of the page.
    pub title: String,
    /// Note that the rows can be sorted.
    pub sort: String,
    /// Head of the column of students.
    pub student: String,
    /// Head of the column of scenes.
    pub scene: String,
    /// Head of the column of points.
    pub points: String,
    /// Head of the column of what went wrong first.
    pub first_wrong: String,
    /// Head of the column of caps.
    pub cap: String,
    /// Head of the column of lessons.
    pub lesson: String,
    /// Where nothing went wrong.
    pub nothing: String,
    /// Where an attempt has no end.
    pub broken_off: String,
    /// Texts on simulating a recording again.
    pub verified: VerifiedTexts,
    unread: String,
    otherwise: String,
    counted: String,
}

/// Texts on whether a simulation finds what a recording says.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VerifiedTexts {
    /// Head of the column.
    pub head: String,
    /// All is the same, to the bit.
    pub to_the_bit: String,
    /// All is the same within the tolerance, on another device.
    pub within_tolerance: String,
    /// Something is not.
    pub differs: String,
}

impl GradesTexts {
    /// A recording could not be read, for this cause.
    pub fn unread(&self, why: &str) -> String {
        self.unread.replace("{why}", why)
    }

    /// A recording is not graded, for this cause.
    pub fn otherwise(&self, why: &str) -> String {
        self.otherwise.replace("{why}", why)
    }

    /// How many recordings were graded, were made otherwise, and could not be read.
    pub fn counted(&self, graded: usize, otherwise: usize, unread: usize) -> String {
        self.counted
            .replace("{graded}", &graded.to_string())
            .replace("{otherwise}", &otherwise.to_string())
            .replace("{unread}", &unread.to_string())
    }
}
