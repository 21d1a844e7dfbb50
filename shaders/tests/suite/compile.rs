//! Specialisation: the code that is left of a shader when its override constants are given.

use std::collections::BTreeSet;

use crate::common::{assert_valid, declared_bindings, spirv_val, stored_constants};
use vitriol_shaders::{
    ALL, BindingKind, Compiled, ImageDimension, Library, ShaderError, ShaderId, Stage,
    StorageFormat,
};

const MAIN: ShaderId = ShaderId::new("sim/main.wgsl");

fn library(text: &str) -> Library {
    Library::from_sources([(MAIN.path(), text)])
}

fn compile(text: &str, constants: &[(&str, f64)]) -> Compiled {
    let compiled = library(text).compile(&MAIN, "main", constants).unwrap();
    assert_valid(&format!("{constants:?}"), &compiled.spirv);
    compiled
}

fn names(compiled: &Compiled) -> Vec<&str> {
    compiled.bindings.iter().map(|b| b.name.as_str()).collect()
}

/// Every way to write a condition: alone, negated, joined, joined with a value that is known only at run time, compared, stored in a
/// `let`, in a called function, in a loop, as an early return.
const CONDITIONS: &str = "
override A: bool = false;
override B: bool = false;
override MODE: u32 = 0u;
@group(0) @binding(0) var<storage, read_write> out: array<u32>;
@group(0) @binding(1) var<storage, read> left: array<u32>;
@group(0) @binding(2) var<storage, read> right: array<u32>;
@group(0) @binding(3) var<storage, read> late: array<u32>;

fn called() {
    if !A { return; }
    out[left[0]] = 107u;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if A { out[i] = 100u; } else { out[i] = 101u; }
    if A && B { out[i] = 102u; }
    if A || B { out[i] = 103u; } else { let r = right[i]; out[r] = 104u; }
    if i > 3u && A { out[i] = 105u; }
    if A && (i > 3u && !B) { out[i] = 106u; }
    called();
    let both = A == B;
    if both { out[i] = 108u; }
    if MODE == 2u { out[i] = 109u; } else if MODE > 2u || B { out[i] = 110u; }
    for (var k = 0u; k < 4u; k++) {
        if !A || B { continue; }
        out[k] = 111u;
    }
    while B { out[i] = 112u; }
    if MODE == 3u { if A { return; } else { return; } }
    out[i] = 113u;
    if late[i] > 0u { out[i] = 114u; }
}
";

#[test]
fn the_branches_left_are_those_that_run() {
    for case in 0..16 {
        let (a, b, mode) = (case & 1 != 0, case & 2 != 0, case >> 2);
        let compiled = compile(
            CONDITIONS,
            &[("A", a.into()), ("B", b.into()), ("MODE", f64::from(mode))],
        );
        let expected: BTreeSet<u32> = [
            (a, 100),
            (!a, 101),
            (a && b, 102),
            (a || b, 103),
            (!(a || b), 104),
            (a, 105),
            (a && !b, 106),
            (a, 107),
            (a == b, 108),
            (mode == 2, 109),
            (mode != 2 && (mode > 2 || b), 110),
            (a && !b, 111),
            (b, 112),
            (mode != 3, 113),
            (mode != 3, 114),
        ]
        .iter()
        .filter(|(runs, _)| *runs)
        .map(|(_, value)| *value)
        .collect();
        let stored = stored_constants(&compiled.spirv)
            .into_iter()
            .filter(|value| *value >= 100)
            .collect::<BTreeSet<u32>>();
        assert_eq!(stored, expected, "A {a}, B {b}, MODE {mode}");

        let mut bindings = BTreeSet::from([0]);
        bindings.extend(a.then_some(1));
        bindings.extend((!a && !b).then_some(2));
        bindings.extend((mode != 3).then_some(3));
        assert_eq!(
            declared_bindings(&compiled.spirv),
            bindings,
            "A {a}, B {b}, MODE {mode}"
        );
        let reflected: BTreeSet<u32> = compiled.bindings.iter().map(|b| b.binding).collect();
        assert_eq!(reflected, bindings, "A {a}, B {b}, MODE {mode}");
    }
}

