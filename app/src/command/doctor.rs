//! `vitriol doctor`: what this machine has, and for what is missing a sentence
//! with the remedy.

use serde::Serialize;
use vitriol_gpu::advice::DRIVER;
use vitriol_gpu::vk::PhysicalDeviceType;
use vitriol_run::{Failure, Format, emit, in_a_line};

/// Major version of Mesa from which on [`SLOW_MESA`] is not said.
const QUICK_MESA: u32 = 25;

/// What is advised of an older software driver of Mesa's, as was measured in 2026-11. The LLVM matters: Mesa 25 was slower than 22.3
/// where both had LLVM 15 (docs/measurements/performance.md).
const SLOW_MESA: &str =
    "a newer driver is quicker: Mesa 25 with LLVM 19 takes 0.7 of Mesa 22.3's time";

#[derive(Debug, Serialize)]
struct Findings {
    /// A device is there that can replay a track.
    can_replay: bool,
    /// A headset's runtime is there too.
    can_enter_vr: bool,
    /// A screen is there for a window; absent where the build leaves sessions out.
    #[serde(skip_serializing_if = "Option::is_none")]
    screen: Option<bool>,
    /// Absent where the build leaves sessions out.
    #[serde(skip_serializing_if = "Option::is_none")]
    sound: Option<Sound>,
    devices: Vec<Device>,
    /// Absent where the build leaves OpenXR out.
    #[serde(skip_serializing_if = "Option::is_none")]
    openxr: Option<OpenXr>,
    /// What is missing, each in a sentence with its remedy.
    missing: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Device {
    index: usize,
    name: String,
    driver: String,
    vulkan: String,
    kind: String,
    usable: bool,
    /// Invocations of the smallest subgroup that the driver may choose, and per subgroup as a rule.
    subgroup_sizes: [u32; 2],
    /// Lanes that part in a loop meet again behind it for certain (VK_KHR_shader_maximal_reconvergence).
    maximal_reconvergence: bool,
    /// Required things that it lacks.
    missing: Vec<String>,
    /// Optional things that it lacks, with what is done instead.
    missing_optional: Vec<String>,
    /// What would make it quicker.
    #[serde(skip_serializing_if = "Option::is_none")]
    advice: Option<&'static str>,
    extensions: Vec<String>,
}

/// What `--sound` of a session may name.
#[derive(Debug, Serialize)]
struct Sound {
    outputs: Vec<SoundOutput>,
    /// Why they cannot be listed.
    #[serde(skip_serializing_if = "Option::is_none")]
    cause: Option<String>,
}

#[derive(Debug, Serialize)]
struct SoundOutput {
    name: String,
    description: String,
}

#[derive(Debug, Serialize)]
struct OpenXr {
    loader: bool,
    manifest: Option<String>,
    runtime: Option<String>,
    extensions: Vec<Extension>,
}

#[derive(Debug, Serialize)]
struct Extension {
    name: &'static str,
    present: bool,
}

/// Runs `vitriol doctor`. A thing that is missing is a finding and not a
/// failure.
///
/// # Errors
/// [`Failure::Other`] where standard output cannot be written.
pub fn run(format: Format) -> Result<(), Failure> {
    emit(format, &look(), describe)
}

fn look() -> Findings {
    let mut missing = Vec::new();
    let devices = match vitriol_gpu::list_devices() {
        Ok(devices) => devices,
        Err(error) => {
            missing.push(sentence(&error.to_string()));
            Vec::new()
        }
    };
    let devices: Vec<Device> = devices
        .into_iter()
        .enumerate()
        .map(|(index, device)| Device {
            index,
            name: device.info.name,
            advice: advice(device.info.kind, &device.info.driver),
            driver: device.info.driver,
            vulkan: device.info.api,
            kind: format!("{:?}", device.info.kind)
                .to_lowercase()
                .replace('_', " "),
            usable: device.missing.is_empty(),
            subgroup_sizes: [device.info.least_subgroup_size, device.info.subgroup_size],
            maximal_reconvergence: device.info.features.maximal_reconvergence,
            missing: device.missing,
            missing_optional: device.missing_optional,
            extensions: device.extensions,
        })
        .collect();
    let can_replay = devices.iter().any(|device| device.usable);
    if !can_replay && !devices.is_empty() {
        missing.push(format!(
            "None of the devices can be used: update their drivers, or {DRIVER}."
        ));
    }
    let (openxr, lacks) = openxr();
    let can_enter_vr = can_replay && lacks.is_empty();
    missing.extend(lacks);
    Findings {
        can_replay,
        can_enter_vr,
        screen: screen(),
        sound: sound(),
        devices,
        openxr,
        missing,
    }
}

/// What is advised for a device of that kind and driver.
fn advice(kind: PhysicalDeviceType, driver: &str) -> Option<&'static str> {
    // Mesa's words are such as "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)".
    let (_, version) = driver.split_once("Mesa ")?;
    let major: u32 = version.split('.').next()?.parse().ok()?;
    (kind == PhysicalDeviceType::CPU && major < QUICK_MESA).then_some(SLOW_MESA)
}

