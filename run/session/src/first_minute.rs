//! What someone does first who has never been at this bench: takes a flask, lifts it, pours, puts it down. Each is shown as a sign
//! until it has been done once, in this order.
//!
//! It is judged by the flasks' state in the simulation, not by the buttons that were pressed. An action that implies another counts for
//! both: who has poured has lifted as well.

use serde::Serialize;

/// How far a flask is lifted, m, over where it was taken: more than a hand that closes moves it. Ours.
const LIFTED: f32 = 0.05;
/// What has to go from the flask in the hand into another one, mL: a teaspoon, more than drips. Ours.
pub const POURED: f64 = 5.0;
/// A flask that was put down is as high as it was let go, m, and as upright (cosine of its tilt, 11°), when this time is over, s: one
/// that was let go in the air has fallen 0.3 m by then, at half speed too. Ours.
const STAYS: f32 = 0.02;
const UPRIGHT: f32 = 0.98;
const SETTLES: f64 = 0.5;

/// An action that a first user learns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lesson {
    /// A hand takes a flask.
    Take,
    /// It lifts it.
    Lift,
    /// It pours into another one.
    Pour,
    /// It puts it down and lets go.
    PutDown,
}

impl Lesson {
    /// In their order.
    pub const ALL: [Self; 4] = [Self::Take, Self::Lift, Self::Pour, Self::PutDown];
}

/// A flask in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Handled {
    /// Whether a hand holds it.
    pub held: bool,
    /// Height of its base, m.
    pub height: f32,
    /// Cosine of its tilt: 1 where it is upright.
    pub upright: f32,
    /// Whether it has broken: whether it would have stood is not known any more.
    pub broken: bool,
}

/// When each was done first, s since the first frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FirstMinuteReport {
    /// A flask was taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub taken_s: Option<f64>,
    /// It was lifted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lifted_s: Option<f64>,
    /// It was poured into another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poured_s: Option<f64>,
    /// It was put down.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub put_down_s: Option<f64>,
}

/// What is known of one flask.
#[derive(Clone, Debug, Default)]
struct Known {
    held: Option<Hold>,
    /// Height at which it was let go (m) and when (s), until it is known whether it stands.
    let_go: Option<(f32, f64)>,
}

/// A flask in a hand.
#[derive(Clone, Debug)]
struct Hold {
    /// Height at which it was taken, m.
    height: f32,
    lifted: bool,
    /// Volume of the liquid in each flask then, mL; `None` before the first observation.
    before: Option<Vec<f64>>,
}

/// Which actions of a first minute the user has done, and when.
#[derive(Clone, Debug, Default)]
pub struct FirstMinute {
    /// Time of the first frame, s.
    began: Option<f64>,
    /// By lesson, when it was done, s.
    done: [Option<f64>; 4],
    flasks: Vec<Known>,
    /// The flask that a hand took last.
    last: Option<usize>,
}

impl FirstMinute {
    /// Another bench, or this one anew. What was learnt stays so.
    pub fn begin(&mut self) {
        self.flasks.clear();
        self.last = None;
    }

    /// Takes in the flasks of the frame that is shown at `time` (s).
    pub fn update(&mut self, flasks: &[Handled], time: f64) {
        self.began.get_or_insert(time);
        self.flasks.resize_with(flasks.len(), Known::default);
        for (index, flask) in flasks.iter().enumerate() {
            if flask.broken {
                self.flasks[index] = Known::default();
                continue;
            }
            for lesson in self.flasks[index].advance(flask, time) {
                self.does(lesson, time);
            }
        }
        // With one in each hand it is the one that was taken first.
        if !self.last.is_some_and(|last| self.is_held(last)) {
            let held = (0..flasks.len()).find(|flask| self.is_held(*flask));
            self.last = held.or(self.last);
        }
    }

    /// Takes in an observation: the volume of the liquid in each flask, mL, in the frame that is shown at `time` (s).
    pub fn looked(&mut self, millilitres: &[f64], time: f64) {
        let mut poured = false;
        for (index, known) in self.flasks.iter_mut().enumerate() {
            let Some(hold) = &mut known.held else {
                continue;
            };
            let before = hold.before.get_or_insert_with(|| millilitres.to_vec());
            let more = |(now, then): (&f64, &f64)| now - then;
            let mut others = millilitres.iter().zip(&*before).map(more).enumerate();
            let own = millilitres.get(index).zip(before.get(index)).map(more);
            let gave = own.is_some_and(|own| own <= -POURED);
            poured |= gave && others.any(|(other, more)| other != index && more >= POURED);
        }
        if poured {
            self.does(Lesson::Pour, time);
        }
    }

    /// The lesson that is to be shown: the first one that was not done yet. Pouring is left out where there is no other vessel to pour
    /// into.
    pub fn next(&self, can_pour: bool) -> Option<Lesson> {
        let mut lessons = Lesson::ALL.into_iter().filter(|it| self.is_new(*it));
        lessons.find(|lesson| can_pour || *lesson != Lesson::Pour)
    }