#[test]
fn bindings_of_other_entry_points_are_not_held() {
    let text = "
struct Step { dt: f32, n: u32 }
var<immediate> step: Step;
@group(0) @binding(4) var<storage, read> a: array<f32>;
@group(0) @binding(2) var<storage, read_write> b: array<f32>;
@group(1) @binding(0) var<uniform> c: vec4<f32>;
@group(1) @binding(1) var image: texture_depth_2d_array;
@group(1) @binding(2) var compare: sampler_comparison;
@group(1) @binding(3) var volume: texture_storage_3d<r32float, write>;
fn helper(i: u32) -> f32 { return a[i] * step.dt; }
@compute @workgroup_size(8, 4) fn main() { b[0] = helper(step.n); }
@compute @workgroup_size(1) fn other() { b[1] = c.x; textureStore(volume, vec3(0), vec4(0.0)); }
@fragment fn lit(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4(textureSampleCompareLevel(image, compare, p.xy, 0, 0.5));
}
@vertex fn multi(@builtin(view_index) v: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(v));
}
";
    let library = library(text);
    let compiled = library.compile(&MAIN, "main", &[]).unwrap();
    assert_eq!(names(&compiled), ["b", "a"]);
    assert_eq!(
        compiled.bindings[0].kind,
        BindingKind::Storage { writable: true }
    );
    assert_eq!(
        compiled.bindings[1].kind,
        BindingKind::Storage { writable: false }
    );
    assert_eq!(compiled.immediate_bytes, 8);
    assert_eq!(compiled.unused, ["c", "image", "compare", "volume"]);
    assert_eq!(compiled.workgroup_size, [8, 4, 1]);
    assert_eq!(
        (compiled.stage, compiled.label.as_str()),
        (Stage::Compute, "sim/main:main")
    );

    let other = library.compile(&MAIN, "other", &[]).unwrap();
    assert_eq!(names(&other), ["b", "c", "volume"]);
    assert_eq!(other.bindings[1].kind, BindingKind::Uniform { bytes: 16 });
    let volume = BindingKind::StorageImage {
        dimension: ImageDimension::D3,
        arrayed: false,
        format: StorageFormat::R32Float,
        readable: false,
        writable: true,
    };
    assert_eq!(other.bindings[2].kind, volume);
    assert_eq!(other.immediate_bytes, 0);
    assert_eq!(other.unused, ["step", "a", "image", "compare"]);

    let lit = library.compile(&MAIN, "lit", &[]).unwrap();
    let image = BindingKind::SampledImage {
        dimension: ImageDimension::D2,
        arrayed: true,
        multisampled: false,
        depth: true,
    };
    assert_eq!(lit.bindings[0].kind, image);
    assert_eq!(
        lit.bindings[1].kind,
        BindingKind::Sampler { comparison: true }
    );
    assert_eq!(lit.stage, Stage::Fragment);

    let multi = library.compile(&MAIN, "multi", &[]).unwrap();
    assert!(multi.bindings.is_empty());
    for compiled in [compiled, other, lit, multi] {
        assert_valid(&compiled.label, &compiled.spirv);
    }
}

#[test]
fn wrong_requests_are_refused_by_name() {
    let text = "
override RADIUS: f32;
override COUNT: u32 = 3u;
@compute @workgroup_size(1) fn main() { var x = RADIUS * f32(COUNT); x += 1.0; }
";
    let library = library(text);
    let compile = |entry, constants: &[(&str, f64)]| library.compile(&MAIN, entry, constants);
    assert!(compile("main", &[("RADIUS", 0.5)]).is_ok());
    match compile("main", &[("RADUIS", 0.5)]) {
        Err(ShaderError::UnknownConstant { name, known, .. }) => {
            assert_eq!((name.as_str(), known.as_str()), ("RADUIS", "RADIUS, COUNT"));
        }
        other => panic!("{other:?}"),
    }
    match compile("min", &[("RADIUS", 0.5)]) {
        Err(ShaderError::MissingEntry { entry, known, .. }) => {
            assert_eq!((entry.as_str(), known.as_str()), ("min", "main"));
        }
        other => panic!("{other:?}"),
    }
    for constants in [
        &[][..],
        &[("RADIUS", 0.5), ("COUNT", -1.0)],
        &[("RADIUS", f64::NAN)],
    ] {
        let result = compile("main", constants);
        assert!(
            matches!(result, Err(ShaderError::Constant { .. })),
            "{result:?}"
        );
    }
}

