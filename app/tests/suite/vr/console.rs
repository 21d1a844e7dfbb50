//! A session that an instructor directs from a real browser, and what its recording replays.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};

use serde_json::Value;
use vitriol_console::Hub;
use vitriol_lesson::{Language, Texts};
use vitriol_live::{Console, start, student};
use vitriol_run::Action;
use vitriol_session::session::Options;
use vitriol_sim::scene::Preset;
use vitriol_tests::devtools::Tab;
use vitriol_tests::gpu;
use vitriol_xr::{HeadsetFrame, Pose};

use crate::vr::common::{Trouble, Worn, hash, in_scene, nobody, options, pour, session_with};
use crate::vr::loss::{instructed, replayed};

/// What an instructor does in a frame, and what the page shows once it is done; both are JavaScript.
struct Deed {
    frame: u64,
    does: String,
    shows: String,
}

fn deed(frame: u64, does: &str, shows: &str) -> Deed {
    Deed {
        frame,
        does: does.into(),
        shows: shows.into(),
    }
}

/// The element with that id.
fn at(id: &str) -> String {
    format!("document.getElementById('{id}')")
}

fn click(frame: u64, id: &str, shows: &str) -> Deed {
    deed(frame, &format!("{}.click()", at(id)), shows)
}

/// Whether the control with that id shows that it is on.
fn pressed(id: &str, on: bool) -> String {
    format!("{}.getAttribute('aria-pressed') === '{on}'", at(id))
}

fn reads(id: &str, text: &str) -> String {
    format!("{}.textContent === '{text}'", at(id))
}

fn speed(frame: u64, rate: &str) -> Deed {
    let list = at("speed");
    let does =
        format!("{{ {list}.value = '{rate}'; {list}.dispatchEvent(new Event('change')); 1 }}");
    deed(
        frame,
        &does,
        &format!("!('waits' in {list}.dataset) && {list}.value === '{rate}'"),
    )
}

/// Writes into a field and sends its form.
fn send(frame: u64, field: &str, text: &str, shows: &str) -> Deed {
    let field = at(field);
    deed(
        frame,
        &format!("{{ {field}.value = '{text}'; {field}.form.requestSubmit(); 1 }}"),
        shows,
    )
}

/// Does one thing after the other in a browser's tab.
struct Instructed {
    tab: RefCell<Tab>,
    deeds: RefCell<VecDeque<Deed>>,
    /// Whether the first of them is done and not shown yet.
    done: RefCell<bool>,
}

impl Trouble for Instructed {
    fn frame(&mut self, _: &mut HeadsetFrame, after: u64) {
        let deeds = self.deeds.borrow();
        if let Some(first) = deeds.front()
            && after >= first.frame
            && !self.done.replace(true)
        {
            self.tab.borrow_mut().eval(&first.does);
        }
    }

    fn awaits(&self, _: u64) -> bool {
        if !*self.done.borrow() {
            return false;
        }
        let mut deeds = self.deeds.borrow_mut();
        let Some(first) = deeds.front() else {
            return false;
        };
        let shown = self.tab.borrow_mut().eval(&first.shows);
        if shown == Value::Bool(true) {
            deeds.pop_front();
            self.done.replace(false);
            return false;
        }
        true
    }
}

/// A hub on this computer, a browser in it, and a session's end of it.
fn directed(mut options: Options, deeds: Vec<Deed>) -> Option<(Hub, Instructed, Options)> {
    let hub = start(
        SocketAddr::new(Ipv4Addr::LOCALHOST.into(), 0),
        false,
        Language::En,
    )
    .unwrap();
    let texts = Texts::english().unwrap();
    let told = student((Some("Ada"), &texts), true);
    let port = hub.student(told.clone()).unwrap().unwrap();
    let mut tab = Tab::new()?;
    tab.go(&hub.invite().unwrap().address);
    tab.until("!document.getElementById('student').hidden");
    options.console = Some(Console {
        port,
        student: told,
        language: Language::En,
    });
    let instructed = Instructed {
        tab: tab.into(),
        deeds: RefCell::new(deeds.into()),
        done: false.into(),
    };
    Some((hub, instructed, options))
}

/// A pot of soup that boils from the start, with few particles.
fn soup(folder: &Path) -> PathBuf {
    let text = include_str!("../../../../sim/scenes/tomato-soup.toml");
    let small = text
        .replace("spacing = 0.05 ", "spacing = 0.1 ")
        .replace("particles = 14880", "particles = 1860");
    assert_ne!(small, text);
    let file = folder.join("soup.toml");
    std::fs::write(&file, small).unwrap();
    file
}

const BYE: &str = "That is all.";
const MESSAGE: &str = "Slowly, please: “ä”!";

