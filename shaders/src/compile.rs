//! From a checked module to SPIR-V for one entry point and one set of override constants.

use naga::back::spv;
use naga::back::{PipelineConstants, pipeline_constants};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{ValidationFlags, Validator};
use naga::{AddressSpace, Module, ShaderStage};

use crate::check::{Checked, capabilities, validation_message};
use crate::error::ShaderError;
use crate::fold::fold_constant_ifs;
use crate::reflect::{Binding, Stage, bindings};
use crate::spirv::rewrite;

/// SPIR-V for one entry point, and its requirements of a pipeline.
///
/// Clip space is Vulkan's (y down, depth 0 to 1): positions pass through unchanged. Workgroup
/// memory is not initialised; a shader that needs zeros writes them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Compiled {
    /// Shader and entry point, for messages and debug labels: `sim/density:main`.
    pub label: String,
    /// The module, SPIR-V 1.3 (Vulkan 1.1 and later).
    pub spirv: Vec<u32>,
    /// The entry point's name in the module.
    pub entry: String,
    /// The stage it belongs to.
    pub stage: Stage,
    /// Invocations of a workgroup in x, y, z; zeros but for compute.
    pub workgroup_size: [u32; 3],
    /// The resources that it uses, by group and binding, without those that only branches use that the override constants rule out.
    pub bindings: Vec<Binding>,
    /// Size of the `var<immediate>` in bytes, 0 without one.
    pub immediate_bytes: u32,
    /// Names of the resources (and of the `var<immediate>`) that the file declares and this entry point, as specialised, does not use. A
    /// pass may name them; they are not bound.
    pub unused: Vec<String>,
}

/// Compiles one entry point of the shader at `path`.
///
/// # Errors
/// Every variant of [`ShaderError`] but those about files.
pub fn compile(
    path: &str,
    checked: &Checked,
    entry: &str,
    constants: &[(&str, f64)],
) -> Result<Compiled, ShaderError> {
    let specialise = |message: String| ShaderError::Specialise {
        shader: path.to_owned(),
        entry: entry.to_owned(),
        message,
    };
    let shader_stage = find_entry(path, &checked.module, entry)?;
    let values = resolve_constants(path, &checked.module, constants)?;

    let mut module = pipeline_constants::process_overrides(
        &checked.module,
        &checked.info,
        Some((shader_stage, entry)),
        &values,
    )
    .map_err(|error| match error {
        pipeline_constants::PipelineConstantError::ValidationError(error) => {
            specialise(validation_message(&error))
        }
        error => ShaderError::Constant {
            shader: path.to_owned(),
            entry: entry.to_owned(),
            message: error.to_string(),
        },
    })?
    .0
    .into_owned();

    fold_constant_ifs(&mut module);
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    let info = Validator::new(ValidationFlags::all(), capabilities())
        .validate_resolved_overrides(&module)
        .map_err(|error| specialise(validation_message(&error)))?;

    let (bindings, immediate_bytes) = bindings(&module, &info)
        .map_err(|name| specialise(format!("'{name}' is an array of bindings")))?;
    let unused = checked
        .module
        .global_variables
        .iter()
        .filter(|(_, variable)| {
            variable.binding.is_some()
                || (variable.space == AddressSpace::Immediate && immediate_bytes == 0)
        })
        .filter_map(|(_, variable)| variable.name.clone())
        .filter(|name| !bindings.iter().any(|binding| binding.name == *name))
        .collect();
    let spirv = spv::write_vec(
        &module,
        &info,
        &writer_options(),
        Some(&spv::PipelineOptions {
            shader_stage,
            entry_point: entry.to_owned(),
        }),
    )
    .map_err(|error| specialise(error.to_string()))?;

    let stage = match shader_stage {
        ShaderStage::Vertex => Stage::Vertex,
        ShaderStage::Fragment => Stage::Fragment,
        ShaderStage::Compute => Stage::Compute,
        other => return Err(specialise(format!("no pipeline has a stage {other:?}"))),
    };
    let label = format!("{}:{entry}", path.trim_end_matches(".wgsl"));
    Ok(Compiled {
        spirv: rewrite(&label, &spirv, stage)?,
        label,
        entry: entry.to_owned(),
        stage,
        workgroup_size: module.entry_points[0].workgroup_size,
        bindings,
        immediate_bytes,
        unused,
    })
}

fn find_entry(path: &str, module: &Module, entry: &str) -> Result<ShaderStage, ShaderError> {
    match module.entry_points.iter().find(|e| e.name == entry) {
        Some(found) => Ok(found.stage),
        None => Err(ShaderError::MissingEntry {
            shader: path.to_owned(),
            entry: entry.to_owned(),
            known: list(module.entry_points.iter().map(|e| e.name.as_str())),
        }),
    }
}

/// naga takes an override with `@id` by its number; here all are named.
fn resolve_constants(
    path: &str,
    module: &Module,
    constants: &[(&str, f64)],
) -> Result<PipelineConstants, ShaderError> {
    let mut values = PipelineConstants::default();
    for &(name, value) in constants {
        let found = module
            .overrides
            .iter()
            .find(|(_, o)| o.name.as_deref() == Some(name));
        let Some((_, found)) = found else {
            let known = module
                .overrides
                .iter()
                .filter_map(|(_, o)| o.name.as_deref());
            return Err(ShaderError::UnknownConstant {
                shader: path.to_owned(),
                name: name.to_owned(),
                known: list(known),
            });
        };
        let key = found
            .id
            .map_or_else(|| name.to_owned(), |id| id.to_string());
        values.insert(key, value);
    }
    Ok(values)
}

/// Names for a message, separated by commas.
pub fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

/// Without checks at run time: an index out of range and an integer division by zero are undefined.
fn writer_options() -> spv::Options<'static> {
    spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::DEBUG,
        bounds_check_policies: BoundsCheckPolicies::default(),
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::None,
        force_loop_bounding: false,
        use_storage_input_output_16: false,
        emit_int_div_checks: false,
        ..Default::default()
    }
}
