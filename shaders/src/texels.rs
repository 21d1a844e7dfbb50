//! Read-only arrays fetched as texels, for software drivers.
//!
//! Mesa's llvmpipe (22.3, Debian 12's) makes of each scalar that a storage
//! buffer gives a loop over the invocations with a branch in it; a texel
//! comes as one wide load an invocation. Passes over neighbours are made of
//! such loads. In hardware both are the same, so the shaders say storage and
//! the SPIR-V is changed where the device asks for it.

use std::collections::{HashMap, HashSet};

use crate::reflect::{BindingKind, TexelKind};
use crate::{Compiled, TexelFormat};

const HEADER_WORDS: usize = 5;
const ID_BOUND: usize = 3;

const OP_CAPABILITY: u32 = 17;
const OP_TYPE_INT: u32 = 21;
const OP_TYPE_FLOAT: u32 = 22;
const OP_TYPE_VECTOR: u32 = 23;
const OP_TYPE_IMAGE: u32 = 25;
const OP_TYPE_RUNTIME_ARRAY: u32 = 29;
const OP_TYPE_STRUCT: u32 = 30;
const OP_TYPE_POINTER: u32 = 32;
const OP_CONSTANT: u32 = 43;
const OP_EXT_INST: u32 = 12;
const OP_FUNCTION: u32 = 54;
const OP_VARIABLE: u32 = 59;
const OP_LOAD: u32 = 61;
const OP_ACCESS_CHAIN: u32 = 65;
const OP_DECORATE: u32 = 71;
const OP_VECTOR_EXTRACT_DYNAMIC: u32 = 77;
const OP_VECTOR_SHUFFLE: u32 = 79;
const OP_COMPOSITE_EXTRACT: u32 = 81;
const OP_COMPOSITE_INSERT: u32 = 82;
const OP_IMAGE_FETCH: u32 = 95;

const CAPABILITY_SAMPLED_BUFFER: u32 = 46;
const DECORATION_NON_WRITABLE: u32 = 24;
const DECORATION_BINDING: u32 = 33;
const DECORATION_DESCRIPTOR_SET: u32 = 34;
const CLASS_UNIFORM_CONSTANT: u32 = 0;
const CLASS_STORAGE_BUFFER: u32 = 12;
const DIM_BUFFER: u32 = 5;

impl Compiled {
    /// The same shader with each read-only storage buffer that is an array of
    /// scalars or of vectors of two or four, 32 bits each, as a uniform texel
    /// buffer. What is used in another way than by loading elements stays.
    #[must_use]
    pub fn with_texels(&self) -> Self {
        let module = Module::read(&self.spirv);
        let arrays = module.eligible();
        let mut changed = self.clone();
        for binding in &mut changed.bindings {
            // Those of group 0, where everything is bound.
            let array = arrays
                .values()
                .find(|array| array.binding == binding.binding);
            if let Some(array) = array.filter(|_| binding.group == 0) {
                binding.kind = BindingKind::Texels(array.format);
            }
        }
        if !arrays.is_empty() {
            changed.spirv = module.rewrite(&arrays);
        }
        changed
    }
}

/// An array that can be fetched.
struct Array {
    binding: u32,
    format: TexelFormat,
    /// SPIR-V's type of a scalar in it.
    scalar: u32,
}

/// How an access chain reaches into an array.
struct Chain {
    variable: u32,
    /// Id of the element's number; `None` for the array as a whole, which
    /// naga begins with and [`crate::chains`] leaves without a use.
    index: Option<u32>,
    /// Id of a component's number.
    component: Option<u32>,
}

struct Module<'a> {
    header: &'a [u32],
    instructions: Vec<&'a [u32]>,
    /// Number of the first instruction that belongs to a function.
    functions: usize,
}

impl<'a> Module<'a> {
    fn read(spirv: &'a [u32]) -> Self {
        let (header, mut rest) = spirv.split_at(HEADER_WORDS.min(spirv.len()));
        let mut instructions = Vec::new();
        while let Some(&head) = rest.first() {
            let words = ((head >> 16) as usize).clamp(1, rest.len());
            let (instruction, after) = rest.split_at(words);
            instructions.push(instruction);
            rest = after;
        }
        let functions = instructions.iter().position(|i| opcode(i) == OP_FUNCTION);
        Self {
            header,
            functions: functions.unwrap_or(instructions.len()),
            instructions,
        }
    }

