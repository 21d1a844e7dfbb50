//! The lesson `dilute`, and the examination, gone through.

use super::*;

/// The bench of a dilution, and whether a hand holds the acid's beaker.
fn diluting(t_s: f64, held: bool, volume_ml: f64, acid: f64) -> Sight {
    let mut sight = sight(t_s);
    sight.flasks[0].name = "source".to_owned();
    sight.flasks[1].name = "target".to_owned();
    (sight.flasks[0].held, sight.flasks[0].standing) = (held, !held);
    sight.sash_m = Some(0.3);
    (sight.flasks[1].volume_m3, sight.flasks[1].acid) = (volume_ml * 1e-6, acid);
    sight
}

/// A slow pour of acid into the water.
fn portion(times: [f64; 2], ml: f64) -> Event {
    let Event::Poured(pour) = pour(times, ml, 4.5, 0.98) else {
        panic!()
    };
    Event::Poured(Pour {
        from: "source".to_owned(),
        into: Some("target".to_owned()),
        ..pour
    })
}

/// The correct dilution, from its first observation to its points.
#[test]
fn who_dilutes_correctly_has_all_points() {
    for (name, mode) in [
        ("dilute", Mode::Guided),
        ("dilute", Mode::Free),
        ("examination", Mode::Examination),
    ] {
        let mut procedure = Procedure::new(Lesson::builtin(name).unwrap(), mode);
        let dip = |speed_m_s: f64| {
            Some(Dip {
                flask: Some("target".to_owned()),
                speed_m_s,
            })
        };
        // Goggles and gloves lie on the bench at first.
        let mut bare = diluting(0.0, false, 160.0, 0.0);
        (bare.goggles, bare.gloves) = (Some(false), Some([false; 2]));
        procedure.advance(&bare, &[]);
        (bare.t_s, bare.goggles) = (0.5, Some(true));
        procedure.advance(&bare, &[]);
        procedure.advance(&diluting(0.8, false, 160.0, 0.0), &[]);
        procedure.advance(&diluting(1.0, true, 160.0, 0.0), &[]);
        let first = portion([2.0, 5.0], 9.0);
        procedure.advance(&diluting(6.0, true, 169.0, 0.09), &[first]);
        // One hand stirs, the other still holds the beaker.
        for tenths in 1..40 {
            let mut sight = diluting(6.0 + f64::from(tenths) / 10.0, true, 169.0, 0.09);
            sight.rod = dip(0.1);
            procedure.advance(&sight, &[]);
        }
        let rest = portion([11.0, 14.0], 10.0);
        procedure.advance(&diluting(15.0, true, 179.0, 0.17), &[rest]);
        for tenths in 0..160 {
            let mut sight = diluting(15.1 + f64::from(tenths) / 10.0, false, 179.0, 0.175);
            // First the rod, then the thermometer.
            (sight.rod, sight.thermometer) = match tenths {
                0..60 => (dip(0.1), None),
                _ => (None, dip(0.0)),
            };
            procedure.advance(&sight, &[]);
        }
        let verdict = procedure.verdict();
        assert_eq!((verdict.points, verdict.of), (100, 100), "{verdict:?}");
        assert!(procedure.state().over);
    }
}

/// All the acid in one go is too much, and so is a second portion before the first is stirred in.
#[test]
fn acid_waits_until_the_portion_before_is_stirred_in() {
    for portions in [&[19.0][..], &[9.0, 10.0]] {
        let lesson = Lesson::builtin("dilute").unwrap();
        let mut procedure = Procedure::new(lesson, Mode::Guided);
        procedure.advance(&diluting(0.0, true, 160.0, 0.0), &[]);
        let mut said = Vec::new();
        for (t, ml) in [2.0, 8.0].into_iter().zip(portions) {
            let sight = diluting(t + 4.0, true, 170.0, 0.09);
            said.extend(procedure.advance(&sight, &[portion([t, t + 3.0], *ml)]));
        }
        let too_much = |it: &&Progress| {
            let Progress::StepFailed { id, why, .. } = it else {
                return false;
            };
            id == "pour" && matches!(why, Why::TooMuch { .. })
        };
        assert_eq!(said.iter().filter(too_much).count(), 1, "{said:?}");
    }
}
