//! Links the library so that it stays loaded.
// A build script talks to Cargo by its output.
#![allow(clippy::print_stdout)]

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    // OpenXR's loader unloads a runtime with its instance; the state has to outlive that, as it counts frames over all instances and reads
    // its script once.
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
