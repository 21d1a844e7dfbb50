//! What cannot be exported.

use std::fs;

use crate::VITRIOL;

/// What cannot be exported is refused in a word, and nothing is left.
#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("empty")).unwrap();
    fs::create_dir(here.join("odd")).unwrap();
    fs::write(here.join("odd/report.json"), "{}").unwrap();
    fs::create_dir(here.join("broken")).unwrap();
    fs::write(here.join("broken/report.json"), "{\"layout\": ").unwrap();
    fs::create_dir(here.join("later")).unwrap();
    fs::write(here.join("later/report.json"), "{\"layout\": 2}").unwrap();
    // A report from anyone does not make the program open a file: neither its text nor whether it is there is told.
    fs::write(here.join("secret.toml"), "password = 1").unwrap();
    VITRIOL.object(
        here,
        "replay hands-off --scene beaker --preset fast --seconds 0.01 --no-video --out theirs",
    );
    let report = fs::read_to_string(here.join("theirs/report.json")).unwrap();
    let report = report.replace("\"scene\": \"beaker\"", "\"scene\": \"secret.toml\"");
    fs::write(here.join("theirs/report.json"), report).unwrap();
    VITRIOL.refuses_each(
        here,
        "
export hands-off --format stl --out out => vtk
export empty --format csv --out out => report.json
export odd --format csv --out out => no report
export broken --format csv --out out => make it again with `vitriol replay`
export later --format csv --out out => the layout 2
export theirs --format vtk --out out => name it with --scene
export hands-off --scene beaker --format csv --at 0.1 --out out => leave csv
export hands-off --scene beaker --format vtk --at 1e3 --out out => ends at
export hands-off --format csv --from 1e6 --out out => ends at
export hands-off --format vtk --at 1 --seconds 2 --out out => cannot be used
",
    );
    assert!(!here.join("out").exists());
}
