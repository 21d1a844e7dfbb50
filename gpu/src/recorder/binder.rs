//! Names of a pass or draw, resolved against the declarations of its shaders.

use ash::vk;
use bytemuck::NoUninit;
use vitriol_shaders::{BindingKind, ImageDimension};

use crate::pipeline::{DescriptorData, Layout, Slot};
use crate::submission::Storage;
use crate::{Buffer, GpuError, Image, Sampler};

/// The way in which a buffer or image was given.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Asked {
    Read,
    Write,
    Uniform,
}

/// Bindings of one pass or draw. The first mistake is kept and returned at the end.
pub(crate) struct Binder<'a> {
    layout: &'a Layout,
    /// Label of the pass in messages.
    label: &'a [u8],
    /// Bit per slot that has been given.
    bound: u32,
    /// First descriptor and first byte of immediates in the storage.
    pub(crate) descriptors: usize,
    pub(crate) constants: usize,
    error: Option<Box<GpuError>>,
}

impl<'a> Binder<'a> {
    pub(crate) fn new(storage: &mut Storage, layout: &'a Layout, label: &'a [u8]) -> Self {
        let descriptors = storage.descriptors.len();
        storage
            .descriptors
            .resize(descriptors + layout.slots.len(), DescriptorData::EMPTY);
        Self {
            layout,
            label,
            bound: 0,
            descriptors,
            constants: storage.constants.len(),
            error: None,
        }
    }

    pub(crate) fn set_label(&mut self, label: &'a [u8]) {
        self.label = label;
    }

