//! A study in parts: each process runs a range of cases, and one report is made of theirs. It is that of one process that runs all,
//! but for what a clock says.

use std::fs;
use std::path::Path;

use crate::VITRIOL;
use vitriol_tests::program::words;

fn runs(folder: &Path, line: &str) {
    let output = VITRIOL.run(folder, &words(line));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}: {errors}");
}

fn refuses(folder: &Path, line: &str, part: &str) {
    let output = VITRIOL.run(folder, &words(line));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{line}: {errors}");
    assert!(errors.contains(part), "{line}: {errors}");
}

/// The lines of a report that no clock has a part in.
fn lines(file: &Path) -> Vec<String> {
    let text = fs::read_to_string(file).unwrap();
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("\"seconds\": "));
    lines.map(str::to_owned).collect()
}

/// What is cheap of it: no case is run. `study/src/trade/report.rs` puts parts together.
#[test]
fn a_trade_says_how_many_cases_there_are_and_which_are_missing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    runs(here, "trade --quick --cases 0..0 --out none");
    let told = fs::read_to_string(here.join("none/trade.json")).unwrap();
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(told["cases"], serde_json::json!([0, 0]));
    let cases = told["of"].as_u64().unwrap();
    assert!(cases > 10, "{cases}");
    let missing = format!("0..{cases}");
    refuses(here, "trade --merge none/trade.json", &missing);
    refuses(here, "trade --merge none/trade.json --quick", "--quick");
}

mod long {
    use super::*;

    #[test]
    fn extremes_in_parts_are_one_report() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        for (cases, out) in [("3..6", "all"), ("3..5", "a"), ("5..5", "b"), ("5..6", "c")] {
            runs(here, &format!("extremes --cases {cases} --out {out}"));
        }
        runs(
            here,
            "extremes --merge c/extremes.json a/extremes.json b/extremes.json --out one",
        );
        let one = lines(&here.join("one/extremes.json"));
        assert_eq!(one, lines(&here.join("all/extremes.json")));
        assert!(one.contains(&"  \"cases\": 3,".to_owned()), "{one:?}");

        refuses(
            here,
            "extremes --merge a/extremes.json all/extremes.json",
            "3..5",
        );
        runs(here, "extremes --cases 7..8 --out d");
        refuses(
            here,
            "extremes --merge a/extremes.json d/extremes.json",
            "5..7",
        );
        runs(here, "extremes --cases 5..6 --seed 2 --out e");
        refuses(
            here,
            "extremes --merge a/extremes.json e/extremes.json",
            "seed 2",
        );
        fs::write(here.join("broken.json"), "{}").unwrap();
        refuses(
            here,
            "extremes --merge broken.json",
            "broken.json: is no such report",
        );
        refuses(here, "extremes --merge nowhere.json", "nowhere.json");
        refuses(here, "extremes --cases 9..3", "100..200");
    }
}
