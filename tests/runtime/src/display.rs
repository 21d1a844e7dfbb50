//! The display: its rates (XR_FB_display_refresh_rate) and the part of it that no eye sees (XR_KHR_visibility_mask).

use openxr::sys;
use serde_json::json;
use sys::Result as R;

use crate::abi::{Buffer, fill, fill_with, given, place};
use crate::number::Number;
use crate::state::{call, told};

pub(crate) extern "system" fn enumerate_display_refresh_rates(
    session: sys::Session,
    capacity: u32,
    count: Option<&mut u32>,
    rates: Buffer<f32>,
) -> R {
    call("xrEnumerateDisplayRefreshRatesFB", |state| {
        state.session_has(session, "XR_FB_display_refresh_rate")?;
        fill_with(capacity, count, &rates, &state.world.rates)
    })
}

pub(crate) extern "system" fn get_display_refresh_rate(
    session: sys::Session,
    rate: Option<&mut f32>,
) -> R {
    call("xrGetDisplayRefreshRateFB", |state| {
        state.session_has(session, "XR_FB_display_refresh_rate")?;
        *place!(rate) = state.world.rate;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn request_display_refresh_rate(session: sys::Session, rate: f32) -> R {
    let with = json!({ "rate": Number(rate) });
    told("xrRequestDisplayRefreshRateFB", with, |state, _| {
        state.session_has(session, "XR_FB_display_refresh_rate")?;
        // 0 leaves it to the runtime.
        if rate == 0.0 {
            return Ok(R::SUCCESS);
        }
        if !state.world.rates.contains(&rate) {
            return Err(R::ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB);
        }
        let from = state.world.rate;
        if from != rate {
            state.world.set_rate(rate);
        }
        state.raise_rate(from, rate);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_visibility_mask(
    session: sys::Session,
    views: sys::ViewConfigurationType,
    eye: u32,
    kind: sys::VisibilityMaskTypeKHR,
    answer: Option<&mut sys::VisibilityMaskKHR>,
) -> R {
    call("xrGetVisibilityMaskKHR", |state| {
        state.session_has(session, "XR_KHR_visibility_mask")?;
        state.session_offers(session, views)?;
        let answer = given!(answer, sys::VisibilityMaskKHR);
        let masks = &state.world.masks;
        let mask = masks.get(eye as usize).ok_or(R::ERROR_VALIDATION_FAILURE)?;
        let mut mask = mask.clone();
        if kind != sys::VisibilityMaskTypeKHR::HIDDEN_TRIANGLE_MESH {
            mask = Default::default();
        }
        // Both at once: room for one alone is too little.
        let rooms = [answer.vertex_capacity_input, answer.index_capacity_input];
        let (vertices, indices) = (Buffer(answer.vertices), Buffer(answer.indices));
        let count = Some(&mut answer.vertex_count_output);
        let first = fill(
            rooms[0],
            count,
            &vertices,
            mask.vertices.len(),
            |index, slot| {
                let [x, y] = mask.vertices[index];
                *slot = sys::Vector2f { x, y };
            },
        );
        let count = Some(&mut answer.index_count_output);
        let second = fill_with(rooms[1], count, &indices, &mask.indices);
        first.and(second)
    })
}
