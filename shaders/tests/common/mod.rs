//! A reader of the few SPIR-V instructions that the tests look at, and `spirv-val`.

#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code, of which each test uses a part"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::io::{ErrorKind, Write};
use std::process::{Command, Stdio};

const OP_CONSTANT: u32 = 43;
const OP_STORE: u32 = 62;
const OP_DECORATE: u32 = 71;
const DECORATION_BINDING: u32 = 33;

/// Opcode and operands of each instruction (SPIR-V specification, 2.3).
fn instructions(spirv: &[u32]) -> Vec<(u32, &[u32])> {
    let mut rest = &spirv[5..];
    let mut all = Vec::new();
    while let Some(&first) = rest.first() {
        let (operands, next) = rest[1..].split_at((first >> 16) as usize - 1);
        all.push((first & 0xffff, operands));
        rest = next;
    }
    all
}

/// The `@binding` numbers that the module declares.
pub fn declared_bindings(spirv: &[u32]) -> BTreeSet<u32> {
    instructions(spirv)
        .iter()
        .filter(|(op, words)| *op == OP_DECORATE && words[1] == DECORATION_BINDING)
        .map(|(_, words)| words[2])
        .collect()
}

/// The constants that the module stores anywhere.
pub fn stored_constants(spirv: &[u32]) -> BTreeSet<u32> {
    let instructions = instructions(spirv);
    let constants: BTreeMap<u32, u32> = instructions
        .iter()
        .filter(|(op, _)| *op == OP_CONSTANT)
        .map(|(_, words)| (words[1], words[2]))
        .collect();
    instructions
        .iter()
        .filter(|(op, _)| *op == OP_STORE)
        .filter_map(|(_, words)| constants.get(&words[1]).copied())
        .collect()
}

/// What the Khronos validator says against a module; `None` where it is not installed.
pub fn spirv_val(spirv: &[u32]) -> Option<Result<(), String>> {
    let child = Command::new("spirv-val")
        .args(["--target-env", "vulkan1.2", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = match child {
        Ok(child) => child,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            eprintln!(
                "*** NOT TESTED: spirv-val is missing; install the package spirv-tools and run \
                 this again ***"
            );
            return None;
        }
        Err(error) => panic!("spirv-val does not start: {error}"),
    };
    let bytes: Vec<u8> = spirv.iter().flat_map(|word| word.to_le_bytes()).collect();
    child.stdin.take().unwrap().write_all(&bytes).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    Some(if output.status.success() {
        Ok(())
    } else {
        Err(String::from_utf8_lossy(&text).into_owned())
    })
}

/// Fails unless the validator, where installed, accepts the module.
pub fn assert_valid(label: &str, spirv: &[u32]) {
    if let Some(Err(message)) = spirv_val(spirv) {
        panic!("{label}: spirv-val: {message}");
    }
}
