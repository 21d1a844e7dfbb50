//! Some of the cases of `vitriol extremes`, evenly spaced among all two thousand.

use vitriol_shaders::Library;
use vitriol_study::extremes::{Verdict, cases, judge};
use vitriol_tests::gpu;

/// Judges every `stride`th case.
fn every(stride: usize) {
    let device = gpu::device();
    let library = Library::embedded();
    let mut refused = 0;
    for case in cases(2000, 1).iter().step_by(stride) {
        let finding = judge(&device, &library, case).unwrap();
        match finding.verdict {
            Verdict::Passed => {}
            Verdict::Refused { .. } => refused += 1,
            Verdict::Failed { reasons } => {
                panic!("--only {}: {}: {reasons:?}", finding.case, finding.label)
            }
        }
    }
    assert!(refused < 2000 / stride / 2, "{refused} were refused");
}

#[test]
fn every_four_hundredth_case_keeps_what_it_has_to() {
    every(400);
}

mod long {
    #[test]
    fn every_eightieth_case_keeps_what_it_has_to() {
        super::every(80);
    }
}

/// A scene 10 km off has the same bits as at its origin; the judge runs both.
#[test]
fn a_scene_ten_kilometres_off_has_the_same_bits() {
    let device = gpu::device();
    let library = Library::embedded();
    let all = cases(400, 1);
    let far = all
        .iter()
        .find(|case| case.extremes.len() == 1 && case.recipe.origin != [0.0; 3]);
    let finding = judge(&device, &library, far.unwrap()).unwrap();
    assert!(matches!(finding.verdict, Verdict::Passed), "{finding:?}");
}
