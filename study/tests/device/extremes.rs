//! Some of the cases of `vitriol extremes`, evenly spaced among all two thousand.

use vitriol_shaders::Library;
use vitriol_study::extremes::{Verdict, cases, judge};
use vitriol_tests::gpu;

/// Judges the cases of those numbers, fewer than half of which may be refused at load.
fn keep_what_they_have_to(numbers: impl Fn(usize) -> bool) {
    let device = gpu::device();
    let library = Library::embedded();
    let (mut judged, mut refused) = (0, 0);
    for case in cases(2000, 1).iter().filter(|case| numbers(case.number)) {
        let finding = judge(&device, &library, case).unwrap();
        judged += 1;
        match finding.verdict {
            Verdict::Passed => {}
            Verdict::Refused { .. } => refused += 1,
            Verdict::Failed { reasons } => {
                panic!("--only {}: {}: {reasons:?}", finding.case, finding.label)
            }
        }
    }
    assert!(refused < judged / 2, "{refused} of {judged} were refused");
}

#[test]
fn every_four_hundredth_case_keeps_what_it_has_to() {
    keep_what_they_have_to(|number| number.is_multiple_of(400));
}

mod long {
    /// Those of the quick test are left out.
    #[test]
    fn every_eightieth_case_keeps_what_it_has_to() {
        let eightieth = |number: usize| number.is_multiple_of(80) && !number.is_multiple_of(400);
        super::keep_what_they_have_to(eightieth);
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
