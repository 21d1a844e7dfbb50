//! A study in parts: each process runs a range of cases, and one report is made of theirs. It is that of one process that runs all,
//! but for what a clock says.

use std::fs;
use std::path::Path;

use crate::VITRIOL;

fn runs(folder: &Path, line: &str) {
    let output = VITRIOL.run(folder, line);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}: {errors}");
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
    VITRIOL.refuses(here, "trade --merge none/trade.json", &[&missing]);
    VITRIOL.refuses_each(here, "trade --merge none/trade.json --quick => --quick");
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

        runs(here, "extremes --cases 7..8 --out d");
        runs(here, "extremes --cases 5..5 --seed 2 --out e");
        fs::write(here.join("broken.json"), "{}").unwrap();
        VITRIOL.refuses_each(
            here,
            "
extremes --merge a/extremes.json all/extremes.json => 3..5
extremes --merge a/extremes.json d/extremes.json => 5..7
extremes --merge a/extremes.json e/extremes.json => seed 2
extremes --merge broken.json => broken.json: is no such report
extremes --merge nowhere.json => nowhere.json
extremes --cases 9..3 => 100..200
",
        );
    }
}
