//! A constant of one file, changed for all shaders that include it.

use vitriol_shaders::{Library, ShaderError, ShaderId};

const MAIN: ShaderId = ShaderId::new("sim/main.wgsl");

#[test]
fn a_number_is_changed_at_its_place_only() {
    let library = Library::from_sources([
        (
            MAIN.path(),
            "//!include common/a.wgsl\nconst REACH: f32 = 2.0;\n",
        ),
        (
            "common/a.wgsl",
            "const WAIT: f32 = 0.0435;\nconst TWICE: f32 = 2.0 * WAIT;\n",
        ),
    ]);
    let before = library.source(&MAIN).unwrap();
    assert_eq!(library.number("common/a.wgsl", "WAIT"), Ok(0.0435));
    // It has been asked for already, and is made anew.
    let library = library
        .with_number_times("common/a.wgsl", "WAIT", 2.0)
        .unwrap();
    let after = library.source(&MAIN).unwrap();
    assert_eq!(after, before.replace("= 0.0435;", "= 0.087;"));
    assert_eq!(library.number("common/a.wgsl", "WAIT"), Ok(0.087));
}

#[test]
fn what_is_no_number_is_refused() {
    let library = Library::from_sources([("common/a.wgsl", "const A: f32 = 1.0 / 3.0;\n")]);
    let of = |path, name| library.number(path, name);
    assert!(matches!(
        of("common/a.wgsl", "A"),
        Err(ShaderError::NoNumber { .. })
    ));
    assert!(matches!(
        of("common/b.wgsl", "A"),
        Err(ShaderError::UnknownShader { .. })
    ));
}