    pub(crate) fn label(&self) -> &'a [u8] {
        self.label
    }

    #[cold]
    pub(crate) fn fail(&mut self, error: GpuError) {
        self.error.get_or_insert_with(|| Box::new(error));
    }

    #[cold]
    fn refuse(&mut self, name: &str, cause: String) {
        let error = GpuError::Binding {
            pass: self.label_text(),
            binding: name.to_owned(),
            cause,
        };
        self.fail(error);
    }

    pub(crate) fn label_text(&self) -> String {
        String::from_utf8_lossy(self.label).into_owned()
    }

    /// Index of the slot called `name`, which is now given.
    fn take(&mut self, name: &str) -> Option<(usize, &'a Slot)> {
        let slots: &'a [Slot] = &self.layout.slots;
        let Some(index) = slots.iter().position(|slot| slot.name == name) else {
            // One expression serves every specialisation of its shader.
            if self.layout.is_unused(name) {
                return None;
            }
            let known = self.names(u32::MAX);
            self.refuse(
                name,
                format!("the shader declares no such name; it binds {known}"),
            );
            return None;
        };
        if self.bound & (1 << index) != 0 {
            self.refuse(name, "given twice; name it once".to_owned());
            return None;
        }
        self.bound |= 1 << index;
        Some((index, &slots[index]))
    }

    fn names(&self, mask: u32) -> String {
        let names: Vec<&str> = self
            .layout
            .slots
            .iter()
            .enumerate()
            .filter(|(index, _)| mask & (1 << index) != 0)
            .map(|(_, slot)| slot.name.as_str())
            .collect();
        if names.is_empty() {
            "nothing".to_owned()
        } else {
            names.join(", ")
        }
    }

    pub(crate) fn buffer(
        &mut self,
        storage: &mut Storage,
        name: &str,
        buffer: &Buffer,
        asked: Asked,
    ) {
        let Some((index, slot)) = self.take(name) else {
            return;
        };
        let inner = &buffer.inner;
        let wrong = match (slot.kind, asked) {
            (BindingKind::Storage { writable: true }, Asked::Write)
            | (BindingKind::Storage { writable: false } | BindingKind::Texels(_), Asked::Read) => {
                (!inner.usage.contains(vk::BufferUsageFlags::STORAGE_BUFFER)).then(|| {
                    format!(
                        "\"{}\" is no storage buffer; make it with Buffer::storage",
                        inner.label
                    )
                })
            }
            (BindingKind::Uniform { bytes }, Asked::Uniform) => {
                if !inner.usage.contains(vk::BufferUsageFlags::UNIFORM_BUFFER) {
                    Some(format!(
                        "\"{}\" is no uniform buffer; make it with Buffer::uniform",
                        inner.label
                    ))
                } else if inner.bytes < u64::from(bytes) {
                    Some(format!(
                        "\"{}\" has {} bytes, the shader reads {bytes}",
                        inner.label, inner.bytes
                    ))
                } else {
                    None
                }
            }
            (BindingKind::Storage { writable: true }, Asked::Read) => {
                Some("the shader declares it read_write; give it with .write".to_owned())
            }
            (BindingKind::Storage { writable: false } | BindingKind::Texels(_), Asked::Write) => {
                Some("the shader declares it read-only; give it with .read".to_owned())
            }
            (kind, _) => Some(wrong_kind(&kind)),
        };
        if let Some(cause) = wrong {
            return self.refuse(name, cause);
        }
        storage.descriptors[self.descriptors + index] = match slot.kind {
            BindingKind::Texels(format) => match inner.texels(format) {
                Ok(texels) => DescriptorData { texels },
                Err(error) => return self.fail(error),
            },
            _ => DescriptorData {
                buffer: vk::DescriptorBufferInfo {
                    buffer: inner.handle,
                    offset: 0,
                    range: vk::WHOLE_SIZE,
                },
            },
        };
        storage.use_buffer(buffer, slot.scope);
        storage.pass_bytes += inner.bytes;
    }

    pub(crate) fn image(
        &mut self,
        storage: &mut Storage,
        name: &str,
        image: &Image,
        as_storage: bool,
    ) {
        let Some((index, slot)) = self.take(name) else {
            return;
        };
        let inner = &image.inner;
        let usage = inner.desc.usage;
        let (dimension, arrayed, layout, needed) = match slot.kind {
            BindingKind::SampledImage {
                dimension, arrayed, ..
            } if !as_storage => {
                // An image that is stored to as well stays in one layout.
                let layout = if usage.contains(vk::ImageUsageFlags::STORAGE) {
                    vk::ImageLayout::GENERAL
                } else {
                    vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL
                };
                (dimension, arrayed, layout, vk::ImageUsageFlags::SAMPLED)
            }
            BindingKind::StorageImage {
                dimension, arrayed, ..
            } if as_storage => (
                dimension,
                arrayed,
                vk::ImageLayout::GENERAL,
                vk::ImageUsageFlags::STORAGE,
            ),
            kind => return self.refuse(name, wrong_kind(&kind)),
        };
        if dimension != ImageDimension::D2 {
            return self.refuse(name, "only 2-D images are bound".to_owned());
        }
        if !usage.contains(needed) {
            return self.refuse(
                name,
                format!(
                    "image \"{}\" was not made for {needed:?}; add it to its usage",
                    inner.label
                ),
            );
        }
        storage.descriptors[self.descriptors + index] = DescriptorData {
            image: vk::DescriptorImageInfo {
                sampler: vk::Sampler::null(),
                image_view: if arrayed {
                    inner.array_view
                } else {
                    inner.plain_view
                },
                image_layout: layout,
            },
        };
        if let Err(error) = storage.use_image(image, layout, slot.scope, false) {
            self.fail(error);
        }
    }

    pub(crate) fn sampler(&mut self, storage: &mut Storage, name: &str, sampler: &Sampler) {
        let Some((index, slot)) = self.take(name) else {
            return;
        };
        match slot.kind {
            BindingKind::Sampler { comparison: false } => {}
            BindingKind::Sampler { comparison: true } => {
                return self.refuse(name, "no sampler that compares is bound".to_owned());
            }
            kind => return self.refuse(name, wrong_kind(&kind)),
        }
        storage.descriptors[self.descriptors + index] = DescriptorData {
            image: vk::DescriptorImageInfo {
                sampler: sampler.inner.handle,
                image_view: vk::ImageView::null(),
                image_layout: vk::ImageLayout::UNDEFINED,
            },
        };
        storage.retain(sampler.inner.clone());
    }

    pub(crate) fn constants<T: NoUninit>(&mut self, storage: &mut Storage, value: &T) {
        let bytes = bytemuck::bytes_of(value);
        let declared = self.layout.immediate_bytes;
        if self.layout.drops_immediates() {
            return;
        }
        if bytes.len() != declared as usize || storage.constants.len() != self.constants {
            let error = GpuError::Constants {
                pass: self.label_text(),
                declared,
                given: storage.constants.len() - self.constants + bytes.len(),
            };
            return self.fail(error);
        }
        storage.constants.extend_from_slice(bytes);
    }

    /// Returns the first mistake, or the missing binding.
    pub(crate) fn check(&mut self, storage: &Storage) -> Result<(), GpuError> {
        if let Some(error) = self.error.take() {
            return Err(*error);
        }
        let count = self.layout.slots.len() as u32;
        let all = if count == 32 {
            u32::MAX
        } else {
            (1 << count) - 1
        };
        let missing = all & !self.bound;
        if missing != 0 {
            return Err(GpuError::Binding {
                pass: self.label_text(),
                binding: self.names(missing),
                cause: "not given; the shader binds it".to_owned(),
            });
        }
        let given = storage.constants.len() - self.constants;
        if given != self.layout.immediate_bytes as usize {
            return Err(GpuError::Constants {
                pass: self.label_text(),
                declared: self.layout.immediate_bytes,
                given,
            });
        }
        Ok(())
    }
}

fn wrong_kind(kind: &BindingKind) -> String {
    let (what, how) = match kind {
        BindingKind::Storage { writable: false } | BindingKind::Texels(_) => {
            ("a read-only storage buffer", ".read")
        }
        BindingKind::Storage { writable: true } => ("a read_write storage buffer", ".write"),
        BindingKind::Uniform { .. } => ("a uniform buffer", ".uniform"),
        BindingKind::SampledImage { .. } => ("a sampled image", ".sampled"),
        BindingKind::StorageImage { .. } => ("a storage image", ".storage_image"),
        BindingKind::Sampler { .. } => ("a sampler", ".sampler"),
    };
    format!("the shader declares {what}; give it with {how}")
}
