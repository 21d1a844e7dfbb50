//! Opening: choice of device, what the provider adds, and refusals.

use vitriol_gpu::{
    DeviceRequest, Gpu, GpuError, InstanceRequest, NEEDS, Options, PlainLoader, Provider, ash,
    list_devices, vk,
};
use vitriol_shaders::{ALL, Binding, BindingKind, Library};

use crate::common::{assert_silent, open};

#[test]
fn devices_are_listed_and_described() {
    let gpu = open();
    let all = list_devices().unwrap();
    assert!(
        all.iter()
            .any(|device| device.info.name == gpu.info().name && device.missing.is_empty())
    );
    assert!(
        all[0]
            .extensions
            .iter()
            .any(|name| name == "VK_KHR_push_descriptor")
    );
    let info = gpu.info();
    // Lower limits than Vulkan 1.3 asks of every device would be misread ones.
    assert!(info.limits.storage_bytes >= 1 << 27, "{info:?}");
    assert!(
        info.limits.immediate_bytes >= 128 && info.limits.bindings >= 32,
        "{info:?}"
    );
    assert!(info.subgroup_size.is_power_of_two(), "{info:?}");
    assert!(
        !info.driver.is_empty() && info.api.starts_with("1."),
        "{info:?}"
    );
}

/// The limits that are required of a device are those that the shaders need, with all features on that go together.
#[test]
fn no_shader_needs_more_than_is_asked_for() {
    let library = Library::embedded();
    // Of the two chemistries one is on.
    let chemistries = [["DILUTION", "BOILING"].as_slice(), &["PHYSICAL"]];
    let (mut buffers, mut bindings, mut invocations) = (0, 0, 0);
    for id in ALL {
        if !library.source(id).unwrap().contains("@compute") {
            continue;
        }
        let flags = library.constants(id).unwrap();
        let is_flag = |name: &str| {
            let text = library.source(id).unwrap();
            text.contains(&format!("override {name}: bool"))
        };
        for off in chemistries {
            let on: Vec<(&str, f64)> = flags
                .iter()
                .map(String::as_str)
                .filter(|name| (is_flag(name) || *name == "HYSTERESIS") && !off.contains(name))
                .map(|name| (name, 1.0))
                .collect();
            let compiled = library.compile(id, "main", &on).unwrap();
            let storage = |binding: &&Binding| matches!(binding.kind, BindingKind::Storage { .. });
            let count = compiled.bindings.iter().filter(storage).count();
            buffers = buffers.max(count as u32);
            bindings = bindings.max(compiled.bindings.len() as u32);
            invocations = invocations.max(compiled.workgroup_size.iter().product());
        }
    }
    assert!(buffers <= NEEDS.storage_buffers, "{buffers}");
    assert!(bindings <= NEEDS.bindings, "{bindings}");
    assert_eq!(invocations, NEEDS.invocations);
}

#[test]
fn a_device_that_is_not_there_is_named() {
    let options = Options {
        device: Some("no such card".to_owned()),
        ..Options::default()
    };
    let Err(error) = Gpu::open(&mut PlainLoader::default(), &options) else {
        panic!("opened")
    };
    assert!(matches!(error, GpuError::NoSuchDevice { .. }), "{error}");
}

#[test]
fn an_instance_extension_that_is_not_offered_is_named() {
    let mut loader = PlainLoader {
        instance_extensions: vec![c"VK_KHR_no_such_surface".to_owned()],
        ..PlainLoader::default()
    };
    let Err(error) = Gpu::open(&mut loader, &Options::default()) else {
        panic!("opened")
    };
    assert!(
        error.to_string().contains("VK_KHR_no_such_surface"),
        "{error}"
    );
}

/// A provider as an OpenXR runtime is one: it makes the instance and the device
/// from our create infos, adds its own needs and is tied to one device.
#[derive(Default)]
struct Runtime {
    loader: PlainLoader,
    steps: Vec<&'static str>,
}

// SAFETY: the loader underneath does the work; the device is a candidate.
unsafe impl Provider for Runtime {
    fn amend_instance(&self, request: &mut InstanceRequest) {
        request
            .extensions
            .push(c"VK_KHR_external_memory_capabilities".to_owned());
    }
    fn create_instance(
        &mut self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<vk::Instance, GpuError> {
        self.steps.push("instance");
        self.loader.create_instance(entry, info)
    }
    fn choose(
        &mut self,
        _instance: &ash::Instance,
        candidates: &[vitriol_gpu::Candidate],
        _wanted: Option<&str>,
    ) -> Result<vk::PhysicalDevice, GpuError> {
        self.steps.push("choose");
        candidates
            .first()
            .map(|candidate| candidate.handle)
            .ok_or(GpuError::NoDevice)
    }
    fn amend_device(&self, request: &mut DeviceRequest) {
        request
            .extensions
            .push(c"VK_KHR_external_memory".to_owned());
    }
    fn create_device(
        &mut self,
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<vk::Device, GpuError> {
        self.steps.push("device");
        self.loader.create_device(instance, physical, info)
    }
}

#[test]
fn a_runtime_can_be_the_provider() {
    let mut runtime = Runtime::default();
    let options = Options {
        validation: true,
        ..Options::default()
    };
    let gpu = Gpu::open(&mut runtime, &options).unwrap();
    assert_eq!(runtime.steps, ["instance", "choose", "device"]);
    assert_silent(&gpu);
}

/// A provider whose device creation fails: what was made before is undone.
struct Failing(PlainLoader);

// SAFETY: it returns only what the loader returns.
unsafe impl Provider for Failing {
    fn create_instance(
        &mut self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<vk::Instance, GpuError> {
        self.0.create_instance(entry, info)
    }
    fn create_device(
        &mut self,
        _instance: &ash::Instance,
        _physical: vk::PhysicalDevice,
        _info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<vk::Device, GpuError> {
        Err(GpuError::Provider {
            provider: "the failing runtime".to_owned(),
            step: "create the device",
            cause: "the headset is unplugged; plug it in".to_owned(),
        })
    }
}

#[test]
fn a_provider_that_fails_half_way_is_told() {
    let Err(error) = Gpu::open(&mut Failing(PlainLoader::default()), &Options::default()) else {
        panic!("opened")
    };
    let text = error.to_string();
    assert!(
        text.contains("the failing runtime") && text.contains("plug it in"),
        "{text}"
    );
}