    /// The flask that is in a hand; of two the one that was taken first.
    pub fn flask(&self) -> Option<usize> {
        self.last.filter(|last| self.is_held(*last))
    }

    /// Whether one was let go, and it is not known yet whether it stands.
    pub fn waits(&self) -> bool {
        self.flasks.iter().any(|known| known.let_go.is_some())
    }

    /// When each was done.
    pub fn report(&self) -> FirstMinuteReport {
        let began = self.began.unwrap_or(0.0);
        let [taken_s, lifted_s, poured_s, put_down_s] =
            self.done.map(|time| time.map(|time| time - began));
        FirstMinuteReport {
            taken_s,
            lifted_s,
            poured_s,
            put_down_s,
        }
    }

    /// Whether it was not done yet.
    pub fn is_new(&self, lesson: Lesson) -> bool {
        self.done[lesson as usize].is_none()
    }

    /// Whether a flask is in a hand.
    pub fn is_held(&self, flask: usize) -> bool {
        self.flasks
            .get(flask)
            .is_some_and(|known| known.held.is_some())
    }

    /// Marks it, and what comes before it in any hand.
    fn does(&mut self, lesson: Lesson, time: f64) {
        let implied: &[Lesson] = match lesson {
            Lesson::Take => &[],
            Lesson::Lift => &[Lesson::Take],
            Lesson::Pour | Lesson::PutDown => &[Lesson::Take, Lesson::Lift],
        };
        for lesson in implied.iter().chain([&lesson]) {
            self.done[*lesson as usize].get_or_insert(time);
        }
    }
}

