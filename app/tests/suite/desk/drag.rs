//! A pour of a wanted volume with the mouse alone: the secondary button tilts, and the user stops by what an instructor's page says.

use std::net::{Ipv4Addr, SocketAddr};
use std::rc::Rc;
use std::sync::{Arc, Mutex};

use crate::desk::common::{By, Script, points, sat, takes};
use crate::desk::pour::{NOT_YET, UPRIGHT, aims, carries, carries_back, poured_ml, was_poured};
use crate::desk::seen::{SOURCE, TARGET};
use vitriol_console::{Codec, Hub, Watcher};
use vitriol_lesson::{Language, Texts};
use vitriol_live::{Console, start, student};
use vitriol_session::session::Options;

/// What the source holds at first, mL, and by how much a reading of a flask at rest may differ from it: 16 particles. Our choice; it also
/// tells the first drops from a liquid at rest.
const HELD: f64 = 150.0;
const READS: f64 = 2.0;
/// What has left the source when the user tilts it back, mL: some more flows meanwhile.
const STOPS: f64 = 17.0;
/// What is to be poured in all, mL. A particle has an eighth of a millilitre, and the last ones run for as long as the flask turns.
const WANTED: f64 = 20.0;
const BY: f64 = 5.0;
/// What is on its way, and what wets the rim, mL: by so much may what arrived differ from what was poured.
const ON_ITS_WAY: f64 = 3.0;
/// Drags, pixels of a window with 320 columns, which are two thirds of a turn: 6° while nothing flows, 1.5° up to the first drops, then
/// 0.75°.
const COARSE: i32 = 8;
const FINE: i32 = 2;
const FINEST: i32 = 1;
/// How far it is dragged back at once: 45°.
const BACK: i32 = -60;
/// Time between two drags, s of the simulation: the hand has turned, and the stream shows what came of it.
const WAITS: f64 = 0.25;

/// A page on which an instructor reads what flasks hold.
#[derive(Clone)]
struct Page {
    hub: Rc<Hub>,
    /// What the source holds, and the number of readings so far.
    read: Arc<Mutex<(Option<f64>, u64)>>,
}

impl Page {
    /// A hub on this computer, of which the session is the student.
    fn of(options: &mut Options) -> Self {
        let to = SocketAddr::new(Ipv4Addr::LOCALHOST.into(), 0);
        let hub = start(to, false, Language::En).unwrap();
        let told = student((Some("Ada"), &Texts::english().unwrap()), true);
        options.console = Some(Console {
            port: hub.student(told.clone()).unwrap().unwrap(),
            student: told,
            language: Language::En,
        });
        Self {
            hub: hub.into(),
            read: Arc::default(),
        }
    }

    /// Opens it. It reads on until the hub ends.
    fn open(&self) {
        let mut watcher = Watcher::enter(&self.hub, Codec::Jpeg).unwrap();
        let last = Arc::clone(&self.read);
        std::thread::spawn(move || {
            while let Ok(state) = watcher.hear_state() {
                let read = state["readings"]["flasks"][SOURCE]["volume_m3"].as_f64();
                let mut last = last.lock().unwrap();
                *last = (read.map(|m3| 1e6 * m3), last.1 + 1);
            }
        });
    }

    /// What the source holds, mL; `None` before the first reading.
    fn source_ml(&self) -> Option<f64> {
        self.read.lock().unwrap().0
    }

    /// Number of readings so far.
    fn readings(&self) -> u64 {
        self.read.lock().unwrap().1
    }

    /// What has left it, mL.
    fn poured_ml(&self) -> f64 {
        self.source_ml().map_or(0.0, |holds| HELD - holds)
    }
}

/// Waits for the first reading, with both flasks at rest.
fn reads(script: Script, page: Page) -> Script {
    script.then("opens the page", move |_, _, frame| {
        if frame == 0 {
            page.open();
        }
        let read = page.source_ml();
        let whole = read.is_none_or(|holds| (holds - HELD).abs() < READS);
        assert!(whole, "{read:?} mL before the pour");
        read.is_some()
    })
}

fn pours(script: Script, page: Page) -> Script {
    let (mut coarse, mut fine, mut back) = (0.0, 0.0, 0.0);
    // Who has seen no new reading does not tilt further: beside other work a page comes late.
    let mut read = 0;
    carries(script)
        .then("tilts it", move |user, seen, _| {
            let tilted = seen.tilt(SOURCE) >= NOT_YET;
            if !tilted && seen.lasts >= coarse {
                user.tilts(COARSE);
                coarse = seen.lasts + WAITS;
            }
            tilted
        })
        .then("pours", move |user, seen, _| {
            let axis = seen.axis(SOURCE);
            assert!(axis.x > 0.4, "not to the right: {axis}");
            let over = aims(user, seen);
            let poured = page.poured_ml();
            let readings = page.readings();
            if over && poured < STOPS && seen.lasts >= fine && readings > read {
                user.tilts(if poured > READS { FINEST } else { FINE });
                fine = seen.lasts + WAITS;
                read = readings;
            }
            poured >= STOPS
        })
        .then("drags it back", move |user, seen, frame| {
            let upright = seen.tilt(SOURCE) <= UPRIGHT;
            if frame == 0 {
                user.tilts(BACK);
                back = seen.lasts + 2.0 * WAITS;
            } else if !upright && seen.lasts >= back {
                user.tilts(-COARSE);
                back = seen.lasts + WAITS;
            }
            upright
        })
}

mod long {
    use super::*;

    #[test]
    fn the_secondary_button_pours_twenty_millilitres() {
        let name = "desk::drag::long::the_secondary_button_pours_twenty_millilitres";
        let sat = sat(name, By::Mouse, |_, options| {
            let page = Page::of(options);
            let script = takes(points(reads(Script::default(), page.clone())));
            carries_back(pours(script, page))
        });
        let Some((gpu, sat)) = sat else { return };
        let told = poured_ml(&sat);
        assert!((told - WANTED).abs() <= BY, "{told} mL are told");
        // 1 g of water is 1 mL.
        let arrived = 1e3 * sat.outcome.world.measure().unwrap().in_flasks[TARGET];
        assert!(
            (told - arrived).abs() <= ON_ITS_WAY,
            "{told} mL are told, {arrived} mL arrived"
        );
        was_poured(&gpu, sat);
    }
}
