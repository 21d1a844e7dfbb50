//! Read-only arrays read as texels, for software drivers.
//!
//! Mesa's llvmpipe (22.3, Debian 12's) makes of each scalar that a storage buffer gives a loop
//! over the invocations with a branch in it; a texel comes as one wide load an invocation. Passes
//! over neighbours are made of such loads. They are loads of storage texels: a fetch of uniform
//! ones is a call, around which all that is in registers goes to memory. In hardware all are the
//! same, so the shaders say storage and the SPIR-V is changed where the device asks for it. It
//! cannot be changed any earlier: WGSL and naga have no texel buffers.
//!
//! It pays with Mesa 25.0.7 (Debian 13) too: a replay of liquid takes 0.71 to 0.76 of the processor's time, with 22.3 0.62 to 0.66
//! (docs/measurements/performance.md).

mod elements;

use std::collections::{BTreeMap, HashMap};
use std::mem::take;

use rspirv::binary::Assemble;
use rspirv::dr::Operand::{IdRef, LiteralBit32};
use rspirv::dr::{Builder, Function, Instruction, Module, Operand};
use rspirv::spirv::{Capability, Decoration, Dim, ImageFormat, Op, StorageClass, Word};

use self::elements::{Elements, Member};
use super::read;
use crate::reflect::{BindingKind, TexelKind};
use crate::{Compiled, ShaderError, TexelFormat};

impl Compiled {
    /// This shader with each read-only storage buffer of group 0 that is an array of scalars or vectors of 32 bits, or of structures of
    /// them, as a storage texel buffer. Buffers that are used in another way than by loading elements or their members stay.
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
            changed.spirv = Reads::new(module, &arrays).of(&chains).assemble();
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
                let array = Array {
                    binding,
                    format: self.bindings[binding].texel?,
                    elements: Elements::of(module, variable)?,
                };
                Some((variable, array))
            })
            .collect()
    }
}

/// An array that can be read as texels.
struct Array {
    /// Index in [`Compiled::bindings`].
    binding: usize,
    format: TexelFormat,
    elements: Elements,
}

/// Target of an access chain.
struct Chain {
    variable: Word,
    /// The element's number; `None` for the array as a whole, which naga begins with and
    /// [`super::chains`] leaves without a use.
    index: Option<Word>,
    /// The element's member, where it is a structure and not loaded as a whole.
    member: Option<u32>,
    /// A component's number, of a vector.
    component: Option<Word>,
}

/// The variables to which `wanted` gives a number, and the number.
fn decorations(module: &Module, wanted: Decoration) -> impl Iterator<Item = (Word, u32)> {
    let decorations = module.annotations.iter();
    decorations.filter_map(move |decoration| match decoration.operands[..] {
        [IdRef(id), Operand::Decoration(of), LiteralBit32(number)] if of == wanted => {
            Some((id, number))
        }
        _ => None,
    })
}

