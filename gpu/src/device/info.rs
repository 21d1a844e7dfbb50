//! Properties of a device.

use std::ffi::{CStr, CString};

use ash::vk;

use super::needs;

/// Properties of a device.
#[derive(Clone, Debug)]
pub struct DeviceInfo {
    /// Device name.
    pub name: String,
    /// Driver name and version in the driver's own words.
    pub driver: String,
    /// Vulkan version of the device, such as "1.3.230".
    pub api: String,
    /// Discrete, integrated, CPU and so on.
    pub kind: vk::PhysicalDeviceType,
    /// Limits that buffers and dispatches must keep.
    pub limits: BindingLimits,
    /// Invocations per subgroup.
    pub subgroup_size: u32,
    /// Invocations of the smallest subgroup that the driver may choose.
    pub least_subgroup_size: u32,
    /// Nanoseconds per timestamp tick; zero where the device has none.
    pub timestamp_period: f32,
    /// Optional features: those that are on, or of a device that is only listed all that it has.
    pub features: EnabledFeatures,
    /// Whether compute passes read arrays as texel buffers: on a
    /// software driver, see `Compiled::with_texels`.
    pub reads_texels: bool,
}

/// Limits that buffers and dispatches must keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BindingLimits {
    /// Bytes of one storage buffer binding.
    pub storage_bytes: u64,
    /// Bytes of one uniform buffer binding.
    pub uniform_bytes: u64,
    /// Bytes of immediates (push constants).
    pub immediate_bytes: u32,
    /// Workgroups of one dispatch, per dimension.
    pub workgroups: [u32; 3],
    /// Bindings of one pipeline (push descriptors).
    pub bindings: u32,
    /// Elements of a texel buffer.
    pub texels: u64,
    /// Storage images and texel buffers of one shader.
    pub storage_images: u32,
}

/// Optional features, each on where the device has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EnabledFeatures {
    /// `enable f16` in WGSL, in 16-bit storage too.
    pub float16: bool,
    /// SPIR-V's Vulkan memory model.
    pub memory_model: bool,
    /// Subgroup operations in compute (arithmetic, ballot and shuffle).
    pub subgroups: bool,
    /// Storage texels of all formats that arrays have, see `Compiled::with_texels`.
    pub storage_formats: bool,
    /// Lanes that part in a loop meet again behind it for certain, see `Compiled::reconverging`.
    pub maximal_reconvergence: bool,
}

/// The driver's own words and numbers about one physical device.
pub(crate) struct Properties {
    /// With all features that the device has.
    pub(crate) info: DeviceInfo,
    pub(crate) extensions: Vec<CString>,
    /// Requirements that it does not meet.
    pub(crate) missing: Vec<String>,
}

/// "1.3.230".
fn version_text(version: u32) -> String {
    format!(
        "{}.{}.{}",
        vk::api_version_major(version),
        vk::api_version_minor(version),
        vk::api_version_patch(version)
    )
}

/// Text of a fixed character array up to its terminator.
fn text(result: Result<&CStr, std::ffi::FromBytesUntilNulError>) -> String {
    result.map_or_else(
        |_| String::from("?"),
        |text| text.to_string_lossy().into_owned(),
    )
}

