//! OpenXR's arguments as Rust types.
//!
//! Entry points are declared with references where OpenXR has pointers to one structure: the two are passed alike, null is `None`, and
//! OpenXR requires valid pointers of its callers. Structures that are to be filled in are plain numbers, for which any bits that lie there
//! are values.

use std::ffi::{CStr, c_char};

use openxr::sys;
use sys::Result as R;

/// The result of an entry point; an error leaves nothing changed.
pub(crate) type Answer = Result<R, R>;

/// An array of the caller, which is to be filled.
#[repr(transparent)]
pub(crate) struct Buffer<T>(pub *mut T);

/// A C string of the caller.
#[repr(transparent)]
pub(crate) struct Text(*const c_char);

impl Text {
    /// The string's text.
    pub(crate) fn read(&self) -> Result<String, R> {
        if self.0.is_null() {
            return Err(R::ERROR_VALIDATION_FAILURE);
        }
        // SAFETY: OpenXR's callers pass strings that end with 0 and live through the call.
        let text = unsafe { CStr::from_ptr(self.0) };
        let text = text.to_str().map_err(|_| R::ERROR_VALIDATION_FAILURE)?;
        Ok(text.to_owned())
    }
}

/// OpenXR's two-call idiom: writes the number of elements, and then, where there is room, the elements.
pub(crate) fn fill<T>(
    capacity: u32,
    count: Option<&mut u32>,
    buffer: &Buffer<T>,
    wanted: usize,
    mut put: impl FnMut(usize, &mut T),
) -> Answer {
    *count.ok_or(R::ERROR_VALIDATION_FAILURE)? = wanted as u32;
    if capacity == 0 {
        return Ok(R::SUCCESS);
    }
    if (capacity as usize) < wanted {
        return Err(R::ERROR_SIZE_INSUFFICIENT);
    }
    if buffer.0.is_null() {
        return Err(R::ERROR_VALIDATION_FAILURE);
    }
    for index in 0..wanted {
        // SAFETY: OpenXR's callers pass room for `capacity` elements, of which there are no fewer than
        // `wanted`; see the module for what lies there.
        put(index, unsafe { &mut *buffer.0.add(index) });
    }
    Ok(R::SUCCESS)
}

/// [`fill`] with the values `items`.
pub(crate) fn fill_with<T: Copy>(
    capacity: u32,
    count: Option<&mut u32>,
    buffer: &Buffer<T>,
    items: &[T],
) -> Answer {
    fill(capacity, count, buffer, items.len(), |index, slot| {
        *slot = items[index];
    })
}

/// [`fill`] with a string and its terminating 0.
pub(crate) fn fill_text(
    capacity: u32,
    count: Option<&mut u32>,
    buffer: &Buffer<c_char>,
    text: &str,
) -> Answer {
    let bytes: Vec<c_char> = text.bytes().chain([0]).map(|byte| byte as c_char).collect();
    fill_with(capacity, count, buffer, &bytes)
}

/// An array of the caller, as a slice.
///
/// # Safety
/// `first` is the first of `count` elements that live as long as the result, or `count` is 0.
pub(crate) unsafe fn list<'a, T>(count: u32, first: *const T) -> Result<&'a [T], R> {
    match count {
        0 => Ok(&[]),
        _ if first.is_null() => Err(R::ERROR_VALIDATION_FAILURE),
        // SAFETY: by this function's own contract.
        _ => Ok(unsafe { std::slice::from_raw_parts(first, count as usize) }),
    }
}

/// The first structure of type `ty` in a chain of inputs.
///
/// # Safety
/// `next` begins a chain of OpenXR's structures that live as long as the result, and `T` is the structure
/// of type `ty`.
pub(crate) unsafe fn chained<'a, T>(
    mut next: *const std::ffi::c_void,
    ty: sys::StructureType,
) -> Option<&'a T> {
    while !next.is_null() {
        // SAFETY: every structure of a chain begins like this one.
        let header = unsafe { &*next.cast::<sys::BaseInStructure>() };
        if header.ty == ty {
            // SAFETY: by this function's own contract.
            return Some(unsafe { &*next.cast::<T>() });
        }
        next = header.next.cast();
    }
    None
}

/// Writes a string and its terminating 0 into a field that is long enough for it.
pub(crate) fn put_text(field: &mut [c_char], text: &str) {
    for (slot, byte) in field.iter_mut().zip(text.bytes().chain([0])) {
        *slot = byte as c_char;
    }
}

/// Reads a string from a field.
pub(crate) fn text_of(field: &[c_char]) -> String {
    let bytes = field.iter().map(|byte| *byte as u8);
    String::from_utf8_lossy(&bytes.take_while(|byte| *byte != 0).collect::<Vec<_>>()).into_owned()
}

/// The structure behind a pointer, if its type field is right.
macro_rules! given {
    ($pointer:expr, $structure:ty) => {
        match $pointer {
            Some(given) if given.ty == <$structure>::TYPE => given,
            _ => return Err(openxr::sys::Result::ERROR_VALIDATION_FAILURE),
        }
    };
}

/// The plain value behind a pointer.
macro_rules! place {
    ($pointer:expr) => {
        match $pointer {
            Some(given) => given,
            None => return Err(openxr::sys::Result::ERROR_VALIDATION_FAILURE),
        }
    };
}

pub(crate) use {given, place};
