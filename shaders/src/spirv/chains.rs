//! One access chain in place of two.
//!
//! naga wraps an array that is bound as it stands into a struct, takes the struct's member in one
//! access chain and the element in a second. Debian 12's validation layer (1.3.239) follows only
//! one chain, and so takes every store to such an array for a read: its synchronisation
//! validation misses each hazard that a store is part of. [`super::texels`] too looks for one
//! chain.
//!
//! Debian 13's layer (1.4.309) follows both: without barriers, the compute tests of `gpu` give
//! the same 20 hazards of dispatches with and without this file. But it needs a newer C library
//! (2.38) than Debian 12 has, so that each test would have to run inside an unpacked Debian 13,
//! and it reports none of them unless `VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC=1`
//! (`.cargo/config.toml`).

use std::collections::HashMap;

use rspirv::dr::{Function, Module, Operand};
use rspirv::spirv::{Op, Word};

/// Lets each access chain that starts from another one start from that one's base.
pub fn join(module: &mut Module) {
    // Base and indices by result.
    let mut paths: HashMap<Word, Vec<Operand>> = HashMap::new();
    let functions = module.functions.iter_mut();
    for instruction in functions.flat_map(Function::all_inst_iter_mut) {
        let Op::AccessChain = instruction.class.opcode else {
            continue;
        };
        if let Some(Operand::IdRef(base)) = instruction.operands.first()
            && let Some(path) = paths.get(base)
        {
            instruction.operands.splice(..1, path.iter().cloned());
        }
        if let Some(result) = instruction.result_id {
            paths.insert(result, instruction.operands.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{compiled, instructions};
    use super::*;

    #[test]
    fn an_array_bound_as_it_stands_is_reached_by_one_chain() {
        let shader = compiled(
            "
@group(0) @binding(0) var<storage, read_write> numbers: array<vec4<u32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    numbers[id.x].y = numbers[id.x + 1u].x;
}",
        );
        let chains = instructions(&shader.spirv, &[Op::AccessChain]);
        assert!(!chains.is_empty());
        for chain in &chains {
            let starts = |from: &&_| chain.operands.first() == Some(from);
            let mut results = chains
                .iter()
                .filter_map(|c| c.result_id.map(Operand::IdRef));
            assert!(!results.any(|result| starts(&&result)), "{chain:?}");
        }
    }
}