    /// Instructions of this opcode before the first function.
    fn global(&self, wanted: u32) -> impl Iterator<Item = &'a [u32]> {
        let before = self.instructions.iter().take(self.functions).copied();
        before.filter(move |instruction| opcode(instruction) == wanted)
    }

    /// The second operand of types, by result: what arrays and structures are
    /// made of and where pointers point.
    fn inner(&self, wanted: u32, operand: usize) -> HashMap<u32, u32> {
        let types = self.global(wanted);
        types.map(|i| (i[1], i[operand])).collect()
    }

    fn eligible(&self) -> HashMap<u32, Array> {
        let decorated = |wanted: u32| {
            self.global(OP_DECORATE)
                .filter(move |i| i[2] == wanted)
                .map(|i| (i[1], i.get(3).copied().unwrap_or_default()))
                .collect::<HashMap<u32, u32>>()
        };
        let read_only = decorated(DECORATION_NON_WRITABLE);
        let bindings = decorated(DECORATION_BINDING);
        let groups = decorated(DECORATION_DESCRIPTOR_SET);
        let pointees = self.inner(OP_TYPE_POINTER, 3);
        let elements = self.inner(OP_TYPE_RUNTIME_ARRAY, 2);
        let members: HashMap<u32, u32> = self
            .global(OP_TYPE_STRUCT)
            .filter(|i| i.len() == 3)
            .map(|i| (i[1], i[2]))
            .collect();
        let vectors: HashMap<u32, (u32, u32)> = self
            .global(OP_TYPE_VECTOR)
            .map(|i| (i[1], (i[2], i[3])))
            .collect();
        let scalars = self.scalars();
        let mut arrays = HashMap::new();
        for variable in self.global(OP_VARIABLE) {
            let (pointer, id) = (variable[1], variable[2]);
            let bound = groups.get(&id) == Some(&0) && read_only.contains_key(&id);
            if variable[3] != CLASS_STORAGE_BUFFER || !bound {
                continue;
            }
            let structure = pointees.get(&pointer);
            let array = structure.and_then(|id| members.get(id));
            let Some(&element) = array.and_then(|id| elements.get(id)) else {
                continue;
            };
            let (scalar, components) = vectors.get(&element).copied().unwrap_or((element, 1));
            if let (Some(&kind), Some(&binding), 1 | 2 | 4) =
                (scalars.get(&scalar), bindings.get(&id), components)
            {
                let format = TexelFormat { kind, components };
                let array = Array {
                    binding,
                    format,
                    scalar,
                };
                arrays.insert(id, array);
            }
        }
        let kept = self.used_otherwise(&arrays);
        arrays.retain(|id, _| !kept.contains(id));
        arrays
    }

    /// Scalar types of 32 bits.
    fn scalars(&self) -> HashMap<u32, TexelKind> {
        let integers = self.global(OP_TYPE_INT).filter(|i| i[2] == 32).map(|i| {
            let kind = if i[3] == 1 {
                TexelKind::Sint
            } else {
                TexelKind::Uint
            };
            (i[1], kind)
        });
        let floats = self.global(OP_TYPE_FLOAT).filter(|i| i[2] == 32);
        integers
            .chain(floats.map(|i| (i[1], TexelKind::Float)))
            .collect()
    }

    /// Access chains to elements of `arrays`, by result.
    fn chains(&self, arrays: &HashMap<u32, Array>) -> HashMap<u32, Chain> {
        let body = &self.instructions[self.functions..];
        body.iter()
            .filter(|i| opcode(i) == OP_ACCESS_CHAIN && arrays.contains_key(&i[3]))
            .filter(|i| (5..=7).contains(&i.len()))
            .map(|i| {
                let chain = Chain {
                    variable: i[3],
                    index: i.get(5).copied(),
                    component: i.get(6).copied(),
                };
                (i[2], chain)
            })
            .collect()
    }

    /// Those of `arrays` that something else than a load of an element names.
    fn used_otherwise(&self, arrays: &HashMap<u32, Array>) -> HashSet<u32> {
        let chains = self.chains(arrays);
        let mut kept = HashSet::new();
        for instruction in &self.instructions[self.functions..] {
            let known = match opcode(instruction) {
                OP_ACCESS_CHAIN if chains.contains_key(&instruction[2]) => 4,
                OP_LOAD if of_element(&chains, instruction[3]).is_some() => 4,
                _ => 1,
            };
            for word in ids(instruction).skip(known) {
                let variable = chains.get(word).map(|chain| chain.variable);
                kept.extend(variable.or(arrays.contains_key(word).then_some(*word)));
            }
        }
        kept
    }

    fn rewrite(&self, arrays: &HashMap<u32, Array>) -> Vec<u32> {
        let chains = self.chains(arrays);
        let mut out = Writer {
            next: self.header[ID_BOUND],
            words: self.header.to_vec(),
        };
        out.emit(OP_CAPABILITY, &[CAPABILITY_SAMPLED_BUFFER]);
        let types = self.global(OP_TYPE_VECTOR).filter(|i| i[3] == 4);
        let mut vectors: HashMap<u32, u32> = types.map(|i| (i[2], i[1])).collect();
        let constants: HashMap<u32, u32> = self
            .global(OP_CONSTANT)
            .filter(|i| i.len() == 4)
            .map(|i| (i[2], i[3]))
            .collect();
        // Image type and pointer to it, by scalar type: no type may be there twice.
        let mut images: HashMap<u32, (u32, u32)> = HashMap::new();
        for &instruction in &self.instructions {
            match opcode(instruction) {
                OP_DECORATE
                    if arrays.contains_key(&instruction[1])
                        && instruction[2] == DECORATION_NON_WRITABLE => {}
                OP_VARIABLE if arrays.contains_key(&instruction[2]) => {
                    let scalar = arrays[&instruction[2]].scalar;
                    vectors.entry(scalar).or_insert_with(|| {
                        let id = out.id();
                        out.emit(OP_TYPE_VECTOR, &[id, scalar, 4]);
                        id
                    });
                    let (_, pointer) = *images.entry(scalar).or_insert_with(|| {
                        let (image, pointer) = (out.id(), out.id());
                        // No depth, no layers, one sample, for sampling, format unknown.
                        out.emit(OP_TYPE_IMAGE, &[image, scalar, DIM_BUFFER, 0, 0, 0, 1, 0]);
                        out.emit(OP_TYPE_POINTER, &[pointer, CLASS_UNIFORM_CONSTANT, image]);
                        (image, pointer)
                    });
                    out.emit(
                        OP_VARIABLE,
                        &[pointer, instruction[2], CLASS_UNIFORM_CONSTANT],
                    );
                }
                OP_ACCESS_CHAIN if chains.contains_key(&instruction[2]) => {}
                OP_LOAD if chains.contains_key(&instruction[3]) => {
                    let (kind, result) = (instruction[1], instruction[2]);
                    let Some((chain, index)) = of_element(&chains, instruction[3]) else {
                        continue;
                    };
                    let array = &arrays[&chain.variable];
                    let components = array.format.components;
                    let whole = chain.component.is_none() && components == 4;
                    let image = out.id();
                    let texel = if whole { result } else { out.id() };
                    out.emit(OP_LOAD, &[images[&array.scalar].0, image, chain.variable]);
                    out.emit(
                        OP_IMAGE_FETCH,
                        &[vectors[&array.scalar], texel, image, index],
                    );
                    match chain.component {
                        Some(id) => match constants.get(&id) {
                            Some(&number) => {
                                out.emit(OP_COMPOSITE_EXTRACT, &[kind, result, texel, number]);
                            }
                            None => {
                                out.emit(OP_VECTOR_EXTRACT_DYNAMIC, &[kind, result, texel, id]);
                            }
                        },
                        None if components == 1 => {
                            out.emit(OP_COMPOSITE_EXTRACT, &[kind, result, texel, 0]);
                        }
                        None if components == 2 => {
                            out.emit(OP_VECTOR_SHUFFLE, &[kind, result, texel, texel, 0, 1]);
                        }
                        None => {}
                    }
                }
                _ => out.words.extend(instruction),
            }
        }
        out.words[ID_BOUND] = out.next;
        out.words
    }
}

