//! Changes to the SPIR-V that naga writes, one file a change.

mod chains;
mod exact;
mod reconverge;
mod texels;

use rspirv::binary::Assemble;
use rspirv::dr::{Module, load_words};

use crate::ShaderError;
use crate::reflect::Stage;

/// The module of shader `label`, as naga wrote it for `stage`, with the changes that every device needs.
///
/// # Errors
/// [`ShaderError::Spirv`] where it is no module.
pub fn rewrite(label: &str, spirv: &[u32], stage: Stage) -> Result<Vec<u32>, ShaderError> {
    let mut module = read(label, spirv)?;
    chains::join(&mut module);
    if stage == Stage::Compute {
        exact::forbid_contraction(&mut module);
    }
    Ok(module.assemble())
}

fn read(label: &str, spirv: &[u32]) -> Result<Module, ShaderError> {
    load_words(spirv).map_err(|error| ShaderError::Spirv {
        shader: label.to_owned(),
        message: error.to_string(),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use rspirv::dr::Instruction;
    use rspirv::spirv::Op;

    use super::*;
    use crate::{Compiled, Library, ShaderId};

    /// The shader's entry point `main`.
    pub fn compiled(text: &str) -> Compiled {
        let library = Library::from_sources([("test.wgsl", text)]);
        let id = ShaderId::new("test.wgsl");
        library.compile(&id, "main", &[]).unwrap()
    }

    /// The module's instructions of one of these opcodes.
    pub fn instructions(spirv: &[u32], wanted: &[Op]) -> Vec<Instruction> {
        let module = read("test", spirv).unwrap();
        let all = module.all_inst_iter().cloned();
        all.filter(|i| wanted.contains(&i.class.opcode)).collect()
    }

    #[test]
    fn what_is_no_module_is_an_error() {
        let shader = compiled(
            "@group(0) @binding(0) var<storage, read> source: array<u32>;
@group(0) @binding(1) var<storage, read_write> copy: array<u32>;
@compute @workgroup_size(1) fn main() { copy[0] = source[0]; }",
        );
        for spirv in [&[][..], &[0; 8], &shader.spirv[..shader.spirv.len() - 1]] {
            let broken = Compiled {
                spirv: spirv.to_vec(),
                ..shader.clone()
            };
            for result in [
                rewrite("test", spirv, Stage::Compute).err(),
                broken.with_texels().err(),
                broken.reconverging().err(),
            ] {
                assert!(
                    matches!(result, Some(ShaderError::Spirv { .. })),
                    "{result:?}"
                );
            }
        }
    }
}
