//! Lanes that part in a loop meet again behind it.
//!
//! Lanes that share a particle leave the loop over its neighbours at different turns, and their
//! shuffles stand behind it. SPIR-V by itself does not promise that they have met by then, though
//! drivers let them. SPV_KHR_maximal_reconvergence promises it: invocations that part meet again
//! where the shader's own blocks do. It is a device's extension, so the SPIR-V is changed where
//! the device has it; WGSL and naga do not know it.

use rspirv::binary::Assemble;
use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{ExecutionMode, Op};

use super::read;
use crate::{Compiled, ShaderError};

/// Name of the extension of SPIR-V.
const EXTENSION: &str = "SPV_KHR_maximal_reconvergence";

impl Compiled {
    /// This shader with maximal reconvergence, which a device must have switched on (`shaderMaximalReconvergence`); unchanged where it has
    /// no operation of subgroups.
    ///
    /// # Errors
    /// [`ShaderError::Spirv`] where `spirv` is no module.
    pub fn reconverging(&self) -> Result<Self, ShaderError> {
        let mut module = read(&self.label, &self.spirv)?;
        let mut changed = self.clone();
        if uses_subgroups(&module) {
            reconverge(&mut module);
            changed.spirv = module.assemble();
        }
        Ok(changed)
    }
}

/// Whether any invocation reads others of its subgroup.
fn uses_subgroups(module: &Module) -> bool {
    let mut instructions = module.functions.iter().flat_map(Function::all_inst_iter);
    instructions.any(|instruction| {
        let opcode = instruction.class.opcode;
        (Op::GroupNonUniformElect..=Op::GroupNonUniformQuadSwap).contains(&opcode)
    })
}

/// Requires maximal reconvergence at each entry point.
fn reconverge(module: &mut Module) {
    let name = Operand::LiteralString(EXTENSION.to_owned());
    let extension = Instruction::new(Op::Extension, None, None, vec![name]);
    module.extensions.push(extension);
    // Operands of an entry point: model, function, name, variables.
    let entry_points = module.entry_points.iter();
    let functions = entry_points.filter_map(|entry| entry.operands.get(1).cloned());
    let modes = functions.map(|function| {
        let mode = Operand::ExecutionMode(ExecutionMode::MaximallyReconvergesKHR);
        Instruction::new(Op::ExecutionMode, None, None, vec![function, mode])
    });
    module.execution_modes.extend(modes);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::tests::compiled;

    /// A sum over two lanes behind a loop that each leaves at its own turn; `{}` takes the sum.
    const LOOP: &str = "
@group(0) @binding(0) var<storage, read_write> numbers: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    var sum = 0u;
    for (var n = 0u; n < numbers[id.x]; n++) { sum += n; }
    numbers[id.x] = {};
}";

    /// The words of each instruction behind the header of five, by the definition of the format:
    /// a first word of word count and opcode, then its operands.
    fn instructions(spirv: &[u32], opcode: u32) -> Vec<&[u32]> {
        let (mut rest, mut found) = (&spirv[5..], Vec::new());
        while let [first, ..] = rest {
            let (instruction, behind) = rest.split_at((first >> 16) as usize);
            if first & 0xffff == opcode {
                found.push(&instruction[1..]);
            }
            rest = behind;
        }
        found
    }

    #[test]
    fn lanes_that_shuffle_meet_again() {
        let before = compiled(&LOOP.replace("{}", "sum + subgroupShuffleXor(sum, 1u)"));
        let shader = before.reconverging().unwrap();
        // OpExtension is 10, OpEntryPoint 15, OpExecutionMode 16, and the mode 6023, as Khronos
        // numbers them (spirv.core.grammar.json); OpCapability is 17 and there is none for it.
        let named: Vec<u8> = instructions(&shader.spirv, 10)
            .last()
            .unwrap()
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect();
        // A string ends with a zero, and is filled up with zeros to a word.
        assert_eq!(named, b"SPV_KHR_maximal_reconvergence\0\0\0");
        let function = instructions(&shader.spirv, 15)[0][1];
        let modes = instructions(&shader.spirv, 16);
        assert!(modes.contains(&[function, 6023].as_slice()), "{modes:?}");
        let count = |spirv, opcode| instructions(spirv, opcode).len();
        assert_eq!(count(&shader.spirv, 16), count(&before.spirv, 16) + 1);
        assert_eq!(count(&shader.spirv, 17), count(&before.spirv, 17));
        assert_eq!(shader.bindings, before.bindings);
    }

    #[test]
    fn what_has_no_subgroups_stays() {
        let alone = compiled(&LOOP.replace("{}", "sum"));
        assert_eq!(alone.reconverging().unwrap(), alone);
    }
}
