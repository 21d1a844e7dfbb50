//! Arithmetic as it is written.
//!
//! A driver may contract a product and a sum into one rounding, and which of them it contracts
//! depends on the code around it. A solver that leaves a part out of its shaders, because the
//! scene does not ask for it, would then have other bits than one whose part is there and has
//! nothing to do; and a compensated sum would be undone. SPIR-V forbids it result by result.

use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, Op};

/// Instructions that the decoration `NoContraction` may stand on.
const ARITHMETIC: [Op; 11] = [
    Op::FNegate,
    Op::FAdd,
    Op::FSub,
    Op::FMul,
    Op::FDiv,
    Op::VectorTimesScalar,
    Op::MatrixTimesScalar,
    Op::VectorTimesMatrix,
    Op::MatrixTimesVector,
    Op::MatrixTimesMatrix,
    Op::Dot,
];

/// Forbids contraction of any result of the module's arithmetic. Results of the extended instructions (`mix`, `length`, `fma`) are the
/// driver's own.
pub fn forbid_contraction(module: &mut Module) {
    let arithmetic = module
        .functions
        .iter()
        .flat_map(Function::all_inst_iter)
        .filter(|instruction| ARITHMETIC.contains(&instruction.class.opcode));
    let decorations = arithmetic
        .filter_map(|instruction| instruction.result_id)
        .map(|result| {
            let operands = vec![
                Operand::IdRef(result),
                Operand::Decoration(Decoration::NoContraction),
            ];
            Instruction::new(Op::Decorate, None, None, operands)
        });
    module.annotations.extend(decorations);
}

#[cfg(test)]
mod tests {
    use super::super::tests::{compiled, instructions};
    use super::*;

    #[test]
    fn a_product_and_a_sum_are_rounded_each() {
        let shader = compiled(
            "
@group(0) @binding(0) var<storage, read_write> numbers: array<f32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    numbers[id.x] = numbers[id.x + 1u] * numbers[id.x + 2u] + 1.0;
}",
        );
        let exact = Operand::Decoration(Decoration::NoContraction);
        let decorations = instructions(&shader.spirv, &[Op::Decorate]).into_iter();
        let decorated: Vec<_> = decorations
            .filter(|decoration| decoration.operands.get(1) == Some(&exact))
            .filter_map(|decoration| decoration.operands.into_iter().next())
            .collect();
        let results: Vec<_> = instructions(&shader.spirv, &[Op::FMul, Op::FAdd])
            .into_iter()
            .filter_map(|instruction| instruction.result_id.map(Operand::IdRef))
            .collect();
        assert_eq!(results.len(), 2);
        assert_eq!(decorated, results);
    }
}
