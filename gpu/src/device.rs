//! Instance and device: how they are chosen, opened and described.

mod cache;
mod core;
mod create;
mod info;
mod list;
mod lock;
mod needs;
mod open;
mod options;
mod plan;
mod provider;
mod select;
mod validation;

pub use self::core::Core;
pub use info::{BindingLimits, DeviceInfo, EnabledFeatures};
pub use list::{DeviceSummary, list_devices};
pub use lock::{LockWaits, Waits};
pub(crate) use lock::{lock, lock_memory, lock_queue};
pub use needs::{NEEDS, Needs};
pub(crate) use open::open;
pub use options::{Options, Timestamps};
pub(crate) use plan::{Place, QueuePlan};
pub use provider::{DeviceRequest, InstanceRequest, PlainLoader, Provider, QueueRequest};
pub use select::Candidate;