/// The access chains into `arrays`, by result; removes from `arrays` those that anything else than a load of an element or a member names.
fn chains(module: &Module, arrays: &mut BTreeMap<Word, Array>) -> HashMap<Word, Chain> {
    let mut chains: HashMap<Word, Chain> = HashMap::new();
    for instruction in module.functions.iter().flat_map(Function::all_inst_iter) {
        match (instruction.class.opcode, &instruction.operands[..]) {
            (Op::AccessChain, [IdRef(variable), IdRef(_), path @ ..])
                if arrays
                    .get(variable)
                    .is_some_and(|array| array.elements.follows(path.len())) =>
            {
                let mut path = path.iter().filter_map(Operand::id_ref_any);
                let index = path.next();
                let elements = &arrays[variable].elements;
                let member = match elements.is_structure {
                    true => path.next().and_then(|id| elements::number(module, id)),
                    false => None,
                };
                let chain = Chain {
                    variable: *variable,
                    index,
                    member,
                    component: path.next(),
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

/// Types of an array's image, of its texels and of their scalars.
#[derive(Clone, Copy)]
struct Types {
    image: Word,
    texel: Word,
    scalar: Word,
}

/// Puts reads of texels in place of loads.
struct Reads<'a> {
    builder: Builder,
    arrays: &'a BTreeMap<Word, Array>,
    types: HashMap<Word, Types>,
    uint: Word,
    numbers: HashMap<u32, Word>,
    block: Vec<Instruction>,
}

impl<'a> Reads<'a> {
    /// Declares `arrays` as texel buffers.
    fn new(module: Module, arrays: &'a BTreeMap<Word, Array>) -> Self {
        let mut builder = Builder::new_from_module(module);
        builder.capability(Capability::ImageBuffer);
        // Texels of two components.
        builder.capability(Capability::StorageImageExtendedFormats);
        builder
            .module_mut()
            .types_global_values
            .retain(|global| !global.result_id.is_some_and(|id| arrays.contains_key(&id)));
        // The builder declares no type twice.
        let mut types = HashMap::new();
        for (&variable, array) in arrays {
            let scalar = elements::scalar_type(&mut builder, array.format.kind);
            // No depth, no layers, one sample, for loads and stores.
            let (dim, format) = (Dim::DimBuffer, image_format(array.format));
            let image = builder.type_image(scalar, dim, 0, 0, 0, 2, format, None);
            let pointer = builder.type_pointer(None, StorageClass::UniformConstant, image);
            builder.variable(pointer, Some(variable), StorageClass::UniformConstant, None);
            let texel = builder.type_vector(scalar, 4);
            types.insert(
                variable,
                Types {
                    image,
                    texel,
                    scalar,
                },
            );
        }
        let uint = builder.type_int(32, 0);
        Self {
            builder,
            arrays,
            types,
            uint,
            numbers: HashMap::new(),
            block: Vec::new(),
        }
    }

    /// The module with reads for all loads by `chains`.
    fn of(mut self, chains: &HashMap<Word, Chain>) -> Module {
        let mut functions = take(&mut self.builder.module_mut().functions);
        for block in functions.iter_mut().flat_map(|f| &mut f.blocks) {
            for instruction in take(&mut block.instructions) {
                match (instruction.class.opcode, instruction.operands.first()) {
                    (Op::AccessChain, _)
                        if chains.contains_key(&instruction.result_id.unwrap_or(0)) => {}
                    (Op::Load, Some(IdRef(pointer))) if chains.contains_key(pointer) => {
                        self.read(&chains[pointer], &instruction);
                    }
                    _ => self.block.push(instruction),
                }
            }
            block.instructions = take(&mut self.block);
        }
        self.builder.module_mut().functions = functions;
        self.builder.module()
    }

    fn emit(&mut self, op: Op, of: Word, operands: Vec<Operand>) -> Word {
        let result = self.builder.id();
        self.push(op, Some(of), Some(result), operands);
        result
    }

    fn push(&mut self, op: Op, of: Option<Word>, result: Option<Word>, operands: Vec<Operand>) {
        self.block.push(Instruction::new(op, of, result, operands));
    }

    fn number(&mut self, number: u32) -> Word {
        let (builder, uint) = (&mut self.builder, self.uint);
        let known = self.numbers.entry(number);
        *known.or_insert_with(|| builder.constant_bit32(uint, number))
    }

    /// The value of `load`, read by `chain`.
    fn read(&mut self, chain: &Chain, load: &Instruction) {
        let Some(index) = chain.index else { return };
        let arrays = self.arrays;
        let array = &arrays[&chain.variable];
        let (of, result) = (load.result_type, load.result_id);
        match (chain.member, &array.elements.members[..]) {
            (None, members) if array.elements.is_structure => {
                let read = |member: &Member| {
                    let all = self.member(chain.variable, array, index, member);
                    IdRef(all)
                };
                let parts = members.iter().map(read).collect();
                self.push(Op::CompositeConstruct, of, result, parts);
            }
            (member, members) => {
                let member = &members[member.unwrap_or(0) as usize];
                let value = IdRef(self.member(chain.variable, array, index, member));
                match chain.component {
                    Some(component) => {
                        let operands = vec![value, IdRef(component)];
                        self.push(Op::VectorExtractDynamic, of, result, operands);
                    }
                    None => self.push(Op::CopyObject, of, result, vec![value]),
                }
            }
        }
    }

    /// A member of element `index`.
    fn member(&mut self, variable: Word, array: &Array, index: Word, member: &Member) -> Word {
        let types = self.types[&variable];
        let width = array.format.components;
        let (texels, first) = (array.elements.words / width, member.word / width);
        let mut at = index;
        if texels > 1 {
            let factor = IdRef(self.number(texels));
            at = self.emit(Op::IMul, self.uint, vec![IdRef(at), factor]);
        }
        if first > 0 {
            let offset = IdRef(self.number(first));
            at = self.emit(Op::IAdd, self.uint, vec![IdRef(at), offset]);
        }
        let image = self.emit(Op::Load, types.image, vec![IdRef(variable)]);
        let operands = vec![IdRef(image), IdRef(at)];
        let texel = self.emit(Op::ImageRead, types.texel, operands);
        let skipped = member.word % width;
        let scalars = match member.components {
            1 => {
                let operands = vec![IdRef(texel), LiteralBit32(skipped)];
                self.emit(Op::CompositeExtract, types.scalar, operands)
            }
            4 => texel,
            components => {
                let numbers = (skipped..skipped + components).map(LiteralBit32);
                let both = [IdRef(texel), IdRef(texel)].into_iter();
                let vector = self.builder.type_vector(types.scalar, components);
                self.emit(Op::VectorShuffle, vector, both.chain(numbers).collect())
            }
        };
        match member.kind == array.format.kind {
            true => scalars,
            false => self.emit(Op::Bitcast, member.of, vec![IdRef(scalars)]),
        }
    }
}

fn image_format(format: TexelFormat) -> ImageFormat {
    match (format.kind, format.components) {
        (TexelKind::Float, 1) => ImageFormat::R32f,
        (TexelKind::Float, 2) => ImageFormat::Rg32f,
        (TexelKind::Float, _) => ImageFormat::Rgba32f,
        (TexelKind::Uint, 1) => ImageFormat::R32ui,
        (TexelKind::Uint, 2) => ImageFormat::Rg32ui,
        (TexelKind::Uint, _) => ImageFormat::Rgba32ui,
        (TexelKind::Sint, 1) => ImageFormat::R32i,
        (TexelKind::Sint, 2) => ImageFormat::Rg32i,
        (TexelKind::Sint, _) => ImageFormat::Rgba32i,
    }
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
struct Pair { a: f32, b: u32 }
struct Place { at: vec3<f32>, number: f32, turned: vec4<f32> }
struct Table { numbers: array<f32, 4> }
@group(0) @binding(0) var<storage, read> fours: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> ones: array<u32>;
@group(0) @binding(2) var<storage, read> twos: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> pairs: array<Pair>;
@group(0) @binding(4) var<storage, read> places: array<Place>;
@group(0) @binding(5) var<storage, read> tables: array<Table>;
@group(0) @binding(6) var<storage, read_write> sums: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = ones[id.x];
    let place = places[i];
    sums[i] = fours[i] + vec4<f32>(fours[i + 1u].y, fours[i + 2u][twos[i].y], pairs[i].a, tables[i].numbers[2])
        + place.turned * place.number + vec4<f32>(place.at, f32(pairs[i].b));
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
                // A float and a number.
                texels(TexelKind::Uint, 1),
                texels(TexelKind::Float, 4),
                BindingKind::Storage { writable: false },
                BindingKind::Storage { writable: true },
            ]
        );
        // One each, and of a place one for each of its three members.
        assert_eq!(
            instructions(&changed.spirv, &[Op::ImageRead]).len(),
            5 + 2 + 3
        );
    }
}
