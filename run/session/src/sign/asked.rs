//! What a first user is asked to do, by the step of a lesson or else by the scene, and which sign shows it.

use vitriol_lesson::procedure::{Condition, HandName};
use vitriol_sim::bodies::Worn;
use vitriol_sim::scene::{Scene, ToolKind};

use super::place::{Stands, Target};
use crate::first_minute::{FirstMinute, Lesson};

/// Name of the flask that is poured from, in the scenes that come with the program.
const SOURCE: &str = "source";

/// What is to be done next, and with which thing. Flasks are indices in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// A flask is to be poured into another one, and put down. All liquids are the same, so any flask will do.
    Any,
    /// This flask is to be poured into the nearest other one, and put down.
    Source(usize),
    /// This tool is to be taken and put on.
    Tool(ToolKind),
    /// This flask is to be taken.
    Taken(usize),
    /// The first flask is to be poured into the second one.
    Poured(usize, usize),
    /// This flask is to be put down.
    PutDown(usize),
    /// Nothing that a sign shows.
    Nothing,
}

impl Asked {
    /// By a scene without a lesson. Where its liquids differ, the name of a flask alone says which one is poured.
    pub fn by_scene(scene: &Scene) -> Self {
        let mut pairs = scene.liquids.windows(2);
        if pairs.all(|pair| pair[0].acid_fraction == pair[1].acid_fraction) {
            return Self::Any;
        }
        flask(scene, SOURCE).map_or(Self::Nothing, Self::Source)
    }

    /// By what is [left](vitriol_lesson::Procedure::left) of a lesson's step, for a user who has `worn` on: by the first part that a sign can
    /// show.
    pub fn by_step(left: &[&Condition], scene: &Scene, worn: Worn) -> Self {
        let mut asked = left.iter().map(|part| Self::by_part(part, scene, worn));
        asked
            .find(|it| *it != Self::Nothing)
            .unwrap_or(Self::Nothing)
    }

    fn by_part(part: &Condition, scene: &Scene, worn: Worn) -> Self {
        let of =
            |name: &str, asked: fn(usize) -> Self| flask(scene, name).map_or(Self::Nothing, asked);
        match part {
            Condition::Lifted(it) => of(&it.flask, Self::Taken),
            Condition::PutDown(it) => of(&it.flask, Self::PutDown),
            Condition::Poured(it) => match (flask(scene, &it.from), flask(scene, &it.into)) {
                (Some(from), Some(into)) => Self::Poured(from, into),
                _ => Self::Nothing,
            },
            Condition::Goggles(it) if it.on && worn.goggles == Some(false) => {
                Self::Tool(ToolKind::Goggles)
            }
            Condition::Gloves(it) if it.on && lacks_glove(it.hand, worn) => {
                Self::Tool(ToolKind::Gloves)
            }
            _ => Self::Nothing,
        }
    }

