//! Accessors: typed views of buffers. An accessor is checked against its bytes when it is opened. After that every
//! element can be read without allocation.

use super::document::{Document, View, item, label};
use super::extensions;
use crate::budget::Budget;
use crate::error::LoadProblem;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;
use std::borrow::Cow;

/// An opened accessor.
pub(super) struct Accessor<'a> {
    name: String,
    pub(super) count: usize,
    pub(super) shape: Type,
    pub(super) component: ComponentType,
    normalized: bool,
    /// The elements; `None` means that all are zero.
    dense: Option<Dense<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// The elements in a buffer view.
struct Dense<'a> {
    bytes: Cow<'a, [u8]>,
    /// Bytes from an element to the next.
    stride: usize,
}

/// Elements that replace others.
struct Sparse<'a> {
    /// The indices of the replaced elements, ascending.
    indices: Vec<u32>,
    values: &'a [u8],
}

impl<'a> Accessor<'a> {
    /// Opens an accessor. `user` names its use in errors. Sparse indices are checked one by one, which is work.
    pub(super) fn open(
        document: &'a Document<'_>,
        index: usize,
        user: &str,
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let source = item(&document.root.accessors, index, "accessor", user)?;
        let name = format!(
            "{} of {user}",
            label("accessor", index, source.name.as_deref())
        );
        let bad = |problem: String| LoadProblem::BadAccessor {
            accessor: name.clone(),
            problem,
        };
        let (Checked::Valid(component), Checked::Valid(shape)) =
            (source.component_type, source.type_)
        else {
            return Err(bad("its type or component type is unknown".into()));
        };
        let component = component.0;
        let size = component.size() * shape.multiplicity();
        let count = usize::try_from(source.count.0)
            .ok()
            .filter(|count| u32::try_from(*count).is_ok())
            .ok_or_else(|| {
                bad(format!(
                    "{} elements are more than can be indexed",
                    source.count.0
                ))
            })?;
        let dense = match source.buffer_view {
            // Zeros, unless an extension has them.
            None if source.sparse.is_none() && count > 0 => {
                match extensions::suspect(&document.root) {
                    None => None,
                    Some(extension) => {
                        return Err(LoadProblem::MissingData {
                            place: name,
                            problem: format!(
                                "the file uses {extension}, which may hold it, and does not list it in extensionsRequired; export the file again, with the extension required or without it"
                            ),
                        });
                    }
                }
            }
            None => None,
            Some(view) => {
                let View { bytes, stride } = document.view(&name, view.value())?;
                let stride = stride.unwrap_or(size);
                if stride < size {
                    return Err(bad(format!(
                        "its stride of {stride} bytes is less than the {size} of an element"
                    )));
                }
                let offset = source.byte_offset.unwrap_or_default().0;
                Some(Dense {
                    bytes: Cow::Borrowed(elements(bytes, offset, stride, size, count, &name)?),
                    stride,
                })
            }
        };
        let sparse = match &source.sparse {
            None => None,
            Some(sparse) => {
                let replaced = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
                let Checked::Valid(kind) = sparse.indices.component_type else {
                    return Err(bad("the type of its sparse indices is unknown".into()));
                };
                let width = kind.0.size();
                let View { bytes, .. } =
                    document.view(&name, sparse.indices.buffer_view.value())?;
                let offset = sparse.indices.byte_offset.0;
                let bytes = elements(bytes, offset, width, width, replaced, &name)?;
                budget.work(replaced as u64)?;
                budget.memory((replaced as u64).saturating_mul(size_of::<u32>() as u64))?;
                let indices: Vec<u32> = bytes.chunks_exact(width).map(unsigned).collect();
                if !indices.is_sorted_by(|a, b| a < b)
                    || indices.last().is_some_and(|last| *last as usize >= count)
                {
                    return Err(bad(format!(
                        "its sparse indices do not ascend strictly within its {count} elements"
                    )));
                }
                let View { bytes, .. } = document.view(&name, sparse.values.buffer_view.value())?;
                let offset = sparse.values.byte_offset.0;
                let values = elements(bytes, offset, size, size, replaced, &name)?;
                Some(Sparse { indices, values })
            }
        };
        Ok(Self {
            name,
            count,
            shape,
            component,
            normalized: source.normalized,
            dense,
            sparse,
        })
    }

    /// The values of an attribute that was compressed with its primitive. `source` is the accessor that stands for it.
    #[cfg(feature = "draco")]
    pub(super) fn of_values(
        values: super::draco::Values,
        document: &Document<'_>,
        source: usize,
        user: &str,
    ) -> Result<Self, LoadProblem> {
        let accessor = item(&document.root.accessors, source, "accessor", user)?;
        let name = label("accessor", source, accessor.name.as_deref());
        Ok(Self {
            name: format!("{name} of {user}"),
            count: values.count,
            shape: values.shape,
            component: values.component,
            normalized: accessor.normalized,
            dense: Some(Dense {
                stride: values.component.size() * values.shape.multiplicity(),
                bytes: Cow::Owned(values.bytes),
            }),
            sparse: None,
        })
    }

