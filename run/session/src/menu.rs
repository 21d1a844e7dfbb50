//! What can be chosen while a session runs, on the panel and by the computer's keyboard.

use vitriol_lesson::procedure::MOST_ANSWERS;
use vitriol_lesson::{Mode, Texts};
use vitriol_run::Action;

use super::decision::Decision;
use super::listing::can_ask;
use vitriol_run::choices::CHOICES;

/// Key of [`Action::Start`].
pub const START: char = 'b';
/// Key of [`Decision::Toggle`].
pub const TOGGLE: char = 't';
/// Key of [`Decision::Recentre`].
pub const RECENTRE: char = 'a';
/// Key of [`Decision::Summary`].
pub const SUMMARY: char = 's';
/// Key of [`Action::Hint`].
pub const HINT: char = 'h';
/// Key of [`Action::Skip`].
pub const SKIP: char = 'n';
/// Keys of [`Action::Answer`], of the first answer and those behind it.
pub const ANSWERS: [char; MOST_ANSWERS as usize] = ['j', 'k', 'l'];
/// Key of [`Action::Finish`].
pub const FINISH: char = 'f';
/// Key of [`Decision::AskEnd`].
pub const END: char = 'q';
/// The terminal's key that lets another browser into the console.
pub const INVITE: char = 'i';

/// What a key stands for.
pub fn decision(key: char) -> Option<Decision> {
    let key = key.to_ascii_lowercase();
    let mut answers = (1..).zip(ANSWERS);
    if let Some((answer, _)) = answers.find(|(_, of)| *of == key) {
        return Some(Decision::Act(Action::Answer { step: None, answer }));
    }
    match key {
        START => Some(Decision::Act(Action::Start(None))),
        TOGGLE => Some(Decision::Toggle),
        RECENTRE => Some(Decision::Recentre),
        SUMMARY => Some(Decision::Summary),
        HINT => Some(Decision::Act(Action::Hint(None))),
        SKIP => Some(Decision::Act(Action::Skip(None))),
        FINISH => Some(Decision::Act(Action::Finish)),
        END => Some(Decision::AskEnd),
        _ => {
            let chosen = CHOICES.iter().find(|choice| choice.key == key);
            chosen.map(|choice| Decision::Act(Action::Scene(choice.scene.into())))
        }
    }
}

/// What mouse and keyboard do in the window of a session without a headset; for a terminal, behind [`lines`].
pub const MOUSE_LINES: &str = "\
mouse and keys, in the window:
  main button    takes a flask, carries it while held, puts it down; presses the panel
  right button   held and moved to a side: tilts to it what the hand holds
  Q, E           tilt to the left, to the right
  W              held: swirls what the hand holds
  wheel          raises and lowers the hand
  wheel pressed  moved: turns the view; clicked: the other hand
  arrows         move the hand; with Ctrl the view
  Space          takes and puts down, without the mouse
  Tab            the other hand
  G              pulls the other hand's glove off
  R, V           the panel, the bench from the side; again: back
  B, N, 1 …      held for a second: a new start, the next step, a scene
  F11            the whole screen
  Esc            end, pressed twice";

