//! One access chain in place of two.
//!
//! naga wraps an array that is bound as it stands into a struct, takes the
//! struct's member in one access chain and the element in a second. The
//! validation layer (1.3.239, Debian 12's) follows one, and so takes every
//! store to such an array for a read: its synchronisation validation misses
//! all hazards between passes. Joined, it sees them.

use std::collections::HashMap;

const HEADER_WORDS: usize = 5;
const OP_ACCESS_CHAIN: u32 = 65;

/// The module with each access chain that starts from another one starting
/// from that one's base; the semantics are the same.
pub fn join(spirv: &[u32]) -> Vec<u32> {
    let mut joined = spirv[..HEADER_WORDS.min(spirv.len())].to_vec();
    // Base and indices by result.
    let mut chains: HashMap<u32, Vec<u32>> = HashMap::new();
    let mut rest = &spirv[joined.len()..];
    while let Some(&head) = rest.first() {
        let (opcode, words) = (head & 0xffff, ((head >> 16) as usize).clamp(1, rest.len()));
        let (instruction, after) = rest.split_at(words);
        rest = after;
        if opcode == OP_ACCESS_CHAIN && words > 3 {
            let path = match chains.get(&instruction[3]) {
                Some(first) => [first, &instruction[4..]].concat(),
                None => instruction[3..].to_vec(),
            };
            joined.push((path.len() as u32 + 3) << 16 | OP_ACCESS_CHAIN);
            joined.extend(&instruction[1..3]);
            joined.extend(&path);
            chains.insert(instruction[2], path);
        } else {
            joined.extend(instruction);
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Library, ShaderId};

    /// Access chains that start from another one.
    fn stacked(spirv: &[u32]) -> usize {
        let mut results = Vec::new();
        let (mut at, mut stacked) = (HEADER_WORDS, 0);
        while at < spirv.len() {
            if spirv[at] & 0xffff == OP_ACCESS_CHAIN {
                stacked += usize::from(results.contains(&spirv[at + 3]));
                results.push(spirv[at + 2]);
            }
            at += (spirv[at] >> 16) as usize;
        }
        stacked
    }

    #[test]
    fn an_array_bound_as_it_stands_is_reached_by_one_chain() {
        let text = "
@group(0) @binding(0) var<storage, read_write> numbers: array<vec4<u32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    numbers[id.x].y = numbers[id.x + 1u].x;
}";
        let library = Library::from_sources([("test.wgsl", text)]);
        let compiled = library
            .compile(&ShaderId::new("test.wgsl"), "main", &[])
            .unwrap();
        assert_eq!(stacked(&compiled.spirv), 0);
        assert_eq!(join(&compiled.spirv), compiled.spirv);
    }
}
