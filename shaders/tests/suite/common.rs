//! Queries of SPIR-V for the tests, and `spirv-val`.

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

use rspirv::dr::Operand::{self, IdRef, LiteralBit32};
use rspirv::dr::{Instruction, load_words};
use rspirv::spirv::{Decoration, Op};

/// The module's instructions of one opcode.
fn instructions(spirv: &[u32], wanted: Op) -> Vec<Instruction> {
    let module = load_words(spirv).unwrap();
    let all = module.all_inst_iter().cloned();
    all.filter(|i| i.class.opcode == wanted).collect()
}

/// The `@binding` numbers that the module declares.
pub fn declared_bindings(spirv: &[u32]) -> BTreeSet<u32> {
    let number = |decoration: &Instruction| match decoration.operands[..] {
        [
            _,
            Operand::Decoration(Decoration::Binding),
            LiteralBit32(number),
        ] => Some(number),
        _ => None,
    };
    let decorations = instructions(spirv, Op::Decorate);
    decorations.iter().filter_map(number).collect()
}

/// The constants that the module stores anywhere.
pub fn stored_constants(spirv: &[u32]) -> BTreeSet<u32> {
    let constants: BTreeMap<u32, u32> = instructions(spirv, Op::Constant)
        .iter()
        .filter_map(|constant| match constant.operands[..] {
            [LiteralBit32(value)] => Some((constant.result_id?, value)),
            _ => None,
        })
        .collect();
    instructions(spirv, Op::Store)
        .iter()
        .filter_map(|store| match store.operands[..] {
            [_, IdRef(value), ..] => constants.get(&value).copied(),
            _ => None,
        })
        .collect()
}

/// The verdict of the Khronos validator on a module; `None` where it is not installed.
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
