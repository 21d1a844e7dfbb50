//! Includes: their expansion, and errors that point at the file that a person wrote.

use vitriol_shaders::{Library, ShaderError, ShaderId};

const MAIN: ShaderId = ShaderId::new("sim/main.wgsl");

fn place(library: &Library) -> (String, u32, u32, String) {
    match library.source(&MAIN) {
        Err(ShaderError::Source {
            file,
            line,
            column,
            message,
        }) => (file, line, column, message),
        other => panic!("a source error was due: {other:?}"),
    }
}

#[test]
fn a_file_enters_once_though_two_include_it() {
    let library = Library::from_sources([
        (
            MAIN.path(),
            "//!include common/a.wgsl\n//!include common/b.wgsl\n",
        ),
        (
            "common/a.wgsl",
            "//! On a.\n//!include common/k.wgsl\nconst A = K;\n",
        ),
        (
            "common/b.wgsl",
            "  //!include common/k.wgsl\r\nconst B = K;\r\n",
        ),
        ("common/k.wgsl", "const K = 1.0;"),
    ]);
    let source = library.source(&MAIN).unwrap();
    let code: Vec<&str> = source.lines().filter(|l| !l.starts_with("//")).collect();
    assert_eq!(code, ["const K = 1.0;", "const A = K;", "const B = K;"]);
}

#[test]
fn errors_keep_their_file_and_line() {
    let main = "//!include common/a.wgsl\n\n//!include common/b.wgsl\nconst M = A + B;\n";
    let a = "const A = 1.0;\n";
    let library = |main: &str, b: &str| {
        Library::from_sources([
            (MAIN.path(), main),
            ("common/a.wgsl", a),
            ("common/b.wgsl", b),
        ])
    };
    assert!(library(main, "const B = 2.0;").source(&MAIN).is_ok());

    // A name that naga's parser does not find.
    let (file, line, column, message) = place(&library(main, "\n\nconst B = missing;"));
    assert_eq!((file.as_str(), line, column), ("common/b.wgsl", 3, 11));
    assert!(message.contains("missing"), "{message}");

    // The same after an include, in the outer file.
    let outer = main.replace("A + B", "A + C");
    let (file, line, column, _) = place(&library(&outer, "const B = 2.0;"));
    assert_eq!((file.as_str(), line, column), (MAIN.path(), 4, 15));

    // It parses but does not validate: a barrier that not all invocations reach is an error of the validator's. Line 3 of b holds the
    // statement.
    let b = "const B = 2.0;\n\
             @compute @workgroup_size(1) fn main(@builtin(subgroup_size) n: u32) {\n\
             var x = 1.0; if n > 1u { x = f32(n); } else { discard; }\n\
             }";
    let (file, line, _, message) = place(&library(main, b));
    assert_eq!(file, "common/b.wgsl", "{message}");
    assert!((2..=3).contains(&line), "{line}: {message}");

    // An entry point's argument of a wrong type, for which naga gives no place.
    let b = "const B = 2.0;\n\n@vertex\nfn main(@builtin(view_index) v: i32)\n\
             -> @builtin(position) vec4<f32> { return vec4(f32(v)); }";
    let (file, line, column, _) = place(&library(main, b));
    assert_eq!((file.as_str(), line, column), ("common/b.wgsl", 4, 1));
}

#[test]
fn bad_includes_are_refused_where_they_stand() {
    let circle = Library::from_sources([
        (MAIN.path(), "//!include common/a.wgsl"),
        ("common/a.wgsl", "\n//!include common/b.wgsl"),
        ("common/b.wgsl", "\n\n//!include common/a.wgsl"),
    ]);
    let (file, line, _, message) = place(&circle);
    assert_eq!((file.as_str(), line), ("common/b.wgsl", 3));
    let chain = "sim/main.wgsl -> common/a.wgsl -> common/b.wgsl -> common/a.wgsl";
    assert!(message.contains(chain), "{message}");

    let (file, line, column, message) = place(&Library::from_sources([(
        MAIN.path(),
        "\n  //!include common/none.wgsl",
    )]));
    assert_eq!((file.as_str(), line, column), (MAIN.path(), 2, 3));
    assert!(message.contains("common/none.wgsl"), "{message}");

    let (_, line, _, _) = place(&Library::from_sources([(MAIN.path(), "//!include")]));
    assert_eq!(line, 1);

    let empty = Library::from_sources::<&str, &str>([]);
    assert!(matches!(
        empty.source(&MAIN),
        Err(ShaderError::UnknownShader { .. })
    ));
}
