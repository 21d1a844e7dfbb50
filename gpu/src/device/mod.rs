//! Instance, device and queues: how they are made and what they offer.

mod core;
mod create;
mod info;
mod open;
mod provider;
mod queue;
mod select;
mod ticket;
mod validation;

pub(crate) use self::core::{Core, lock};
pub use info::{BindingLimits, DeviceInfo, EnabledFeatures};
pub use open::{DeviceHandles, Gpu, Options, Timestamps};
pub use provider::{DeviceRequest, InstanceRequest, PlainLoader, Provider, QueueRequest};
pub use queue::QueueKind;
pub use select::{Candidate, DeviceSummary, list_devices};
pub(crate) use ticket::Submission;
pub use ticket::Ticket;
