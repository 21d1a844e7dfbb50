//! Arithmetic as it is written.
//!
//! Drivers may contract a product and a sum into one rounding, and which of
//! them they contract depends on the code around it. A solver that leaves a
//! part out of its shaders, because the scene does not ask for it, would then
//! have other bits than one whose part is there and has nothing to do; and a
//! compensated sum would be undone. SPIR-V forbids it result by result.

use std::collections::HashSet;

const HEADER_WORDS: usize = 5;
const OP_DECORATE: u32 = 71;
const OP_MEMBER_DECORATE: u32 = 72;
const NO_CONTRACTION: u32 = 42;

/// OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv, OpVectorTimesScalar,
/// OpMatrixTimesScalar, OpVectorTimesMatrix, OpMatrixTimesVector,
/// OpMatrixTimesMatrix and OpDot.
const ARITHMETIC: [u32; 11] = [127, 129, 131, 133, 136, 142, 143, 144, 145, 146, 148];

/// The module with no contraction of any result of its arithmetic. What the
/// extended instructions make (`mix`, `length`, `fma`) is the driver's own.
pub fn forbid_contraction(spirv: &[u32]) -> Vec<u32> {
    let mut results = HashSet::new();
    let mut annotations = None;
    let mut at = HEADER_WORDS;
    while at < spirv.len() {
        let (opcode, words) = (spirv[at] & 0xffff, (spirv[at] >> 16).max(1) as usize);
        match opcode {
            OP_DECORATE | OP_MEMBER_DECORATE => {
                annotations.get_or_insert(at);
            }
            _ if ARITHMETIC.contains(&opcode) && words > 2 => {
                results.insert(spirv[at + 2]);
            }
            _ => {}
        }
        at += words;
    }
    // Whatever computes also binds something, and that is decorated.
    let Some(place) = annotations else {
        return spirv.to_vec();
    };
    let mut sorted: Vec<u32> = results.into_iter().collect();
    sorted.sort_unstable();
    let decorations = sorted
        .into_iter()
        .flat_map(|result| [3 << 16 | OP_DECORATE, result, NO_CONTRACTION]);
    let mut exact = spirv[..place].to_vec();
    exact.extend(decorations);
    exact.extend(&spirv[place..]);
    exact
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Library, ShaderId};

    #[test]
    fn a_product_and_a_sum_are_rounded_each() {
        let text = "
@group(0) @binding(0) var<storage, read_write> numbers: array<f32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    numbers[id.x] = numbers[id.x + 1u] * numbers[id.x + 2u] + 1.0;
}";
        let library = Library::from_sources([("test.wgsl", text)]);
        let id = ShaderId::new("test.wgsl");
        let spirv = library.compile(&id, "main", &[]).unwrap().spirv;
        let mut decorated = HashSet::new();
        let mut results = HashSet::new();
        let mut at = HEADER_WORDS;
        while at < spirv.len() {
            let (opcode, words) = (spirv[at] & 0xffff, (spirv[at] >> 16) as usize);
            if opcode == OP_DECORATE && spirv[at + 2] == NO_CONTRACTION {
                decorated.insert(spirv[at + 1]);
            }
            // The product and the sum, on floats.
            if opcode == 133 || opcode == 129 {
                results.insert(spirv[at + 2]);
            }
            at += words;
        }
        assert_eq!(results.len(), 2);
        assert_eq!(decorated, results);
    }
}
