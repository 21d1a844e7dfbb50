//! A running development build takes up changed files, and keeps the old where one is broken.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use vitriol_shaders::{Library, ShaderError, ShaderId};

const ONE: ShaderId = ShaderId::new("sim/one.wgsl");
const TWO: ShaderId = ShaderId::new("render/two.wgsl");
const ONE_TEXT: &str = "//!include common/maths/k.wgsl
struct Step { dt: f32, n: u32, @align(8) k: u32 }
var<immediate> step: Step;
@compute @workgroup_size(1) fn main() { var x = K * step.dt; x += 1.0; }
";
const TWO_TEXT: &str = "@compute @workgroup_size(2) fn main() {}";

/// A folder of its own, removed at the end.
struct Folder {
    path: PathBuf,
    /// File systems stamp in ticks; a test writes faster.
    clock: SystemTime,
}

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("vitriol-{name}-{}", std::process::id()));
        for sub in ["common/maths", "sim", "render"] {
            fs::create_dir_all(path.join(sub)).unwrap();
        }
        let clock = SystemTime::now();
        let mut folder = Self { path, clock };
        folder.write("common/maths/k.wgsl", "const K = 1.0;");
        folder.write(ONE.path(), ONE_TEXT);
        folder.write(TWO.path(), TWO_TEXT);
        folder
    }

    fn write(&mut self, file: &str, text: &str) {
        self.clock += Duration::from_secs(1);
        let path: &Path = &self.path.join(file);
        fs::write(path, text).unwrap();
        let file = fs::File::options().write(true).open(path).unwrap();
        file.set_modified(self.clock).unwrap();
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.path).ok();
    }
}

#[test]
fn a_changed_file_is_taken_up_by_those_that_include_it() {
    let mut folder = Folder::new("changed");
    let library = Library::watching_at(&folder.path);
    let before = library.compile(&ONE, "main", &[]).unwrap();
    library.compile(&TWO, "main", &[]).unwrap();
    assert!(library.changed().is_empty());

    // Same length, other content, in an included file.
    folder.write("common/maths/k.wgsl", "const K = 2.0;");
    assert_eq!(library.changed(), [ONE]);
    assert!(library.changed().is_empty());
    assert!(library.source(&ONE).unwrap().contains("K = 2.0"));
    assert_ne!(
        library.compile(&ONE, "main", &[]).unwrap().spirv,
        before.spirv
    );

    // Saved anew without a change; a file that no shader uses.
    folder.write(ONE.path(), ONE_TEXT);
    folder.write("common/maths/unused.wgsl", "const U = 0;");
    assert!(library.changed().is_empty());

    folder.write(TWO.path(), &TWO_TEXT.replace('2', "4"));
    assert_eq!(library.changed(), [TWO]);
    assert_eq!(
        library.compile(&TWO, "main", &[]).unwrap().workgroup_size,
        [4, 1, 1]
    );
}

#[test]
fn a_broken_file_keeps_the_old() {
    let mut folder = Folder::new("broken");
    let library = Library::watching_at(&folder.path);
    let before = library.compile(&ONE, "main", &[]).unwrap();
    let text = library.source(&ONE).unwrap();

    let broken = [
        ONE_TEXT.replace("x += 1.0", "x += "),   // does not parse
        ONE_TEXT.replace("x += 1.0", "discard"), // does not validate
        ONE_TEXT.replace("k.wgsl", "none.wgsl"), // includes what is not there
        ONE_TEXT.replace("fn main", "fn other"), // lost its entry point
        String::new(),                           // emptied by an editor
        // Other layouts than Rust's: order, a field's name, type and place.
        ONE_TEXT.replace("dt: f32, n: u32", "n: u32, dt: f32"),
        ONE_TEXT.replace("n: u32", "m: u32"),
        ONE_TEXT.replace("n: u32", "n: i32"),
        ONE_TEXT.replace("n: u32, @align(8) k", "@align(8) n: u32, k"),
        // Resources that the program does not give, and resources that it gives in vain.
        format!("{ONE_TEXT}@group(0) @binding(0) var<storage, read> more: array<u32>;"),
        ONE_TEXT.replace(
            "var<immediate> step: Step;",
            "const step = Step(1.0, 1u, 1u);",
        ),
    ];
    for wrong in broken {
        assert_ne!(wrong, ONE_TEXT);
        folder.write(ONE.path(), &wrong);
        assert!(library.changed().is_empty(), "{wrong}");
        assert_eq!(library.source(&ONE).unwrap(), text, "{wrong}");
        assert_eq!(
            library.compile(&ONE, "main", &[]).unwrap(),
            before,
            "{wrong}"
        );
    }

    folder.write(ONE.path(), &ONE_TEXT.replace("1.0", "3.0"));
    assert_eq!(library.changed(), [ONE]);
    assert!(library.source(&ONE).unwrap().contains("3.0"));
}

#[test]
fn what_is_missing_or_broken_at_the_start_is_an_error_or_the_built_in_one() {
    let mut folder = Folder::new("start");
    folder.write(ONE.path(), "nonsense");
    let library = Library::watching_at(&folder.path);
    match library.source(&ONE) {
        Err(ShaderError::Source { file, line, .. }) => {
            assert_eq!((file.as_str(), line), (ONE.path(), 1));
        }
        other => panic!("{other:?}"),
    }
    folder.write(ONE.path(), ONE_TEXT);
    library.changed();
    assert!(library.compile(&ONE, "main", &[]).is_ok());

    let nowhere = Library::watching_at(folder.path.join("nowhere"));
    assert!(nowhere.changed().is_empty());
    for shader in vitriol_shaders::ALL {
        assert_eq!(nowhere.source(shader), Library::embedded().source(shader));
    }
}
