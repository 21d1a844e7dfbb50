//! The generator of Rust structs, held against the offsets that the WGSL specification states.
//!
//! `fixtures/spec.rs` is its output for `fixtures/spec.wgsl`, and is compiled here.

#[path = "../../build/comments.rs"]
mod comments;
#[path = "../../build/layout.rs"]
mod generator;

#[allow(missing_docs)]
mod spec {
    include!("../fixtures/spec.rs");
}

use std::mem::{offset_of, size_of};

use generator::{Layouts, Shader};

fn add(layouts: &mut Layouts, file: &str, text: &str) -> Result<(), String> {
    let module = &naga::front::wgsl::parse_str(text).unwrap();
    layouts.add(Shader { file, text, module })
}

#[test]
fn the_generator_makes_the_compiled_fixture() {
    let mut layouts = Layouts::default();
    add(
        &mut layouts,
        "spec.wgsl",
        include_str!("../fixtures/spec.wgsl"),
    )
    .unwrap();
    assert_eq!(
        layouts.code(),
        include_str!("../fixtures/spec.rs"),
        "{}",
        layouts.code()
    );
}

/// Offsets from the table in the specification ("Structure Member Layout"), for `C` from its rules ("Alignment and Size": a
/// column of three rows and an element of three components take 16 bytes).
#[test]
fn offsets_are_those_of_the_specification() {
    use spec::{A, B, C};
    let a = [
        offset_of!(A, u),
        offset_of!(A, v),
        offset_of!(A, w),
        offset_of!(A, x),
    ];
    assert_eq!((a, size_of::<A>()), ([0, 4, 8, 16], 24));
    let b = [
        offset_of!(B, a),
        offset_of!(B, b),
        offset_of!(B, c),
        offset_of!(B, d),
        offset_of!(B, e),
        offset_of!(B, f),
        offset_of!(B, g),
        offset_of!(B, h),
    ];
    assert_eq!((b, size_of::<B>()), ([0, 16, 28, 32, 40, 64, 80, 152], 160));
    let c = [
        offset_of!(C, stage_from_flask),
        offset_of!(C, normal),
        offset_of!(C, points),
        offset_of!(C, count),
        offset_of!(C, cell),
        offset_of!(C, r#gen),
    ];
    assert_eq!(c, [0, 64, 112, 752, 768, 780]);
    // Without its runtime-sized array, which begins here.
    assert_eq!(size_of::<C>(), 784);

    let b = B {
        b: [1.0, 2.0, 3.0],
        h: -1,
        ..Default::default()
    };
    let words: &[u32] = bytemuck::cast_slice(bytemuck::bytes_of(&b));
    assert_eq!(f32::from_bits(words[16 / 4 + 2]), 3.0);
    assert_eq!(words[152 / 4], u32::MAX);
    assert_eq!(words.iter().filter(|word| **word != 0).count(), 4);
}

#[test]
fn two_files_share_a_struct_only_if_it_is_the_same() {
    let step = |fields: &str| format!("struct Step {{\n{fields}\n}}\nvar<immediate> step: Step;");
    let mut layouts = Layouts::default();
    add(&mut layouts, "sim/a.wgsl", &step("dt: f32, n: u32")).unwrap();
    add(
        &mut layouts,
        "sim/b.wgsl",
        &step("/// Seconds.\n dt: f32, n: u32"),
    )
    .unwrap();
    assert_eq!(layouts.code().matches("pub struct Step").count(), 1);
    for other in [
        "n: f32, dt: u32",
        "dt: f32, n: i32",
        "dt: f32, n: u32, k: u32",
    ] {
        let message = add(&mut layouts, "sim/c.wgsl", &step(other)).unwrap_err();
        assert!(
            message.contains("Step") && message.contains("sim/a.wgsl"),
            "{message}"
        );
    }
}

#[test]
fn a_field_without_a_rust_type_is_named() {
    let text = "enable f16;\nstruct S { a: f32, b: vec2<f16> }\nvar<immediate> s: S;";
    let message = add(&mut Layouts::default(), "sim/a.wgsl", text).unwrap_err();
    assert!(message.starts_with("S.b: "), "{message}");
}