/// Queries the properties of `physical`.
pub(crate) fn query(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Properties {
    let mut v11 = vk::PhysicalDeviceVulkan11Properties::default();
    let mut v12 = vk::PhysicalDeviceVulkan12Properties::default();
    let mut v13 = vk::PhysicalDeviceVulkan13Properties::default();
    let mut push = vk::PhysicalDevicePushDescriptorPropertiesKHR::default();
    let mut properties = vk::PhysicalDeviceProperties2::default()
        .push_next(&mut v11)
        .push_next(&mut v12)
        .push_next(&mut v13)
        .push_next(&mut push);
    // SAFETY: `physical` is a device of `instance`; structures that an older
    // device does not know are skipped by it and stay zero.
    unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
    let core = properties.properties;
    let extensions = device_extensions(instance, physical);
    let (features, mut missing) = query_features(instance, physical, &extensions, &v11);
    if core.api_version < vk::API_VERSION_1_3 {
        missing.insert(
            0,
            format!("Vulkan 1.3 (it has {})", version_text(core.api_version)),
        );
    }
    missing.extend(needs::lacks(&core.limits, push.max_push_descriptors));
    let driver_name = text(v12.driver_name_as_c_str());
    let driver_info = text(v12.driver_info_as_c_str());
    let limits = BindingLimits {
        storage_bytes: u64::from(core.limits.max_storage_buffer_range),
        uniform_bytes: u64::from(core.limits.max_uniform_buffer_range),
        immediate_bytes: core.limits.max_push_constants_size,
        workgroups: core.limits.max_compute_work_group_count,
        bindings: push.max_push_descriptors,
        texels: core.limits.max_texel_buffer_elements.into(),
        storage_images: core.limits.max_per_stage_descriptor_storage_images,
    };
    let info = DeviceInfo {
        name: text(core.device_name_as_c_str()),
        driver: format!("{driver_name} {driver_info}").trim().to_owned(),
        api: version_text(core.api_version),
        kind: core.device_type,
        limits,
        subgroup_size: v11.subgroup_size,
        least_subgroup_size: v13.min_subgroup_size,
        timestamp_period: if core.limits.timestamp_compute_and_graphics == vk::TRUE {
            core.limits.timestamp_period
        } else {
            0.0
        },
        features,
        // Vulkan promises 65,536 texels, of which a list soon has more, and four storage images, where a pass reads up to 32
        // arrays: a binder has a bit for each name that is given.
        reads_texels: core.device_type == vk::PhysicalDeviceType::CPU
            && features.storage_formats
            && limits.storage_images >= 32
            && limits.texels >= 1 << 27,
    };
    Properties {
        info,
        extensions,
        missing,
    }
}

fn device_extensions(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Vec<CString> {
    // SAFETY: `physical` is a device of `instance`.
    unsafe { instance.enumerate_device_extension_properties(physical) }
        .unwrap_or_default()
        .iter()
        .filter_map(|extension| extension.extension_name_as_c_str().ok())
        .map(CStr::to_owned)
        .collect()
}

/// Optional features that the device has, and required ones that it lacks.
fn query_features(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    extensions: &[CString],
    v11_properties: &vk::PhysicalDeviceVulkan11Properties<'_>,
) -> (EnabledFeatures, Vec<String>) {
    let mut v11 = vk::PhysicalDeviceVulkan11Features::default();
    let mut v12 = vk::PhysicalDeviceVulkan12Features::default();
    let mut v13 = vk::PhysicalDeviceVulkan13Features::default();
    let mut reconvergence = vk::PhysicalDeviceShaderMaximalReconvergenceFeaturesKHR::default();
    let mut features = vk::PhysicalDeviceFeatures2::default()
        .push_next(&mut v11)
        .push_next(&mut v12)
        .push_next(&mut v13);
    let may_reconverge = has(extensions, ash::khr::shader_maximal_reconvergence::NAME);
    if may_reconverge {
        features = features.push_next(&mut reconvergence);
    }
    // SAFETY: as for the properties in `query`.
    unsafe { instance.get_physical_device_features2(physical, &mut features) };
    let storage_formats = features.features.shader_storage_image_extended_formats == vk::TRUE;

    let mut missing = Vec::new();
    for (there, name) in [
        (v12.timeline_semaphore, "timelineSemaphore"),
        (v13.dynamic_rendering, "dynamicRendering"),
        (v13.synchronization2, "synchronization2"),
    ] {
        if there != vk::TRUE {
            missing.push(format!("the feature {name}"));
        }
    }
    if !has(extensions, ash::khr::push_descriptor::NAME) {
        missing.push("the extension VK_KHR_push_descriptor".to_owned());
    }
    let subgroup_operations = vk::SubgroupFeatureFlags::ARITHMETIC
        | vk::SubgroupFeatureFlags::BALLOT
        | vk::SubgroupFeatureFlags::SHUFFLE;
    let enabled = EnabledFeatures {
        float16: v12.shader_float16 == vk::TRUE && v11.storage_buffer16_bit_access == vk::TRUE,
        memory_model: v12.vulkan_memory_model == vk::TRUE
            && v12.vulkan_memory_model_device_scope == vk::TRUE,
        subgroups: v11_properties
            .subgroup_supported_operations
            .contains(subgroup_operations)
            && v11_properties
                .subgroup_supported_stages
                .contains(vk::ShaderStageFlags::COMPUTE),
        storage_formats,
        maximal_reconvergence: may_reconverge
            && reconvergence.shader_maximal_reconvergence == vk::TRUE,
    };
    (enabled, missing)
}

/// Whether `list` names `extension`.
pub(crate) fn has(list: &[CString], extension: &CStr) -> bool {
    list.iter().any(|name| name.as_c_str() == extension)
}
