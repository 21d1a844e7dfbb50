//! Checks every shader and generates `shaders.rs` (the files and their names) and `layout.rs`
//! (the structs of their buffers).

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

// The build and the running program expand and check by the same code; each uses only part of it.
#[allow(dead_code)]
#[path = "src/check.rs"]
mod check;
#[path = "build/comments.rs"]
mod comments;
#[allow(dead_code)]
#[path = "src/error.rs"]
mod error;
#[path = "src/files.rs"]
mod files;
#[path = "src/include.rs"]
mod include;
#[path = "build/layout.rs"]
mod layout;

use error::ShaderError;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=wgsl");
    // A build by the profile `bench` has debug assertions too, and `target/release` may hold it.
    println!("cargo::rustc-check-cfg=cfg(watching)");
    if std::env::var("PROFILE")? == "debug" {
        println!("cargo::rustc-cfg=watching");
    }
    let root = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join("wgsl");
    let out = std::env::var("OUT_DIR")?;

    let mut sources = BTreeMap::new();
    for (path, full) in files::list(&root)? {
        sources.insert(path, std::fs::read_to_string(full)?);
    }

    let mut errors = Vec::new();
    let mut layouts = layout::Layouts::default();
    for path in sources.keys().filter(|path| !path.starts_with("common/")) {
        if let Err(error) = add(path, &sources, &mut layouts) {
            errors.push(error);
        }
    }
    // Two shaders that include a broken file have the same error.
    errors.sort();
    errors.dedup();
    for error in &errors {
        println!("cargo::error={}", error.replace('\n', " "));
    }
    if !errors.is_empty() {
        std::process::exit(1);
    }

    let names = shader_names(&sources, &root)?;
    std::fs::write(Path::new(&out).join("shaders.rs"), names)?;
    std::fs::write(Path::new(&out).join("layout.rs"), layouts.code())?;
    Ok(())
}

fn add(
    path: &str,
    sources: &BTreeMap<String, String>,
    layouts: &mut layout::Layouts,
) -> Result<(), String> {
    let read = |path: &str| sources.get(path).map(String::as_str);
    let place = |error: ShaderError| match error {
        ShaderError::Source { .. } => format!("wgsl/{error}"),
        error => error.to_string(),
    };
    let expanded = include::expand(path, &read).map_err(place)?;
    let checked = check::check(&expanded).map_err(place)?;
    let shader = layout::Shader {
        file: path,
        text: &expanded.text,
        module: &checked.module,
    };
    layouts
        .add(shader)
        .map_err(|message| format!("wgsl/{path}: {message}"))
}

/// The constants by which the program names shaders, and the texts that are built in.
fn shader_names(sources: &BTreeMap<String, String>, root: &Path) -> Result<String, Box<dyn Error>> {
    let mut code = String::new();
    let modules = [
        ("sim", "sim", "solver"),
        ("render", "render", "renderer"),
        ("fluid", "render/fluid", "renderer's liquid surface"),
        ("spheres", "render/spheres", "renderer's coloured spheres"),
        ("spray", "render/spray", "renderer's drops of spray"),
        ("hands", "render/hands", "renderer's hands"),
        ("panel", "panel", "headset's panel"),
        ("mirror", "mirror", "mirror window"),
    ];
    for (module, folder, whose) in modules {
        writeln!(code, "/// Shaders of the {whose}.\npub mod {module} {{")?;
        for path in sources.keys() {
            let Some((_, name)) = path.rsplit_once('/').filter(|(of, _)| *of == folder) else {
                continue;
            };
            let name = name.trim_end_matches(".wgsl");
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            if !name.starts_with(|c: char| c.is_ascii_lowercase()) || !name.chars().all(plain) {
                return Err(format!(
                    "wgsl/{path}: a shader's file name is of a-z, 0-9 and _, and begins with a letter"
                )
                .into());
            }
            let constant = name.to_uppercase();
            writeln!(
                code,
                "/// `{path}`\npub const {constant}: crate::ShaderId = crate::ShaderId::new({path:?});"
            )?;
        }
        writeln!(code, "}}")?;
    }
    let shaders = sources.keys().filter(|path| !path.starts_with("common/"));
    writeln!(
        code,
        "/// Every shader of the project.\npub const ALL: &[ShaderId] = &["
    )?;
    for path in shaders {
        writeln!(code, "    ShaderId::new({path:?}),")?;
    }
    writeln!(code, "];\nconst EMBEDDED: &[(&str, &str)] = &[")?;
    for path in sources.keys() {
        writeln!(code, "    ({path:?}, include_str!({:?})),", root.join(path))?;
    }
    writeln!(code, "];")?;
    Ok(code)
}
