//! A file to begin a lesson of one's own with: a built-in lesson in one language, with each key explained.

use std::collections::BTreeSet;

use super::error::LessonError;
use super::file::{LONGEST_ID, Lesson, find, is_id};
use crate::language::Language;
use crate::texts::{FaultTexts, lesson_lines};

/// What each key means, in words for a teacher: a line for each, as it stands in the file.
const KEYS: &str = r#"version: version of this kind of file; leave it
name: the lesson's name, by which reports and grades name it
scene: the bench with its glassware and liquids; `vitriol scenes` lists them
modes: ways to go through it, the usual one first: "guided" shows one step at a time, "free" leaves the order to the student, "examination" gives no hints and has no questions
step: what the student does, a section for each; they come in this order
id: a short name of the step or rule (a to z, 0 to 9, -); its texts below stand under this name
points: points for it; all of them together are best 100
hint_after_s: seconds until the hint comes by itself; without it, it comes only when it is asked for
time_limit_s: seconds until the step counts as missed; without it there is no limit
after: ids of the steps that come before this one where the order is free
asks: dangers that this step asks for, which then cost no points: "wrong-order", "acid-on-skin", "no-goggles"
keep: what must hold meanwhile, such as "goggles" and "gloves", which are to be worn
condition: what completes the step
all: each of these has to hold, at one time
any: one of these has to hold
goggles: goggles are worn, or taken off
gloves: gloves are worn, or taken off
on: true: worn; false: taken off
hand: "left-hand" or "right-hand"
lifted: a hand holds this flask
put-down: this flask stands on the bench again
flask: which flask, by its name in the scene
poured: liquid was poured from one flask into another
from: the flask that is poured from
into: the flask that is poured into
liquid: what counts as poured: "acid" (15 % and more), "water" (below 5 %) or "any"
at_least_ml: least volume, mL
at_most_ml: greatest volume, mL
at_most_ml_s: fastest pour, mL in a second
holds: this flask holds so much liquid of such a concentration
acid_from_percent: least concentration, % of the mass
acid_to_percent: greatest concentration, % of the mass
for_s: for so many seconds without a break
temperature: the liquid's mean temperature is in a range
at_least_c: least temperature, °C
at_most_c: greatest temperature, °C
stirred: the liquid was stirred with the rod
at_least_s: for so many seconds in all
measured: the thermometer was in the liquid
wiped: bench or floor was wiped with the cloth
surface: "bench" or "floor"
rinsed: so much water came over a hand
answered: the step's text is a question, and one of its answers was given
answers: how many answers there are, 1 to 3
right: number of the right answer, counted from 1; without it each answer is right
sash: the fume hood's window is open so far
at_most_m: greatest opening, m
rule: what has to hold from beginning to end, a section for each
never: what must not happen: "water-into-acid", "poured-too-fast", "boiled-over", "hot", "on-skin" or "dropped"
cool: this flask's liquid stays below a mean temperature
below_c: that temperature, °C
spilt: no more than `at_most_ml` is spilt"#;

/// What stands above the texts.
const TEXTS: &str = "\
# What students read. Each text is one line; `vitriol lesson FILE` says if one is too long for the panel.
# title, summary: the lesson in a few words, and what it is about
# step.ID.text: what is to be done, or the question; step.ID.hint: how it is done
# step.ID.hint_desk: how it is done with mouse and keyboard, where that is said otherwise
# step.ID.answers: the answers to the question, in their order
# rule.ID: what has to hold
";

impl Lesson {
    /// Text of a new lesson of that `name`, to be changed by hand: the built-in lesson `from` with its texts in one language alone, and a
    /// comment at the first of each key.
    ///
    /// # Errors
    /// [`LessonError::NewName`] where a lesson cannot have that name, and [`LessonError::NotFound`] for an unknown `from`.
    pub fn template(name: &str, from: &str, language: Language) -> Result<String, LessonError> {
        if !is_id(name) || Self::builtin_names().contains(&name) {
            let problem = FaultTexts::of(language)?.new_name.fill(&[
                ("name", &format!("{name:?}")),
                ("most", &LONGEST_ID.to_string()),
                ("known", &Self::builtin_names().join(", ")),
            ]);
            return Err(LessonError::NewName(problem));
        }
        if is_device(name) {
            let reserved = FaultTexts::of(language)?.reserved;
            let problem = reserved.fill(&[("name", &format!("{name:?}"))]);
            return Err(LessonError::NewName(problem));
        }
        let steps = find(from)?;
        // A test rules out that a built-in lesson has no texts in a language.
        let texts = lesson_lines(language, from).unwrap_or_default();
        let mut text = format!(
            "# A lesson of your own, begun as a copy of {from}. What stands behind # is a comment, which the program does not read.\n"
        );
        text += &format!(
            "# Change what you like, save it, and check it with: vitriol lesson {name}.toml\n"
        );
        let mut explained = BTreeSet::new();
        // The comment at its head says where the built-in lesson's texts are.
        for line in steps.lines().skip_while(|line| line.starts_with('#')) {
            for meaning in KEYS.lines() {
                let key = meaning.split(':').next().unwrap_or(meaning);
                if has_key(line, key) && explained.insert(key) {
                    text += &format!("# {meaning}\n");
                }
            }
            if line.starts_with("name = ") {
                text += &format!("name = \"{name}\"\n");
            } else {
                text += &format!("{line}\n");
            }
        }
        text += &format!("\n{TEXTS}[texts.{language}]\n{texts}\n");
        Ok(text)
    }
}

/// Whether Windows reserves that name, of small letters, for a device. A file may not have it with an ending either: "Naming Files, Paths,
/// and Namespaces" in Microsoft's documentation of Win32.
fn is_device(name: &str) -> bool {
    let port = name
        .strip_prefix("com")
        .or_else(|| name.strip_prefix("lpt"));
    let is_port = port.is_some_and(|number| matches!(number.as_bytes(), [b'1'..=b'9']));
    is_port || ["con", "prn", "aux", "nul"].contains(&name)
}

/// Whether a line of a built-in lesson has that key, in a heading or before a value.
fn has_key(line: &str, key: &str) -> bool {
    let code = line.split('#').next().unwrap_or(line);
    if code.starts_with('[') {
        let heading = code.trim().trim_matches(['[', ']']);
        return heading.split('.').any(|part| part == key);
    }
    let part_of_key = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    // Behind the last sign there is a value and no key.
    let signs = code.matches(" =").count();
    let mut before = code.split(" =").take(signs);
    before.any(|before| before.rsplit(|c: char| !part_of_key(c)).next() == Some(key))
}