    /// The sign that shows it, and where that is; `None` for no sign. `minute` has what the user has done, and `tool` gives a tool that no
    /// hand holds.
    pub fn sign(
        self,
        minute: &FirstMinute,
        flasks: &[Stands],
        tool: impl Fn(ToolKind) -> Option<Stands>,
    ) -> Option<(Lesson, Target)> {
        let can_pour = flasks.iter().filter(|it| !it.broken).count() > 1;
        let next = minute.next(can_pour)?;
        // Before the first observation no flask is known to hold anything.
        let any_full = flasks.iter().any(Stands::can_be_poured);
        let is_empty =
            |flask: usize| any_full && !flasks.get(flask).is_some_and(Stands::can_be_poured);
        let in_hand = |flask: usize, into: Option<usize>| match next {
            Lesson::Pour if is_empty(flask) => None,
            Lesson::Pour => Some((next, Target::Into { from: flask, into })),
            _ => Some((next, Target::Flask(flask))),
        };
        let wanted = match self {
            Self::Nothing => return None,
            Self::Any => {
                let held = minute.flask().and_then(|flask| in_hand(flask, None));
                // It was let go, or is empty, and the rest is still to be done.
                return held.or(Some((Lesson::Take, Target::Any)));
            }
            Self::Tool(_) => None,
            Self::Source(flask)
            | Self::Taken(flask)
            | Self::Poured(flask, _)
            | Self::PutDown(flask) => Some(flask),
        };
        let is_held = wanted.is_some_and(|flask| minute.is_held(flask));
        if let (false, Some(other)) = (is_held, minute.flask()) {
            return Some((Lesson::PutDown, Target::Flask(other)));
        }
        match (self, is_held) {
            (Self::Tool(kind), _) => tool(kind).map(|it| (Lesson::Take, Target::Thing(it))),
            (Self::Source(flask) | Self::Poured(flask, _), false) if is_empty(flask) => None,
            (Self::Source(flask) | Self::Taken(flask) | Self::Poured(flask, _), false) => {
                let stands = flasks.get(flask).filter(|it| it.can_be_taken);
                stands.map(|_| (Lesson::Take, Target::Flask(flask)))
            }
            (Self::Source(flask), true) => in_hand(flask, None),
            // It is put down in another step.
            (Self::Poured(flask, into), true) if next != Lesson::PutDown => {
                in_hand(flask, Some(into))
            }
            (Self::PutDown(flask), true) if minute.is_new(Lesson::PutDown) => {
                Some((Lesson::PutDown, Target::Flask(flask)))
            }
            _ => None,
        }
    }
}

/// Index of the flask of that name.
fn flask(scene: &Scene, name: &str) -> Option<usize> {
    scene.flasks.iter().position(|flask| flask.name == name)
}

