//! What an option's value is held to: a number to its quantity, a file's name to its format, a name to those that there are.

use std::fs;

use super::{VITRIOL, text};

/// A number that looks like an option is answered with its bound, not with how to give a file of that name.
#[test]
fn a_negative_number_is_answered_with_its_bound() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let table = "
replay x --seconds -1 => above 0
replay x --budget-ms -0.5 => above 0
replay x --seed -1 => from 0 to 18446744073709551615
replay x --solver -1x2 => two whole numbers above 0 with an x between them, such as 10x3
picture x -o x.png --at -1 => above 0
picture x -o x.png --at 1 --size -9x9 => two whole numbers above 0
picture x -o x.png --at 1 --field -1 => 1 to 150 degrees
export x --format vtk --from -1 => 0 or more
export x --format vtk --at -1 => 0 or more
export x --format vtk --rate -1 => 1 to 1000
grade x --scene beaker --jobs -1 => from 1 to 4294967295
grade x --scene beaker --verify --tolerance -1,5,0.1 => such as 0.2,5,0.1
vr --stand-in x --rate -1 => 1 to 1000
vr --frames -1 => from 1 to
desk --frames -1 => from 1 to
desk --size -9x9 => two whole numbers above 0
desk --fov -40 => 20 to 75 degrees
desk --scale -1 => 0.5 to 2
bench --frames -1 => from 1 to
trade --within -1 => above 0
extremes --cases -1 => a range of them
extremes --only -1 => from 0 to
";
    VITRIOL.refuses_each(here, table);
    for row in table.trim().lines() {
        let (line, _) = row.split_once("=>").unwrap();
        let output = VITRIOL.run(here, line);
        let message = text(&output.stderr);
        assert!(!message.contains("'-- "), "{line}: {message}");
    }
    // A run's first moment is at zero; here it is the track alone that there is not.
    for first in ["--from", "--at"] {
        let line = format!("export nowhere --format vtk --out new {first} 0");
        VITRIOL.refuses(here, &line, &["nowhere: neither a file"]);
    }
}

/// An option that there is not is a mistyped one, and no file of that name.
#[test]
fn an_unknown_option_is_not_taken_for_a_file() {
    let folder = tempfile::tempdir().unwrap();
    for (line, part) in [
        ("picture two-flasks --fov 50", "unexpected argument '--fov'"),
        ("replay x --secnds 3", "'--seconds'"),
    ] {
        VITRIOL.refuses(folder.path(), line, &[part]);
        let output = VITRIOL.run(folder.path(), line);
        let message = text(&output.stderr);
        assert!(!message.contains("'-- "), "{line}: {message}");
    }
}

/// Some of these ended in an overflow, others would have filled memory or begun a thread for each.
#[test]
fn a_number_that_is_too_large_is_answered_with_its_bound() {
    let folder = tempfile::tempdir().unwrap();
    // The widest picture is not refused for its size: there it is the track alone that there is not.
    VITRIOL.refuses_each(
        folder.path(),
        "
picture x -o x.png --at 1 --size 100000x100000 => at most 16384 pixels
vr --stand-in x --size 16385x1 => at most 16384 pixels
desk --size 16385x1 => at most 16384 pixels
desk --fov 75.1 => 20 to 75 degrees
desk --scale 2.1 => 0.5 to 2
bench --render --size 1x16385 => at most 16384 pixels
vr --frames 18446744073709551615 => from 1 to 1000000
bench --frames 1000001 => from 1 to 1000000
bench --scaling x.svg --most 50000001 => from 1000 to 50000000
extremes --only 18446744073709551615 => from 0 to 999999
extremes --cases 1000001 => up to 1000000
vr --stand-in x --frames 1 --watchers 257 => from 1 to 256
picture nowhere -o x.png --at 1 --size 16384x16384 => nowhere: neither a file
",
    );
}

/// It was said of 18446744073709551615 steps. A million steps of 1/90 s are 11,111 s.
#[test]
fn a_run_that_is_too_long_is_answered_with_what_was_given() {
    let folder = tempfile::tempdir().unwrap();
    VITRIOL.refuses_each(
        folder.path(),
        "
replay two-flasks --no-video --seconds 1e300 => 1e300 s; which is 11111 s; --seconds or --at
export two-flasks --format vtk --at 1e300 => 1e300 s; which is 11111 s; --seconds or --at
picture two-flasks -o x.png --at 1e300 => ends at 9.6; 1e300 s
",
    );
}

/// It was simulated for minutes, with hands that stood still.
#[test]
fn a_picture_is_of_a_moment_within_its_track() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let picture = "picture rinse-the-bottle --preset fast -o late.png --at 99";
    VITRIOL.refuses(here, picture, &["ends at 9.6", "99 s"]);
    assert_eq!(fs::read_dir(here).unwrap().count(), 0);
}

#[test]
fn a_files_name_ends_as_its_format() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    VITRIOL.refuses_each(
        here,
        "
picture two-flasks --at 1 -o x.jpg => ends in .png
lesson dilute --film x.webm => ends in .mp4
track two-flasks -o x.csv => ends in .mcap
track two-flasks -o x => ends in .mcap
vr --record x.mp4 => ends in .mcap
bench --scaling x.png => ends in .svg
",
    );
    assert_eq!(fs::read_dir(here).unwrap().count(), 0);
}

#[test]
fn a_misspelt_name_is_answered_with_the_one_that_is_meant() {
    let folder = tempfile::tempdir().unwrap();
    VITRIOL.refuses_each(
        folder.path(),
        "
replay two-flask --no-video => did you mean two-flasks?
track dilutte => did you mean dilute?
replay two-flasks --scene watter-into-acid --out new => did you mean water-into-acid?
lesson examinaton => did you mean examination?
",
    );
}

/// The console's address came first, of a session that never began.
#[test]
fn a_session_that_cannot_begin_prints_no_address() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("there.mcap"), "").unwrap();
    for (line, cause) in [
        ("vr --stand-in two-flask", "did you mean two-flasks?"),
        ("vr --stand-in two-flasks --device nowhere", "nowhere"),
        (
            "vr --stand-in two-flasks --record there.mcap",
            "there.mcap: exists",
        ),
    ] {
        VITRIOL.refuses(here, line, &[cause]);
        let output = VITRIOL.run(here, line);
        let said = text(&output.stderr);
        assert!(said.starts_with("vitriol: "), "{line}: {said}");
    }
}

/// Without a device, and without `--cost`.
#[test]
fn scenes_are_listed_under_one_preset() {
    let folder = tempfile::tempdir().unwrap();
    let presets = |line: &str| {
        let list = VITRIOL.object(folder.path(), line);
        let scenes = list["scenes"].as_array().unwrap().clone();
        let lengths = scenes
            .iter()
            .map(|it| it["presets"].as_array().unwrap().len());
        let first = scenes[0]["presets"][0]["preset"].clone();
        (lengths.collect::<Vec<_>>(), first)
    };
    let (all, first) = presets("scenes");
    assert!(
        all.iter().all(|it| *it == 3) && first == "fast",
        "{all:?} {first}"
    );
    let (one, only) = presets("scenes --preset reference");
    assert!(
        one.iter().all(|it| *it == 1) && only == "reference",
        "{one:?} {only}"
    );
    assert_eq!(one.len(), all.len());
}