/// Each control does what it says from the next frame on; the panel says so, the page shows it, and the recording has it, so that a
/// replay does it again at the same simulated time and ends in the same bits.
#[test]
fn what_an_instructor_does_is_done_said_and_replayed() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let keys =
        "[...document.querySelectorAll('.keys span')].map((key) => key.textContent).join('; ')";
    let deeds = vec![
        // It sees the student's view, and reads what the program measures.
        deed(
            2,
            "1",
            &format!(
                "Number({}.dataset.drawn) > 0 && /Pot, hottest: 1\\d\\d/.test({keys})",
                at("picture")
            ),
        ),
        send(4, "message", MESSAGE, &reads("shown", MESSAGE)),
        send(8, "k-v", "2.5", &reads("k-v-now", "2.5")),
        click(12, "spare", &pressed("spare", true)),
        speed(16, "0.25"),
        click(28, "pause", &reads("pause", "Resume")),
        click(40, "pause", &reads("pause", "Pause")),
        speed(44, "1"),
        click(48, "unsay", &reads("shown", "nothing")),
        click(
            52,
            "reset",
            &format!(
                "{} && {}.querySelector('h4').textContent.startsWith('Attempt 2: ')",
                reads("k-v-now", "0.75"),
                at("incident-list")
            ),
        ),
        click(60, "spare", &pressed("spare", false)),
        // What is done while time is held, right before the end, is kept too.
        click(64, "pause", &reads("pause", "Resume")),
        send(66, "message", BYE, &reads("shown", BYE)),
        click(68, "end-now", &reads("said", "The session is over.")),
    ];
    let soup = in_scene(folder.path(), &soup(folder.path()));
    let Some((_hub, instructor, options)) = directed(soup, deeds) else {
        return;
    };
    let mut headset = Worn::new(&gpu, pour().sample_track(), 60.0, 100, instructor);
    let (outcome, track) = session_with(&mut headset, options, nobody());
    // Both hands have felt that something was said; they hold nothing.
    let felt = |hands: &[f32; 2]| hands.iter().all(|it| *it >= 0.5);
    assert!(headset.felt.iter().any(felt));
    // The end is the last deed; its page may not have been told before the loop ended.
    assert!(headset.trouble.deeds.borrow().len() <= 1);
    assert!(outcome.frames < 100 + 3000, "{}", outcome.frames);

    let said: Vec<_> = track
        .frames
        .iter()
        .flat_map(|frame| frame.scenario.iter().map(move |it| (frame.time_ns, it)))
        .filter_map(|(t, it)| Some((t, Action::of(it).unwrap()?)))
        .filter(|(_, it)| it.is_instructors())
        .collect();
    let order: Vec<_> = said.iter().map(|(_, it)| it.clone()).collect();
    use Action::{Intensity, Message, Mute, Pause, Speed};
    assert_eq!(
        order,
        [
            Message(MESSAGE.into()),
            Intensity(2.5),
            Mute(true),
            Speed(0.25),
            Pause(true),
            Pause(false),
            Speed(1.0),
            Message(String::new()),
            Mute(false),
            Pause(true),
            Message(BYE.into()),
        ]
    );
    // Nothing was simulated in the pause.
    let at = |of: &Action| said.iter().find(|(_, it)| it == of).unwrap().0;
    assert_eq!(at(&Pause(true)), at(&Pause(false)));
    let (state, repeated) = instructed(&gpu, track);
    assert_eq!(state, hash(&outcome));
    assert_eq!(repeated, said);
}

mod long {
    use super::*;

    /// A hand goes on while time is held: what it holds is where the hand is when time goes on, and not a drop of it is lost.
    #[test]
    fn a_pause_in_mid_pour_spills_nothing() {
        let gpu = gpu::device();
        let folder = tempfile::tempdir().unwrap();
        let deeds = vec![
            click(66, "pause", &reads("pause", "Resume")),
            // The flask in the hand is work, which another start would lose.
            click(70, "reset", &format!("{}.open", at("lose"))),
            click(72, "lose-not", &format!("!{}.open", at("lose"))),
            click(76, "pause", &reads("pause", "Pause")),
        ];
        let Some((_hub, instructor, options)) = directed(options(folder.path()), deeds) else {
            return;
        };
        assert_eq!(options.plan.preset, Preset::Balanced);
        let mut headset = Worn::new(&gpu, pour().sample_track(), 60.0, 100, instructor);
        let (outcome, track) = session_with(&mut headset, options, nobody());
        assert!(headset.trouble.deeds.borrow().is_empty());
        // The hand rose meanwhile by centimetres, and took the flask along at once.
        let height = |flasks: &Vec<Pose>| flasks.first().map(|flask| flask.position.y);
        let heights: Vec<_> = track.stage_from_flasks.iter().filter_map(height).collect();
        let leap = heights.windows(2).map(|pair| pair[1] - pair[0]);
        let leap = leap.fold(0.0, f32::max);
        assert!(leap > 0.01, "{leap} m");
        let spilt = outcome.spilt.bench + outcome.spilt.floor;
        assert!(spilt < 0.5, "{spilt} mL");
        assert_eq!(replayed(&gpu, track), hash(&outcome));
    }
}