/// Whether there is a screen for the window of `vitriol desk`, if the build has that.
fn screen() -> Option<bool> {
    #[cfg(feature = "session")]
    return Some(vitriol_session::mirror::names_screen());
    #[cfg(not(feature = "session"))]
    None
}

/// The sound outputs, found within two seconds, if the build has sessions.
#[cfg(feature = "session")]
fn sound() -> Option<Sound> {
    let (outputs, cause) = match vitriol_sound::devices() {
        Ok(outputs) => (outputs, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    let outputs = outputs.into_iter().map(|output| SoundOutput {
        name: output.name,
        description: output.description,
    });
    Some(Sound {
        outputs: outputs.collect(),
        cause,
    })
}

/// Nothing.
#[cfg(not(feature = "session"))]
fn sound() -> Option<Sound> {
    None
}

/// The parts of OpenXR that are there, and those that are missing.
#[cfg(feature = "vr")]
fn openxr() -> (Option<OpenXr>, Vec<String>) {
    let probe = vitriol_xr::probe::probe();
    let extensions = probe.extensions.into_iter();
    let extensions = extensions.map(|(name, present)| Extension { name, present });
    let found = OpenXr {
        loader: probe.loader,
        manifest: probe.manifest.map(|path| path.display().to_string()),
        runtime: probe.runtime,
        extensions: extensions.collect(),
    };
    (Some(found), probe.missing)
}

/// Nothing, and that the build has no part for it.
#[cfg(not(feature = "vr"))]
fn openxr() -> (Option<OpenXr>, Vec<String>) {
    use crate::cli::left_out::REMEDY;
    let lack = format!("This build leaves headsets out: {REMEDY}.");
    (None, vec![lack])
}

fn describe(findings: &Findings) -> String {
    let mut text = String::new();
    for device in &findings.devices {
        text += &format!(
            "{} device {}: {} ({}), Vulkan {}, {}\n",
            mark(device.usable),
            device.index,
            device.name,
            device.kind,
            device.vulkan,
            device.driver
        );
        let [least, usual] = device.subgroup_sizes;
        text += &format!(
            "      subgroups of {usual}, at least {least}{}\n",
            if device.maximal_reconvergence {
                ", with maximal reconvergence"
            } else {
                ""
            }
        );
        for lack in &device.missing {
            text += &format!("      lacks {lack}\n");
        }
        for lack in &device.missing_optional {
            text += &format!("      without {lack}\n");
        }
        if let Some(advice) = device.advice {
            text += &format!("      {advice}\n");
        }
    }
    if let Some(openxr) = &findings.openxr {
        describe_openxr(openxr, &mut text);
    }
    if let Some(screen) = findings.screen {
        let remedy = match screen {
            true => "",
            false if cfg!(feature = "wayland") => {
                ": none, WAYLAND_DISPLAY and DISPLAY are not set; `vitriol desk` needs a Wayland compositor or an X server"
            }
            false => ": none, DISPLAY is not set; `vitriol desk` needs an X server",
        };
        text += &format!("{} screen{remedy}\n", mark(screen));
    }
    if let Some(sound) = &findings.sound {
        describe_sound(sound, &mut text);
    }
    if !findings.missing.is_empty() {
        text.push_str("\nMissing:\n");
        for lack in &findings.missing {
            text += &format!("- {lack}\n");
        }
    }
    text.push_str(match (findings.can_replay, findings.can_enter_vr) {
        (true, true) => "\nTracks can be replayed and a headset can be used.\n",
        (true, false) => "\nTracks can be replayed; a headset cannot be used yet.\n",
        (false, _) => "\nNothing can be replayed yet.\n",
    });
    text
}

fn describe_openxr(openxr: &OpenXr, text: &mut String) {
    *text += &format!("{} OpenXR loader\n", mark(openxr.loader));
    *text += &format!(
        "{} OpenXR runtime: {}\n",
        mark(openxr.runtime.is_some()),
        openxr.runtime.as_deref().unwrap_or("none answers")
    );
    for extension in &openxr.extensions {
        *text += &format!("      {} {}\n", mark(extension.present), extension.name);
    }
}

fn describe_sound(sound: &Sound, text: &mut String) {
    for SoundOutput { name, description } in &sound.outputs {
        let (name, description) = (in_a_line(name), in_a_line(description));
        *text += &format!("[ok] sound output {name}: {description}\n");
    }
    if sound.outputs.is_empty() {
        let cause = sound.cause.as_deref().map(in_a_line);
        let cause = cause.as_deref().unwrap_or("the system has none");
        *text += &format!("[--] sound output: {cause}\n");
    }
}

fn mark(there: bool) -> &'static str {
    if there { "[ok]" } else { "[--]" }
}

/// An error's message as a sentence of its own.
fn sentence(message: &str) -> String {
    let mut letters = message.chars();
    let first = letters.next().map(char::to_uppercase);
    format!(
        "{}{}.",
        first.into_iter().flatten().collect::<String>(),
        letters.as_str()
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// What a device offers it does not lack, and it has the extension for it.
    #[test]
    fn what_is_said_of_a_device_agrees() {
        for device in look().devices {
            let named = |names: &[String], part: &str| names.iter().any(|it| it.contains(part));
            let has = device.maximal_reconvergence;
            let extension = "VK_KHR_shader_maximal_reconvergence";
            assert!(!has || named(&device.extensions, extension));
            assert!(!has || !named(&device.missing_optional, "reconvergence"));
            let [least, usual] = device.subgroup_sizes;
            assert!(least <= usual && usual.is_power_of_two(), "{least} {usual}");
        }
    }

    /// Of Mesa's software driver alone, by its words as drivers say them.
    #[test]
    fn an_old_software_driver_is_told_what_is_quicker() {
        let cpu = PhysicalDeviceType::CPU;
        for (kind, driver, advised) in [
            (cpu, "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", true),
            (cpu, "llvmpipe Mesa 24.3.0-devel (LLVM 18.1.8)", true),
            (cpu, "llvmpipe Mesa 25.0.7-2 (LLVM 19.1.7)", false),
            (cpu, "llvmpipe Mesa 100.1.0 (LLVM 40.1.0)", false),
            (cpu, "llvmpipe Mesa (LLVM 15.0.6)", false),
            (cpu, "SwiftShader driver 5.0.0", false),
            (PhysicalDeviceType::DISCRETE_GPU, "radv Mesa 22.3.6", false),
        ] {
            assert_eq!(advice(kind, driver).is_some(), advised, "{driver}");
        }
    }

    /// By name and description, as `--sound` takes both; or why there are none.
    #[test]
    fn sound_outputs_are_lines_of_their_own() {
        let told = |outputs: &[(&str, &str)], cause: Option<&str>| {
            let output = |&(name, description): &(&str, &str)| SoundOutput {
                name: name.to_owned(),
                description: description.to_owned(),
            };
            let sound = Sound {
                outputs: outputs.iter().map(output).collect(),
                cause: cause.map(str::to_owned),
            };
            let mut text = String::new();
            describe_sound(&sound, &mut text);
            text
        };
        assert_eq!(
            told(&[("alsa.hdmi", "HDMI"), ("usb", "Head\nset")], None),
            "[ok] sound output alsa.hdmi: HDMI\n[ok] sound output usb: Head\\nset\n"
        );
        assert_eq!(told(&[], Some("busy")), "[--] sound output: busy\n");
        assert_eq!(told(&[], None), "[--] sound output: the system has none\n");
    }

    /// The advice is one line below its device, and JSON has it too.
    #[test]
    fn advice_is_one_line_of_its_device() {
        let device = |driver: &str| Device {
            index: 0,
            name: "llvmpipe".to_owned(),
            driver: driver.to_owned(),
            vulkan: "1.3.230".to_owned(),
            kind: "cpu".to_owned(),
            usable: true,
            subgroup_sizes: [8, 8],
            maximal_reconvergence: false,
            missing: Vec::new(),
            missing_optional: Vec::new(),
            advice: advice(PhysicalDeviceType::CPU, driver),
            extensions: Vec::new(),
        };
        let of = |device: Device| Findings {
            can_replay: true,
            can_enter_vr: true,
            screen: None,
            sound: None,
            devices: vec![device],
            openxr: None,
            missing: Vec::new(),
        };
        for (driver, advised) in [
            ("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", 1),
            ("llvmpipe Mesa 25.0.7 (LLVM 19.1.7)", 0),
        ] {
            let found = of(device(driver));
            let text = describe(&found);
            let lines = text.lines().filter(|line| line.contains("Mesa 25 with"));
            assert_eq!(lines.count(), advised, "{text}");
            let json = serde_json::to_value(&found).unwrap();
            assert_eq!(json["devices"][0]["advice"].is_string(), advised == 1);
        }
    }
}
