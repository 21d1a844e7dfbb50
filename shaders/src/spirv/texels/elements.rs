//! Elements of a storage buffer's array, as its module declares them.

use rspirv::dr::Operand::{IdRef, LiteralBit32};
use rspirv::dr::{Builder, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, Op, Word};

use crate::reflect::TexelKind;

/// The elements of an array.
pub struct Elements {
    /// Distance from one element to the next, 32-bit words.
    pub words: u32,
    /// Their scalars and vectors: the members of a structure, or the element itself.
    pub members: Vec<Member>,
    pub is_structure: bool,
}

/// A scalar or vector of 32 bits.
pub struct Member {
    /// Its type.
    pub of: Word,
    pub kind: TexelKind,
    pub components: u32,
    /// Index of its first word within the element.
    pub word: u32,
}

impl Elements {
    /// The elements of `variable`, which naga wraps into a structure of one array. `None` where they are anything else than scalars,
    /// vectors, or structures of them.
    pub fn of(module: &Module, variable: Word) -> Option<Self> {
        let pointer = defined(module, variable)?.result_type?;
        let [_, IdRef(wrapper)] = defined(module, pointer)?.operands[..] else {
            return None;
        };
        let [IdRef(array)] = defined(module, wrapper)?.operands[..] else {
            return None;
        };
        let declared = defined(module, array)?;
        let (Op::TypeRuntimeArray, [IdRef(of)]) = (declared.class.opcode, &declared.operands[..])
        else {
            return None;
        };
        let words = decoration(module, array, None, Decoration::ArrayStride)? / 4;
        let element = defined(module, *of)?;
        let is_structure = element.class.opcode == Op::TypeStruct;
        let members = match is_structure {
            false => vec![member(module, *of, 0)?],
            true => {
                let types = element.operands.iter().filter_map(Operand::id_ref_any);
                let members = (0..).zip(types).map(|(number, own)| {
                    let bytes = decoration(module, *of, Some(number), Decoration::Offset)?;
                    member(module, own, bytes / 4)
                });
                members.collect::<Option<_>>()?
            }
        };
        Some(Self {
            words,
            members,
            is_structure,
        })
    }

    /// Whether a chain of `path` numbers ends within an element, or at the array.
    pub fn follows(&self, path: usize) -> bool {
        path <= 2 + usize::from(self.is_structure)
    }
}

/// A type as a member that begins with `word`.
fn member(module: &Module, of: Word, word: u32) -> Option<Member> {
    let declared = defined(module, of)?;
    let (scalar, components) = match (declared.class.opcode, &declared.operands[..]) {
        (Op::TypeVector, [IdRef(scalar), LiteralBit32(components)]) => {
            (defined(module, *scalar)?, *components)
        }
        _ => (declared, 1),
    };
    let kind = match (scalar.class.opcode, &scalar.operands[..]) {
        (Op::TypeFloat, [LiteralBit32(32), ..]) => TexelKind::Float,
        (Op::TypeInt, [LiteralBit32(32), LiteralBit32(0)]) => TexelKind::Uint,
        (Op::TypeInt, [LiteralBit32(32), LiteralBit32(_)]) => TexelKind::Sint,
        _ => return None,
    };
    Some(Member {
        of,
        kind,
        components,
        word,
    })
}

/// The declared type of a scalar of that kind.
pub fn scalar_type(builder: &mut Builder, kind: TexelKind) -> Word {
    match kind {
        TexelKind::Float => builder.type_float(32, None),
        TexelKind::Uint => builder.type_int(32, 0),
        TexelKind::Sint => builder.type_int(32, 1),
    }
}

/// The value of constant `id`.
pub fn number(module: &Module, id: Word) -> Option<u32> {
    match defined(module, id)?.operands[..] {
        [LiteralBit32(number)] => Some(number),
        _ => None,
    }
}

/// The global instruction that makes `id`.
fn defined(module: &Module, id: Word) -> Option<&Instruction> {
    let mut globals = module.types_global_values.iter();
    globals.find(|global| global.result_id == Some(id))
}

/// The number that the decoration `wanted` gives a type, or a member of it.
fn decoration(module: &Module, of: Word, member: Option<u32>, wanted: Decoration) -> Option<u32> {
    let mut found = module.annotations.iter().filter_map(|annotation| {
        match (member, &annotation.operands[..]) {
            (None, [IdRef(id), Operand::Decoration(it), LiteralBit32(number)])
                if (*id, *it) == (of, wanted) =>
            {
                Some(*number)
            }
            (
                Some(member),
                [
                    IdRef(id),
                    LiteralBit32(of_member),
                    Operand::Decoration(it),
                    LiteralBit32(number),
                ],
            ) if (*id, *of_member, *it) == (of, member, wanted) => Some(*number),
            _ => None,
        }
    });
    found.next()
}