/// Subgroup operations, workgroup memory and an override as workgroup size.
#[test]
fn compute_shaders_are_valid_spirv() {
    let text = "
override SIZE: u32 = 32u;
@group(0) @binding(0) var<storage, read_write> data: array<u32>;
@group(0) @binding(1) var<storage, read_write> sum: atomic<u32>;
var<workgroup> part: array<u32, 64>;
@compute @workgroup_size(SIZE)
fn main(@builtin(local_invocation_index) i: u32, @builtin(subgroup_invocation_id) lane: u32) {
    part[i] = data[i] / max(lane, 1u);
    workgroupBarrier();
    let all = subgroupAdd(part[i]);
    let before = subgroupExclusiveAdd(part[i]) + subgroupShuffle(all, 0u);
    if lane == 0u { atomicAdd(&sum, all); }
    data[i] = before;
}
";
    assert_eq!(compile(text, &[("SIZE", 64.0)]).workgroup_size, [64, 1, 1]);
    // That the validator is asked at all: a module cut short is refused.
    let mut broken = compile(CONDITIONS, &[]).spirv;
    broken.truncate(broken.len() - 1);
    assert!(spirv_val(&broken).is_none_or(|result| result.is_err()));
}

/// Every entry point of every shader of the project, with its default constants.
#[test]
fn the_projects_shaders_are_valid_spirv() {
    let library = Library::embedded();
    for shader in ALL {
        let text = library.source(shader).unwrap();
        let module = naga::front::wgsl::parse_str(&text).unwrap();
        for entry in &module.entry_points {
            // Overrides without a default get a 1, which every numeric type and bool can hold.
            let open: Vec<(&str, f64)> = module
                .overrides
                .iter()
                .filter(|(_, o)| o.init.is_none())
                .filter_map(|(_, o)| Some((o.name.as_deref()?, 1.0)))
                .collect();
            let compiled = library.compile(shader, &entry.name, &open).unwrap();
            assert_valid(&compiled.label, &compiled.spirv);
            let texels = compiled.with_texels().unwrap();
            assert_valid(&format!("{} of texels", texels.label), &texels.spirv);
        }
    }
}

/// Every shader that shuffles, where the device guarantees that lanes meet again.
#[test]
fn shaders_that_shuffle_are_valid_where_lanes_meet_again() {
    let library = Library::embedded();
    let mut shuffling = 0;
    for shader in ALL {
        let known = library.constants(shader).unwrap();
        if !known.iter().any(|name| name == "LANES") {
            continue;
        }
        let compiled = library.compile(shader, "main", &[("LANES", 8.0)]).unwrap();
        let reconverging = compiled.reconverging().unwrap();
        if reconverging == compiled {
            continue;
        }
        // Validators of 2025 refuse the strides that naga gives arrays in workgroup memory.
        if spirv_val(&compiled.spirv).is_some_and(|result| result.is_err()) {
            continue;
        }
        shuffling += 1;
        match spirv_val(&reconverging.spirv) {
            // SPIRV-Tools supports it since 2024; Debian 12's are of 2023.
            Some(Err(message)) if message.contains("execution mode operand: 6023") => {
                eprintln!("this spirv-val does not know maximal reconvergence");
                return;
            }
            Some(Err(message)) => panic!("{}: spirv-val: {message}", compiled.label),
            Some(Ok(())) | None => {}
        }
    }
    eprintln!("{shuffling} shaders shuffle");
    assert!(shuffling > 10, "{shuffling}");
}
