//! Read-only arrays fetched as texels, for software drivers.
//!
//! Mesa's llvmpipe (22.3, Debian 12's) makes of each scalar that a storage buffer gives a loop
//! over the invocations with a branch in it; a texel comes as one wide load an invocation. Passes
//! over neighbours are made of such loads. In hardware both are the same, so the shaders say
//! storage and the SPIR-V is changed where the device asks for it. It cannot be changed any
//! earlier: WGSL and naga have no texel buffers.

use std::collections::{BTreeMap, HashMap};
use std::mem::take;

use rspirv::binary::Assemble;
use rspirv::dr::Operand::{IdRef, LiteralBit32};
use rspirv::dr::{Builder, Function, Instruction, Module, Operand};
use rspirv::spirv::{Capability, Decoration, Dim, ImageFormat, Op, StorageClass, Word};

use super::read;
use crate::reflect::{BindingKind, TexelKind};
use crate::{Compiled, ShaderError, TexelFormat};

impl Compiled {
    /// The same shader with each read-only storage buffer of group 0 that is an array of scalars
    /// or of vectors of two or four, 32 bits each, as a uniform texel buffer. What is used in
    /// another way than by loading elements stays.
    ///
    /// # Errors
    /// [`ShaderError::Spirv`] where `spirv` is no module.
    pub fn with_texels(&self) -> Result<Self, ShaderError> {
        let module = read(&self.label, &self.spirv)?;
        let mut arrays = self.arrays(&module);
        let chains = chains(&module, &mut arrays);
        let mut changed = self.clone();
        for array in arrays.values() {
            changed.bindings[array.binding].kind = BindingKind::Texels(array.format);
        }
        if !arrays.is_empty() {
            changed.spirv = fetch(module, &arrays, &chains).assemble();
        }
        Ok(changed)
    }

    /// The arrays that a format of texels fits, by variable.
    fn arrays(&self, module: &Module) -> BTreeMap<Word, Array> {
        let groups: HashMap<Word, u32> = decorations(module, Decoration::DescriptorSet).collect();
        decorations(module, Decoration::Binding)
            .filter(|(variable, _)| groups.get(variable) == Some(&0))
            .filter_map(|(variable, number)| {
                let mut bindings = self.bindings.iter();
                let binding = bindings.position(|b| (b.group, b.binding) == (0, number))?;
                let format = self.bindings[binding].texel?;
                Some((variable, Array { binding, format }))
            })
            .collect()
    }
}

/// An array that can be fetched.
struct Array {
    /// Place in [`Compiled::bindings`].
    binding: usize,
    format: TexelFormat,
}

/// Which element of which array an access chain points to.
struct Chain {
    variable: Word,
    /// The element's number; `None` for the array as a whole, which naga begins with and
    /// [`super::chains`] leaves without a use.
    index: Option<Word>,
    /// A component's number.
    component: Option<Word>,
}

/// The variables that `wanted` gives a number, and that.
fn decorations(module: &Module, wanted: Decoration) -> impl Iterator<Item = (Word, u32)> {
    let decorations = module.annotations.iter();
    decorations.filter_map(move |decoration| match decoration.operands[..] {
        [IdRef(id), Operand::Decoration(of), LiteralBit32(number)] if of == wanted => {
            Some((id, number))
        }
        _ => None,
    })
}

/// The access chains into `arrays`, by result; takes out of `arrays` what anything else than a
/// load of an element names.
fn chains(module: &Module, arrays: &mut BTreeMap<Word, Array>) -> HashMap<Word, Chain> {
    let mut chains: HashMap<Word, Chain> = HashMap::new();
    for instruction in module.functions.iter().flat_map(Function::all_inst_iter) {
        match (instruction.class.opcode, &instruction.operands[..]) {
            (Op::AccessChain, [IdRef(variable), IdRef(_), path @ ..])
                if arrays.contains_key(variable) && path.len() <= 2 =>
            {
                let chain = Chain {
                    variable: *variable,
                    index: path.first().and_then(Operand::id_ref_any),
                    component: path.get(1).and_then(Operand::id_ref_any),
                };
                chains.extend(instruction.result_id.map(|result| (result, chain)));
            }
            (Op::Load, [IdRef(pointer), ..])
                if chains.get(pointer).is_some_and(|c| c.index.is_some()) => {}
            (_, operands) => {
                for id in operands.iter().filter_map(Operand::id_ref_any) {
                    arrays.remove(&chains.get(&id).map_or(id, |chain| chain.variable));
                }
            }
        }
    }
    chains.retain(|_, chain| arrays.contains_key(&chain.variable));
    chains
}

