//! Swapchains of three images, of which one after the other is acquired, waited for and released.

use std::collections::VecDeque;

use openxr::sys;
use serde_json::json;
use sys::{Handle as _, Result as R};

use crate::abi::{Buffer, fill, fill_with, given, place};
use crate::instance::LARGEST;
use crate::pictures::Pictures;
use crate::state::{State, call, locked, told};

use ash::vk::Handle as _;

/// Target of an XrSwapchain handle.
pub(crate) struct Swapchain {
    pub session: u64,
    pub format: i64,
    pub extent: [u32; 2],
    pub layers: u32,
    pub pictures: Pictures,
    /// Index of the image that is acquired next.
    next: usize,
    /// Indices of the images that are acquired and not released, the oldest first.
    acquired: VecDeque<usize>,
    /// Whether the oldest of them was waited for.
    waited: bool,
    /// Whether an image was released once.
    pub released: bool,
}

impl Swapchain {
    /// A swapchain as `info` describes it.
    pub(crate) fn new(session: u64, info: &sys::SwapchainCreateInfo, pictures: Pictures) -> Self {
        Self {
            session,
            format: info.format,
            extent: [info.width, info.height],
            layers: info.array_size,
            pictures,
            next: 0,
            acquired: VecDeque::new(),
            waited: false,
            released: false,
        }
    }
}

impl State {
    fn chain(&mut self, swapchain: sys::Swapchain) -> Result<&mut Swapchain, R> {
        let raw = swapchain.into_raw();
        let session = self.swapchains.get(&raw).map(|chain| chain.session);
        self.session_of(session.ok_or(R::ERROR_HANDLE_INVALID)?)?;
        let chain = self.swapchains.get_mut(&raw);
        chain.ok_or(R::ERROR_HANDLE_INVALID)
    }
}

pub(crate) extern "system" fn enumerate_swapchain_formats(
    session: sys::Session,
    capacity: u32,
    count: Option<&mut u32>,
    formats: Buffer<i64>,
) -> R {
    call("xrEnumerateSwapchainFormats", |state| {
        state.session(session)?;
        fill_with(capacity, count, &formats, &state.world.formats)
    })
}

pub(crate) extern "system" fn create_swapchain(
    session: sys::Session,
    info: Option<&sys::SwapchainCreateInfo>,
    swapchain: Option<&mut sys::Swapchain>,
) -> R {
    let with = info.map(|info| {
        json!({
            "format": info.format,
            "width": info.width,
            "height": info.height,
            "layers": info.array_size,
            "usage": info.usage_flags.into_raw(),
        })
    });
    let mut facts = Vec::new();
    if let Some(info) = info {
        facts.push(info.format.to_string());
        facts.push(format!("{} x {}", info.width, info.height));
        if info.array_size > 1 {
            facts.push("layers>1".to_owned());
        }
    }
    locked(|state| {
        state.told(
            "xrCreateSwapchain",
            with.unwrap_or_default(),
            &facts,
            |state, with| {
                state.session(session)?;
                let info = given!(info, sys::SwapchainCreateInfo);
                if !state.world.formats.contains(&info.format) {
                    return Err(R::ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
                }
                if info.array_size > state.world.array_layers
                    || info.sample_count > 1
                    || info.face_count > 1
                    || info.create_flags != sys::SwapchainCreateFlags::EMPTY
                {
                    return Err(R::ERROR_FEATURE_UNSUPPORTED);
                }
                let counts = [
                    info.array_size,
                    info.sample_count,
                    info.face_count,
                    info.mip_count,
                ];
                let sized = |side: u32| (1..=LARGEST).contains(&side);
                if counts.contains(&0) || !sized(info.width) || !sized(info.height) {
                    return Err(R::ERROR_VALIDATION_FAILURE);
                }
                let device = state.session(session)?.device.as_ref();
                let device = device.ok_or(R::ERROR_GRAPHICS_DEVICE_INVALID)?;
                let pictures = device.pictures(info)?;
                let raw = state.handle();
                let made = Swapchain::new(session.into_raw(), info, pictures);
                state.swapchains.insert(raw, made);
                with["swapchain"] = json!(raw);
                *place!(swapchain) = sys::Swapchain::from_raw(raw);
                Ok(R::SUCCESS)
            },
        )
    })
}

pub(crate) extern "system" fn destroy_swapchain(swapchain: sys::Swapchain) -> R {
    let raw = swapchain.into_raw();
    told(
        "xrDestroySwapchain",
        json!({ "swapchain": raw }),
        |state, _| {
            let chain = state.swapchains.remove(&raw);
            let chain = chain.ok_or(R::ERROR_HANDLE_INVALID)?;
            // It cannot outlive its session.
            if let Some(device) = &state.sessions[&chain.session].device {
                device.destroy(&chain.pictures);
            }
            Ok(R::SUCCESS)
        },
    )
}

pub(crate) extern "system" fn enumerate_swapchain_images(
    swapchain: sys::Swapchain,
    capacity: u32,
    count: Option<&mut u32>,
    images: Buffer<sys::SwapchainImageVulkanKHR>,
) -> R {
    call("xrEnumerateSwapchainImages", |state| {
        let pictures = &state.chain(swapchain)?.pictures.all;
        fill(capacity, count, &images, pictures.len(), |index, slot| {
            slot.image = pictures[index].image.as_raw();
        })
    })
}

pub(crate) extern "system" fn acquire_swapchain_image(
    swapchain: sys::Swapchain,
    _info: Option<&sys::SwapchainImageAcquireInfo>,
    index: Option<&mut u32>,
) -> R {
    let with = json!({ "swapchain": swapchain.into_raw() });
    told("xrAcquireSwapchainImage", with, |state, with| {
        let chain = state.chain(swapchain)?;
        let index = place!(index);
        if chain.acquired.len() == chain.pictures.all.len() {
            return Err(R::ERROR_CALL_ORDER_INVALID);
        }
        let next = chain.next;
        chain.next = (next + 1) % chain.pictures.all.len();
        chain.acquired.push_back(next);
        with["index"] = json!(next);
        *index = next as u32;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn wait_swapchain_image(
    swapchain: sys::Swapchain,
    info: Option<&sys::SwapchainImageWaitInfo>,
) -> R {
    let with = json!({ "swapchain": swapchain.into_raw() });
    told("xrWaitSwapchainImage", with, |state, _| {
        given!(info, sys::SwapchainImageWaitInfo);
        let chain = state.chain(swapchain)?;
        if chain.acquired.is_empty() || chain.waited {
            return Err(R::ERROR_CALL_ORDER_INVALID);
        }
        chain.waited = true;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn release_swapchain_image(
    swapchain: sys::Swapchain,
    _info: Option<&sys::SwapchainImageReleaseInfo>,
) -> R {
    let with = json!({ "swapchain": swapchain.into_raw() });
    told("xrReleaseSwapchainImage", with, |state, _| {
        let chain = state.chain(swapchain)?;
        if !chain.waited {
            return Err(R::ERROR_CALL_ORDER_INVALID);
        }
        let session = chain.session;
        let index = chain.acquired[0];
        let chain = &state.swapchains[&swapchain.into_raw()];
        if let Some(device) = &state.sessions[&session].device {
            device.look(&chain.pictures.all[index])?;
        }
        let chain = state.chain(swapchain)?;
        chain.waited = false;
        chain.released = true;
        chain.acquired.pop_front();
        Ok(R::SUCCESS)
    })
}