struct Writer {
    next: u32,
    words: Vec<u32>,
}

impl Writer {
    fn id(&mut self) -> u32 {
        self.next += 1;
        self.next - 1
    }

    fn emit(&mut self, opcode: u32, operands: &[u32]) {
        self.words.push((operands.len() as u32 + 1) << 16 | opcode);
        self.words.extend(operands);
    }
}

fn of_element(chains: &HashMap<u32, Chain>, id: u32) -> Option<(&Chain, u32)> {
    let chain = chains.get(&id)?;
    Some((chain, chain.index?))
}

/// The words of an instruction of a function, but for those that are literals.
/// Where one is taken for an id, an array merely stays as it is.
fn ids(instruction: &[u32]) -> impl Iterator<Item = &u32> {
    let (literal, last) = match opcode(instruction) {
        OP_EXT_INST => (4, 5),
        OP_COMPOSITE_EXTRACT => (4, instruction.len()),
        OP_VECTOR_SHUFFLE | OP_COMPOSITE_INSERT => (5, instruction.len()),
        _ => (0, 0),
    };
    let numbered = instruction.iter().enumerate();
    let words = numbered.filter(move |(n, _)| !(literal..last).contains(n));
    words.map(|(_, word)| word)
}

fn opcode(instruction: &[u32]) -> u32 {
    instruction[0] & 0xffff
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Library, ShaderId};

    fn compiled(text: &'static str) -> Compiled {
        let library = Library::from_sources([("test.wgsl", text)]);
        let id = ShaderId::new("test.wgsl");
        library.compile(&id, "main", &[]).unwrap()
    }

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

        let changed = shader.with_texels();
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
        let module = Module::read(&changed.spirv);
        let fetches = module.instructions.iter();
        assert_eq!(fetches.filter(|i| opcode(i) == OP_IMAGE_FETCH).count(), 5);
    }
}