/// Declares `arrays` as texel buffers and loads their elements by fetching.
fn fetch(module: Module, arrays: &BTreeMap<Word, Array>, chains: &HashMap<Word, Chain>) -> Module {
    let mut builder = Builder::new_from_module(module);
    builder.capability(Capability::SampledBuffer);
    let module = builder.module_mut();
    module.annotations.retain(|decoration| {
        !matches!(&decoration.operands[..], [IdRef(id), Operand::Decoration(Decoration::NonWritable)]
            if arrays.contains_key(id))
    });
    module
        .types_global_values
        .retain(|global| !global.result_id.is_some_and(|id| arrays.contains_key(&id)));
    // Types of the image and of its texels. The builder declares no type twice.
    let mut types: HashMap<Word, (Word, Word)> = HashMap::new();
    for (&variable, array) in arrays {
        let scalar = match array.format.kind {
            TexelKind::Float => builder.type_float(32, None),
            TexelKind::Uint => builder.type_int(32, 0),
            TexelKind::Sint => builder.type_int(32, 1),
        };
        // No depth, no layers, one sample, for sampling.
        let (dim, format) = (Dim::DimBuffer, ImageFormat::Unknown);
        let image = builder.type_image(scalar, dim, 0, 0, 0, 1, format, None);
        let pointer = builder.type_pointer(None, StorageClass::UniformConstant, image);
        builder.variable(pointer, Some(variable), StorageClass::UniformConstant, None);
        types.insert(variable, (image, builder.type_vector(scalar, 4)));
    }
    let mut functions = take(&mut builder.module_mut().functions);
    for block in functions.iter_mut().flat_map(|f| &mut f.blocks) {
        for instruction in take(&mut block.instructions) {
            let chain = match (instruction.class.opcode, instruction.operands.first()) {
                (Op::AccessChain, _)
                    if chains.contains_key(&instruction.result_id.unwrap_or(0)) =>
                {
                    continue;
                }
                (Op::Load, Some(IdRef(pointer))) => chains.get(pointer),
                _ => None,
            };
            let Some((chain, index)) = chain.and_then(|chain| Some((chain, chain.index?))) else {
                block.instructions.push(instruction);
                continue;
            };
            let (image_type, texel_type) = types[&chain.variable];
            let (image, texel) = (builder.id(), builder.id());
            let mut emit = |op, of, result, operands| {
                let made = Instruction::new(op, of, result, operands);
                block.instructions.push(made);
            };
            let from = vec![IdRef(chain.variable)];
            emit(Op::Load, Some(image_type), Some(image), from);
            let at = vec![IdRef(image), IdRef(index)];
            emit(Op::ImageFetch, Some(texel_type), Some(texel), at);
            let texel = IdRef(texel);
            let (op, operands) = match (chain.component, arrays[&chain.variable].format.components)
            {
                (Some(component), _) => (Op::VectorExtractDynamic, vec![texel, IdRef(component)]),
                (None, 1) => (Op::CompositeExtract, vec![texel, LiteralBit32(0)]),
                (None, components) => {
                    let numbers = (0..components).map(LiteralBit32);
                    let both = [texel.clone(), texel].into_iter();
                    (Op::VectorShuffle, both.chain(numbers).collect())
                }
            };
            emit(op, instruction.result_type, instruction.result_id, operands);
        }
    }
    builder.module_mut().functions = functions;
    builder.module()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::tests::{compiled, instructions};
    use super::*;

    #[test]
    fn arrays_that_are_read_become_texels_and_the_others_stay() {
        let shader = compiled(
            "
struct Pair { a: f32, b: f32 }
@group(0) @binding(0) var<storage, read> fours: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> ones: array<u32>;
@group(0) @binding(2) var<storage, read> twos: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> pairs: array<Pair>;
@group(0) @binding(4) var<storage, read_write> sums: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = ones[id.x];
    sums[i] = fours[i] + vec4<f32>(fours[i + 1u].y, fours[i + 2u][twos[i].y], pairs[i].b, 0.0);
}",
        );

        let changed = shader.with_texels().unwrap();
        let kinds: Vec<_> = changed.bindings.iter().map(|b| b.kind).collect();
        let texels = |kind, components| BindingKind::Texels(TexelFormat { kind, components });
        assert_eq!(
            kinds,
            [
                texels(TexelKind::Float, 4),
                texels(TexelKind::Uint, 1),
                texels(TexelKind::Uint, 2),
                BindingKind::Storage { writable: false },
                BindingKind::Storage { writable: true },
            ]
        );
        assert_eq!(instructions(&changed.spirv, &[Op::ImageFetch]).len(), 5);
    }
}