    /// Refuses the accessor unless it fits its use.
    pub(super) fn expect(&self, fits: bool, what: &str) -> Result<(), LoadProblem> {
        if fits {
            return Ok(());
        }
        Err(self.bad(format!(
            "{:?} of {:?} cannot be {what}",
            self.shape, self.component
        )))
    }

    /// An error about this accessor.
    pub(super) fn bad(&self, problem: String) -> LoadProblem {
        LoadProblem::BadAccessor {
            accessor: self.name.clone(),
            problem,
        }
    }

    /// The first `N` components of an element as numbers; 0 for missing components. Normalized integers are mapped to
    /// 0..1 or -1..1.
    pub(super) fn numbers<const N: usize>(&self, element: usize) -> [f32; N] {
        let mut numbers = [0.0; N];
        if let Some(bytes) = self.element(element) {
            let components = bytes.chunks_exact(self.component.size());
            for (number, bytes) in numbers.iter_mut().zip(components) {
                *number = self.decode(bytes);
            }
        }
        numbers
    }

    /// As [`numbers`](Self::numbers), with an error for numbers that are not finite.
    pub(super) fn finite<const N: usize>(&self, element: usize) -> Result<[f32; N], LoadProblem> {
        let numbers = self.numbers(element);
        if numbers.iter().all(|n| n.is_finite()) {
            return Ok(numbers);
        }
        Err(self.bad(format!("element {element} is not finite ({numbers:?})")))
    }

    /// As [`numbers`](Self::numbers), with the number 0 for those that are not finite, which are counted.
    pub(super) fn or_zero<const N: usize>(&self, element: usize, lost: &mut u64) -> [f32; N] {
        let numbers = self.numbers(element);
        if numbers.iter().all(|number| number.is_finite()) {
            return numbers;
        }
        *lost += 1;
        numbers.map(|number| if number.is_finite() { number } else { 0.0 })
    }

    /// The first `N` components of an element as unsigned integers.
    pub(super) fn integers<const N: usize>(&self, element: usize) -> [u32; N] {
        let mut integers = [0; N];
        if let Some(bytes) = self.element(element) {
            let components = bytes.chunks_exact(self.component.size());
            for (integer, bytes) in integers.iter_mut().zip(components) {
                *integer = unsigned(bytes);
            }
        }
        integers
    }

    fn element(&self, element: usize) -> Option<&[u8]> {
        let size = self.component.size() * self.shape.multiplicity();
        if let Some(sparse) = &self.sparse
            && let Ok(at) = sparse.indices.binary_search(&u32::try_from(element).ok()?)
        {
            return sparse.values.get(at * size..)?.get(..size);
        }
        let Dense { bytes, stride } = self.dense.as_ref()?;
        bytes.get(element.checked_mul(*stride)?..)?.get(..size)
    }

    fn decode(&self, bytes: &[u8]) -> f32 {
        match (self.component, bytes) {
            (ComponentType::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
            (ComponentType::I8, &[a]) if self.normalized => (f32::from(a as i8) / 127.0).max(-1.0),
            (ComponentType::I8, &[a]) => f32::from(a as i8),
            (ComponentType::U8, &[a]) if self.normalized => f32::from(a) / 255.0,
            (ComponentType::I16, &[a, b]) if self.normalized => {
                (f32::from(i16::from_le_bytes([a, b])) / 32767.0).max(-1.0)
            }
            (ComponentType::I16, &[a, b]) => f32::from(i16::from_le_bytes([a, b])),
            (ComponentType::U16, &[a, b]) if self.normalized => {
                f32::from(u16::from_le_bytes([a, b])) / 65535.0
            }
            _ => unsigned(bytes) as f32,
        }
    }
}

/// The bytes from the first of `count` elements, if the last one is within them.
fn elements<'a>(
    bytes: &'a [u8],
    offset: u64,
    stride: usize,
    size: usize,
    count: usize,
    name: &str,
) -> Result<&'a [u8], LoadProblem> {
    let length = match (count as u64).checked_sub(1) {
        None => 0,
        Some(steps) => steps
            .saturating_mul(stride as u64)
            .saturating_add(size as u64),
    };
    let needed = offset.saturating_add(length);
    if needed > bytes.len() as u64 {
        return Err(LoadProblem::Truncated {
            what: name.to_owned(),
            needed,
            available: bytes.len() as u64,
        });
    }
    let within = usize::try_from(offset)
        .ok()
        .zip(usize::try_from(needed).ok());
    Ok(within
        .and_then(|(from, to)| bytes.get(from..to))
        .unwrap_or_default())
}

fn unsigned(bytes: &[u8]) -> u32 {
    match *bytes {
        [a] => u32::from(a),
        [a, b] => u32::from(u16::from_le_bytes([a, b])),
        [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
        _ => 0,
    }
}