/// Whether that hand, or without one either hand, has no glove on.
fn lacks_glove(hand: Option<HandName>, worn: Worn) -> bool {
    let Some([left, right]) = worn.gloves else {
        return false;
    };
    match hand {
        Some(HandName::LeftHand) => !left,
        Some(HandName::RightHand) => !right,
        None => !(left && right),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::first_minute::Handled;
    use glam::Vec3;
    use vitriol_lesson::{Event, Lesson as Course, Mode, Pour, Procedure, Sight};

    /// Source and target, as the scenes' files have them.
    const SOURCE: usize = 0;
    const TARGET: usize = 1;

    fn scene(name: &str) -> Scene {
        Scene::builtin(name).unwrap()
    }

    fn worn(goggles: bool, gloves: [bool; 2]) -> Worn {
        Worn {
            goggles: Some(goggles),
            gloves: Some(gloves),
        }
    }

    /// A lesson whose steps before that of this id were left out.
    fn at_step(lesson: &str, id: &str) -> Procedure {
        let mut procedure = Procedure::new(Course::builtin(lesson).unwrap(), Mode::Guided);
        procedure.advance(&Sight::default(), &[]);
        loop {
            let state = procedure.state();
            let open = &state.steps[state.number.unwrap() - 1].id;
            if open == id {
                return procedure;
            }
            procedure.skip(open, 0.0);
        }
    }

    /// What is asked for in the lesson's scene.
    fn asked(procedure: &Procedure, worn: Worn) -> Asked {
        Asked::by_step(&procedure.left(), &scene(&procedure.lesson().scene), worn)
    }

    /// What the step of that id asks for.
    fn step(lesson: &str, id: &str, worn: Worn) -> Asked {
        asked(&at_step(lesson, id), worn)
    }

    /// Flasks with that much in them, mL.
    fn stand(millilitres: [f64; 2]) -> [Stands; 2] {
        millilitres.map(|millilitres| Stands {
            middle: Vec3::ZERO,
            height: 0.1,
            millilitres,
            can_be_taken: true,
            broken: false,
        })
    }

    /// A user after the frames in which these flasks were held, each so high, m.
    fn minute(frames: &[[Option<f32>; 2]]) -> FirstMinute {
        let mut minute = FirstMinute::default();
        for (n, heights) in frames.iter().enumerate() {
            let flasks = heights.map(|height| Handled {
                held: height.is_some(),
                height: height.unwrap_or(0.75),
                upright: 1.0,
                broken: false,
            });
            minute.update(&flasks, n as f64);
        }
        minute
    }

    /// The sign for a user in a scene with 20 mL in the source and 160 mL in the target.
    fn sign(asked: Asked, minute: &FirstMinute) -> Option<(Lesson, Target)> {
        let tool = |kind: ToolKind| {
            let height = kind.cylinder()[1] as f32;
            Some(Stands {
                height,
                ..stand([0.0; 2])[0]
            })
        };
        asked.sign(minute, &stand([20.0, 160.0]), tool)
    }

    const AWAY: [Option<f32>; 2] = [None, None];
    const TAKEN: [Option<f32>; 2] = [Some(0.75), None];
    const LIFTED: [Option<f32>; 2] = [Some(0.85), None];
    const OTHER: [Option<f32>; 2] = [None, Some(0.85)];

    /// Acid into water and water into acid both pour the small beaker, which holds less.
    #[test]
    fn a_scene_asks_for_what_is_poured_in_it() {
        for name in [
            "acid-into-water",
            "water-into-acid",
            "hot-acid",
            "fume-hood",
        ] {
            let asked = Asked::by_scene(&scene(name));
            assert_eq!(asked, Asked::Source(SOURCE), "{name}");
        }
        // One liquid, and two whose flasks have other names.
        for name in ["two-flasks", "three-flasks", "beaker"] {
            assert_eq!(Asked::by_scene(&scene(name)), Asked::Any, "{name}");
        }
        for name in ["single-dilution", "acid-on-glove"] {
            assert_eq!(Asked::by_scene(&scene(name)), Asked::Nothing, "{name}");
        }
    }

    #[test]
    fn a_step_asks_for_its_own_thing() {
        let bare = worn(false, [false; 2]);
        let dressed = worn(true, [true; 2]);
        let dress = |worn| step("dilute", "dress", worn);
        assert_eq!(dress(bare), Asked::Tool(ToolKind::Goggles));
        assert_eq!(dress(worn(true, [false; 2])), Asked::Tool(ToolKind::Gloves));
        assert_eq!(
            dress(worn(true, [true, false])),
            Asked::Tool(ToolKind::Gloves)
        );
        assert_eq!(dress(dressed), Asked::Nothing);
        let of = |id| step("dilute", id, dressed);
        assert_eq!(of("lift"), Asked::Taken(SOURCE));
        assert_eq!(of("pour"), Asked::Poured(SOURCE, TARGET));
        assert_eq!(of("put-down"), Asked::PutDown(SOURCE));
        // Rod, thermometer, cloth and answers.
        for id in ["stir", "measure", "concentration", "wipe"] {
            assert_eq!(of(id), Asked::Nothing, "{id}");
        }
        assert_eq!(step("wrong-order", "predict", dressed), Asked::Nothing);
        // A glove is to be taken off.
        assert_eq!(step("emergency", "glove-off", dressed), Asked::Nothing);
    }

    /// Of acid and stirring, once the acid is poured: a rod has no sign.
    #[test]
    fn what_is_done_of_a_step_is_asked_for_no_more() {
        let dressed = worn(true, [true; 2]);
        let mut pour = at_step("dilute", "pour");
        assert_eq!(asked(&pour, dressed), Asked::Poured(SOURCE, TARGET));
        let sight = Sight {
            t_s: 5.0,
            ..Sight::default()
        };
        let poured = |ml: f64| {
            Event::Poured(Pour {
                t_s: 1.0,
                until_s: 4.0,
                from: "source".to_owned(),
                into: Some("target".to_owned()),
                volume_m3: 1e-6 * ml,
                fastest_m3_s: 3e-6,
                acid: 0.98,
                met: None,
                bare_face: false,
            })
        };
        pour.advance(&sight, &[poured(1.0)]);
        assert_eq!(asked(&pour, dressed), Asked::Poured(SOURCE, TARGET));
        pour.advance(&sight, &[poured(9.0)]);
        assert_eq!(asked(&pour, dressed), Asked::Nothing);
        assert_eq!(pour.state().number, Some(3));
    }

    #[test]
    fn the_sign_is_at_what_is_asked_for() {
        let new = minute(&[AWAY]);
        let take = Some((Lesson::Take, Target::Flask(SOURCE)));
        for asked in [
            Asked::Source(SOURCE),
            Asked::Taken(SOURCE),
            Asked::Poured(SOURCE, TARGET),
        ] {
            assert_eq!(sign(asked, &new), take, "{asked:?}");
        }
        let goggles = sign(Asked::Tool(ToolKind::Goggles), &new);
        let is_goggles = |it: &(Lesson, Target)| {
            it.0 == Lesson::Take && matches!(it.1, Target::Thing(it) if it.height == 0.06)
        };
        assert!(goggles.as_ref().is_some_and(is_goggles), "{goggles:?}");
        assert_eq!(sign(Asked::PutDown(SOURCE), &new), None);
        assert_eq!(sign(Asked::Nothing, &new), None);
        assert_eq!(sign(Asked::Any, &new), Some((Lesson::Take, Target::Any)));
    }

    #[test]
    fn in_the_hand_it_is_lifted_and_poured_into_the_right_one() {
        let pour = Asked::Poured(SOURCE, TARGET);
        let taken = minute(&[AWAY, TAKEN]);
        assert_eq!(
            sign(pour, &taken),
            Some((Lesson::Lift, Target::Flask(SOURCE)))
        );
        assert_eq!(sign(Asked::Taken(SOURCE), &taken), None);
        let lifted = minute(&[AWAY, TAKEN, LIFTED]);
        let into = |into| {
            let from = SOURCE;
            Some((Lesson::Pour, Target::Into { from, into }))
        };
        assert_eq!(sign(pour, &lifted), into(Some(TARGET)));
        assert_eq!(sign(Asked::Source(SOURCE), &lifted), into(None));
        // It was skipped, or poured before.
        let put_down = Some((Lesson::PutDown, Target::Flask(SOURCE)));
        assert_eq!(sign(Asked::PutDown(SOURCE), &lifted), put_down);
        let mut poured = lifted;
        poured.looked(&[20.0, 160.0], 3.0);
        poured.looked(&[10.0, 170.0], 4.0);
        assert_eq!(sign(Asked::Source(SOURCE), &poured), put_down);
        assert_eq!(sign(pour, &poured), None);
    }

    /// Who has the other flask in the hand is not told to pour it.
    #[test]
    fn a_wrong_flask_is_put_down() {
        let other = minute(&[AWAY, [None, Some(0.75)], OTHER]);
        for asked in [
            Asked::Source(SOURCE),
            Asked::Poured(SOURCE, TARGET),
            Asked::Tool(ToolKind::Goggles),
        ] {
            let expected = Some((Lesson::PutDown, Target::Flask(TARGET)));
            assert_eq!(sign(asked, &other), expected, "{asked:?}");
        }
        // Any will do where both hold water.
        let pour = sign(Asked::Any, &other).unwrap();
        assert_eq!(pour.0, Lesson::Pour);
        // It is only steadied while the right one is in the other hand.
        let both = minute(&[AWAY, [None, Some(0.75)], [Some(0.75), Some(0.75)]]);
        let lift = Some((Lesson::Lift, Target::Flask(SOURCE)));
        assert_eq!(sign(Asked::Source(SOURCE), &both), lift);
    }

    /// Once the source is empty the other liquid is not shown in its place.
    #[test]
    fn what_is_empty_has_no_sign() {
        let none = |_: ToolKind| None;
        let spilt = stand([1.0, 160.0]);
        let new = minute(&[AWAY]);
        let lifted = minute(&[AWAY, TAKEN, LIFTED]);
        for minute in [&new, &lifted] {
            assert_eq!(Asked::Source(SOURCE).sign(minute, &spilt, none), None);
        }
        let any = Asked::Any.sign(&lifted, &spilt, none);
        assert_eq!(any, Some((Lesson::Take, Target::Any)));
        // A tool that is in a hand, or not there.
        let goggles = Asked::Tool(ToolKind::Goggles);
        assert_eq!(goggles.sign(&new, &spilt, none), None);
    }
}