impl Known {
    /// Takes in a frame; what was done in it.
    fn advance(&mut self, flask: &Handled, time: f64) -> Vec<Lesson> {
        let mut done = Vec::new();
        if flask.held {
            self.let_go = None;
            let hold = self.held.get_or_insert(Hold {
                height: flask.height,
                lifted: false,
                before: None,
            });
            done.push(Lesson::Take);
            hold.lifted |= flask.height >= hold.height + LIFTED;
            if hold.lifted {
                done.push(Lesson::Lift);
            }
            return done;
        }
        if let Some(hold) = self.held.take() {
            self.let_go = hold.lifted.then_some((flask.height, time));
        }
        if let Some((height, since)) = self.let_go {
            let stays = (flask.height - height).abs() <= STAYS;
            let over = time - since >= SETTLES;
            if over && stays && flask.upright >= UPRIGHT {
                done.push(Lesson::PutDown);
            }
            if over || !stays {
                self.let_go = None;
            }
        }
        done
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flask that is whole.
    fn whole(held: bool, height: f32, upright: f32) -> Handled {
        Handled {
            held,
            height,
            upright,
            broken: false,
        }
    }

    /// Two flasks on a table, 90 frames a second; the first is the one that is handled.
    struct Bench {
        minute: FirstMinute,
        time: f64,
    }

    impl Bench {
        fn new() -> Self {
            let mut bench = Self {
                minute: FirstMinute::default(),
                time: 100.0,
            };
            bench.frame(false, 0.75, 1.0);
            bench
        }

        fn frame(&mut self, held: bool, height: f32, upright: f32) {
            let flasks = [whole(held, height, upright), whole(false, 0.75, 1.0)];
            self.minute.update(&flasks, self.time);
            self.time += 1.0 / 90.0;
        }

        fn look(&mut self, millilitres: [f64; 2]) {
            self.minute.looked(&millilitres, self.time);
        }

        /// Takes it, and holds it so high over the table, m.
        fn lift(&mut self, by: f32) {
            self.frame(true, 0.75, 1.0);
            self.look([150.0, 0.0]);
            self.frame(true, 0.75 + by, 1.0);
        }

        /// What is yet to be shown after a second in which it is not held.
        fn rests(&mut self, height: f32, upright: f32) -> Option<Lesson> {
            for _ in 0..90 {
                self.frame(false, height, upright);
            }
            self.minute.next(true)
        }
    }

    #[test]
    fn each_is_shown_until_it_was_done() {
        let mut bench = Bench::new();
        assert_eq!(bench.minute.next(true), Some(Lesson::Take));
        bench.frame(true, 0.75, 1.0);
        assert_eq!(bench.minute.next(true), Some(Lesson::Lift));
        bench.look([150.0, 0.0]);
        bench.frame(true, 0.81, 1.0);
        assert_eq!(bench.minute.next(true), Some(Lesson::Pour));
        bench.look([144.0, 5.5]);
        assert_eq!(bench.minute.next(true), Some(Lesson::PutDown));
        bench.frame(true, 0.75, 1.0);
        assert_eq!(bench.rests(0.75, 1.0), None);
        // And never again on another bench.
        bench.minute.begin();
        bench.frame(false, 0.75, 1.0);
        assert_eq!(bench.minute.next(true), None);
        let report = bench.minute.report();
        let times = [
            report.taken_s,
            report.lifted_s,
            report.poured_s,
            report.put_down_s,
        ];
        assert!(times.is_sorted() && times[0] > Some(0.0), "{report:?}");
        assert!(report.put_down_s > Some(0.5) && report.put_down_s < Some(0.7));
    }

    #[test]
    fn a_centimetre_is_not_lifted() {
        let mut bench = Bench::new();
        bench.lift(0.01);
        assert_eq!(bench.minute.next(true), Some(Lesson::Lift));
        // Nor is what was not lifted put down.
        assert_eq!(bench.rests(0.75, 1.0), Some(Lesson::Lift));
        assert_eq!(bench.minute.report().put_down_s, None);
        // Height counts from where it was taken.
        bench.frame(true, 0.95, 1.0);
        assert_eq!(bench.minute.next(true), Some(Lesson::Lift));
        bench.frame(true, 1.01, 1.0);
        assert_eq!(bench.minute.next(true), Some(Lesson::Pour));
    }

    #[test]
    fn what_goes_elsewhere_is_not_poured() {
        let mut bench = Bench::new();
        bench.lift(0.2);
        // Onto the bench; a few drops into the other flask.
        bench.look([90.0, 4.0]);
        assert_eq!(bench.minute.next(true), Some(Lesson::Pour));
        // The other one fills from elsewhere.
        let mut bench = Bench::new();
        bench.lift(0.2);
        bench.look([149.0, 30.0]);
        assert_eq!(bench.minute.next(true), Some(Lesson::Pour));
        // What was poured before counts no more once another hold begins.
        bench.rests(0.95, 1.0);
        bench.lift(0.2);
        bench.look([147.0, 32.0]);
        assert_eq!(bench.minute.next(true), Some(Lesson::Pour));
    }

    #[test]
    fn what_is_let_go_in_the_air_or_falls_over_is_not_put_down() {
        for (heights, upright) in [
            // It falls, and stands where it stood.
            (vec![0.95, 0.94, 0.88, 0.75], 1.0),
            // It is put down, and falls over.
            (vec![0.75], 0.3),
            // It is put on the table's edge, and falls after a while.
            (vec![0.75, 0.75, 0.75, 0.3], 1.0),
        ] {
            let mut bench = Bench::new();
            bench.lift(0.2);
            bench.look([140.0, 10.0]);
            let last = heights[heights.len() - 1];
            for height in heights {
                bench.frame(false, height, 1.0);
            }
            assert_eq!(bench.rests(last, upright), Some(Lesson::PutDown));
        }
    }

    #[test]
    fn who_pours_at_once_has_lifted_and_who_puts_down_first_still_pours() {
        let mut bench = Bench::new();
        // Tilted where it stands.
        bench.frame(true, 0.75, 1.0);
        bench.look([150.0, 0.0]);
        bench.frame(true, 0.76, 0.1);
        bench.look([120.0, 25.0]);
        assert_eq!(bench.minute.next(true), Some(Lesson::PutDown));

        let mut bench = Bench::new();
        bench.lift(0.2);
        bench.frame(true, 0.75, 1.0);
        assert_eq!(bench.rests(0.75, 1.0), Some(Lesson::Pour));
        bench.lift(0.2);
        bench.look([120.0, 25.0]);
        assert_eq!(bench.minute.next(true), None);
    }

    #[test]
    fn of_two_flasks_the_sign_stays_with_the_one_that_was_taken_first() {
        let mut minute = FirstMinute::default();
        let mut hold = |held: [bool; 2]| {
            minute.update(&held.map(|held| whole(held, 0.75, 1.0)), 0.0);
            minute.flask()
        };
        assert_eq!(hold([false, false]), None);
        assert_eq!(hold([false, true]), Some(1));
        assert_eq!(hold([true, true]), Some(1));
        assert_eq!(hold([true, false]), Some(0));
        assert_eq!(hold([false, false]), None);
    }

    /// It is slammed down and breaks: it is nowhere then, and stays there.
    #[test]
    fn what_breaks_is_not_put_down() {
        let mut bench = Bench::new();
        bench.lift(0.2);
        bench.look([140.0, 10.0]);
        assert_eq!(bench.minute.next(true), Some(Lesson::PutDown));
        for _ in 0..90 {
            let gone = Handled {
                broken: true,
                ..whole(false, -1000.0, 1.0)
            };
            bench.minute.update(&[gone, Handled::default()], bench.time);
            bench.time += 1.0 / 90.0;
        }
        assert_eq!(bench.minute.next(true), Some(Lesson::PutDown));
        assert_eq!((bench.minute.flask(), bench.minute.waits()), (None, false));
    }

    #[test]
    fn who_has_one_flask_alone_is_not_asked_to_pour() {
        let mut bench = Bench::new();
        bench.lift(0.2);
        assert_eq!(bench.minute.next(true), Some(Lesson::Pour));
        assert_eq!(bench.minute.next(false), Some(Lesson::PutDown));
        bench.frame(true, 0.75, 1.0);
        bench.frame(false, 0.75, 1.0);
        assert!(bench.minute.waits());
        bench.rests(0.75, 1.0);
        assert!(!bench.minute.waits());
        assert_eq!(bench.minute.next(false), None);
    }
}