/// The keys and what they do, for a terminal, with the scenes' titles in `texts`; whether one lets a browser in, and how a lesson is
/// gone through, if one is. Where a `pointer` moves the hands there is nothing to recentre.
pub fn lines(texts: &Texts, invites: bool, lesson: Option<Mode>, pointer: bool) -> String {
    let mut text = String::from("keys, each with Enter:");
    for choice in CHOICES {
        let (title, sign) = (texts.scene(choice.scene), choice.sign(lesson.is_some()));
        text += &format!("\n  {}  {title}{sign}", choice.key);
    }
    for (key, does) in [
        (START, "from the start"),
        (TOGGLE, "the other order, of a pair"),
        (RECENTRE, "recentre"),
        (SUMMARY, "what happened"),
    ] {
        if pointer && key == RECENTRE {
            continue;
        }
        text += &format!("\n  {key}  {does}");
    }
    for act in lesson.map_or(&[][..], can_ask) {
        let (key, does) = match act {
            Action::Hint(_) => (HINT, "a hint"),
            Action::Skip(_) => (SKIP, "leave this step out"),
            _ => (FINISH, "all is done: the lesson ends"),
        };
        text += &format!("\n  {key}  {does}");
    }
    if lesson.is_some_and(Mode::tells) {
        let [first, second, third] = ANSWERS;
        text += &format!(
            "\n  {first} {second} {third}  the answers to a question, where the lesson asks one"
        );
    }
    if invites {
        text += &format!("\n  {INVITE}  let a browser into the console");
    }
    text + &format!("\n  {END}  end, pressed twice")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::Language;
    use vitriol_sim::scene::Scene;

    #[test]
    fn each_choice_has_a_scene_and_a_key_of_its_own() {
        for choice in CHOICES {
            assert!(Scene::builtin_names().contains(&choice.scene));
            let decided = decision(choice.key).unwrap();
            assert_eq!(decided, Decision::Act(Action::Scene(choice.scene.into())));
        }
        assert_eq!(decision('B'), Some(Decision::Act(Action::Start(None))));
        assert_eq!(decision('s'), Some(Decision::Summary));
        assert_eq!(decision('T'), Some(Decision::Toggle));
        assert_eq!(decision('x'), None);
        let acts = ['H', 'n', 'f'].map(decision);
        let expected = [Action::Hint(None), Action::Skip(None), Action::Finish];
        assert_eq!(acts, expected.map(|act| Some(Decision::Act(act))));
        let second = Action::Answer {
            step: None,
            answer: 2,
        };
        assert_eq!(decision('K'), Some(Decision::Act(second)));
        let keys = [
            START, TOGGLE, RECENTRE, SUMMARY, HINT, SKIP, FINISH, END, INVITE,
        ];
        let scenes = CHOICES.map(|it| it.key);
        let mut all: Vec<char> = keys.into_iter().chain(ANSWERS).chain(scenes).collect();
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
    }

    #[test]
    fn a_terminal_is_told_of_the_other_order() {
        let texts = Texts::english().unwrap();
        let told = lines(&texts, false, None, false);
        assert!(told.contains("\n  t  the other order, of a pair\n"));
        // The view of a pointer has its own key, in the window.
        let pointer = lines(&texts, false, None, true);
        assert!(told.contains("\n  a  ") && !pointer.contains("\n  a  "));
    }

    /// Scenes have their titles in the session's language, and signs of their order but where a lesson may ask for it.
    #[test]
    fn scenes_are_told_by_their_titles() {
        let texts = Texts::of(Language::De).unwrap();
        let free = lines(&texts, false, None, false);
        let signed = [
            "\n  1  Säure in Wasser ✔\n",
            "\n  2  Wasser in Säure ✖\n",
            "\n  3  Säure in Wasser, im Abzug\n",
        ];
        assert!(signed.iter().all(|it| free.contains(it)), "{free}");
        let asked = lines(&texts, false, Some(Mode::Guided), false);
        let plain = ["\n  1  Säure in Wasser\n", "\n  2  Wasser in Säure\n"];
        assert!(plain.iter().all(|it| asked.contains(it)), "{asked}");
        assert!(!asked.contains(['✔', '✖']), "{asked}");
    }

    #[test]
    fn a_lessons_keys_are_those_of_its_mode() {
        let texts = Texts::english().unwrap();
        let has =
            |mode, key: char| lines(&texts, false, mode, false).contains(&format!("\n  {key}  "));
        let keys = |mode| [HINT, SKIP, FINISH].map(|key| has(mode, key));
        assert_eq!(keys(None), [false; 3]);
        assert_eq!(keys(Some(Mode::Guided)), [true, true, false]);
        assert_eq!(keys(Some(Mode::Free)), [true, false, true]);
        assert_eq!(keys(Some(Mode::Examination)), [false, false, true]);
    }
}
