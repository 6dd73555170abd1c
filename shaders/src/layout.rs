//! Checks at compile time that a Rust struct and a WGSL struct have the same layout.

use std::{borrow::Cow, fmt};

use crate::{Job, StructLayout, job::LayoutKind};

/// A field of a Rust struct, for [`assert_layout!`](crate::assert_layout).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RustField {
    /// Its name in Rust.
    pub name: &'static str,
    /// The name of its WGSL member.
    pub wgsl: &'static str,
    /// Offset from the struct's start in bytes.
    pub offset: usize,
    /// Size in bytes.
    pub size: usize,
}

/// The first difference between two layouts. Displays as one sentence.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct LayoutMismatch {
    text: [u8; LayoutMismatch::CAPACITY],
    len: usize,
}

/// Compares a Rust struct with a WGSL struct: the size, and each field's offset and size. Every WGSL member must be listed, except for those
/// whose name begins with `_` or `padding`. For a struct that ends in a runtime-sized array, the part before the array is compared.
///
/// # Errors
/// The first [`LayoutMismatch`]; it names the field.
#[allow(
    clippy::result_large_err,
    reason = "a constant can hold its message only inline, and this runs once for each struct"
)]
pub const fn check_layout(
    rust_name: &'static str,
    rust_size: usize,
    fields: &[RustField],
    wgsl: &StructLayout,
) -> Result<(), LayoutMismatch> {
    let wgsl_name = text_of(&wgsl.name);
    let wgsl_fields = match &wgsl.fields {
        Cow::Borrowed(fields) => *fields,
        Cow::Owned(fields) => fields.as_slice(),
    };
    let mut i = 0;
    while i < fields.len() {
        let field = &fields[i];
        let Some(at) = position(wgsl_fields, field.wgsl) else {
            let text = LayoutMismatch::new().quoted(rust_name, field.name);
            return Err(text
                .push(" stands for ")
                .quoted(wgsl_name, field.wgsl)
                .push(", which does not exist in WGSL; correct the name"));
        };
        let other = &wgsl_fields[at];
        if field.offset != other.offset as usize {
            let text = LayoutMismatch::new().quoted(rust_name, field.name);
            let text = text.push(" is at byte ").number(field.offset);
            let text = text.push(", but ").quoted(wgsl_name, field.wgsl);
            let text = text.push(" is at byte ").number(other.offset as usize);
            return Err(text.push(" in WGSL; pad or reorder the fields"));
        }
        if field.size != other.size as usize {
            let text = LayoutMismatch::new().quoted(rust_name, field.name);
            let text = text.push(" has ").number(field.size);
            let text = text.push(" bytes, but ").quoted(wgsl_name, field.wgsl);
            let text = text.push(" has ").number(other.size as usize);
            return Err(text.push(" in WGSL; use a type of that size"));
        }
        i += 1;
    }
    let mut i = 0;
    while i < wgsl_fields.len() {
        let name = text_of(&wgsl_fields[i].name);
        if !is_padding(name) && !names(fields, name) {
            let text = LayoutMismatch::new().quoted(wgsl_name, name);
            let text = text.push(" has no field in `").push(rust_name);
            return Err(text.push("`; add it to the list, or call it padding"));
        }
        i += 1;
    }
    if rust_size != wgsl.size as usize {
        let text = LayoutMismatch::new().push("`").push(rust_name);
        let text = text.push("` has ").number(rust_size);
        let text = text.push(" bytes, but `").push(wgsl_name).push("` has ");
        let text = text.number(wgsl.size as usize).push(match wgsl.kind {
            LayoutKind::Memory => " in WGSL; mind the padding at the end",
            LayoutKind::Vertex => " when packed; mind the padding at the end",
        });
        return Err(text);
    }
    Ok(())
}

impl LayoutMismatch {
    const CAPACITY: usize = 320;

    const fn new() -> Self {
        Self {
            text: [0; Self::CAPACITY],
            len: 0,
        }
    }

    /// The sentence. Very long names are cut.
    pub const fn as_str(&self) -> &str {
        let (text, _) = self.text.split_at(self.len);
        match std::str::from_utf8(text) {
            Ok(text) => text,
            Err(_) => "the layouts differ in a field with a very long name",
        }
    }

    const fn push(mut self, text: &str) -> Self {
        let bytes = text.as_bytes();
        let mut i = 0;
        while i < bytes.len() && self.len < Self::CAPACITY {
            self.text[self.len] = bytes[i];
            self.len += 1;
            i += 1;
        }
        self
    }

    const fn quoted(self, owner: &str, field: &str) -> Self {
        self.push("`").push(owner).push(".").push(field).push("`")
    }

    const fn number(self, number: usize) -> Self {
        let rest = if number >= 10 {
            self.number(number / 10)
        } else {
            self
        };
        let digit = [b'0' + (number % 10) as u8];
        match std::str::from_utf8(&digit) {
            Ok(digit) => rest.push(digit),
            Err(_) => rest,
        }
    }
}

impl fmt::Display for LayoutMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl fmt::Debug for LayoutMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "LayoutMismatch({:?})", self.as_str())
    }
}

impl std::error::Error for LayoutMismatch {}

/// Fails the build with the mismatch's sentence. [`assert_layout!`](crate::assert_layout) expands to this.
#[doc(hidden)]
#[track_caller]
#[allow(clippy::panic, reason = "in a constant, a panic is how a build fails")]
pub const fn demand_layout(
    rust_name: &'static str,
    rust_size: usize,
    fields: &[RustField],
    wgsl: &StructLayout,
) {
    if let Err(mismatch) = check_layout(rust_name, rust_size, fields, wgsl) {
        panic!("{}", mismatch.as_str());
    }
}

/// The layout of a built-in job's struct, for [`assert_layout!`](crate::assert_layout).
#[doc(hidden)]
#[track_caller]
#[allow(clippy::panic, reason = "in a constant, a panic is how a build fails")]
pub const fn built_in_layout(
    jobs: &'static [&'static Job],
    job: &str,
    name: &str,
) -> &'static StructLayout {
    let mut i = 0;
    while i < jobs.len() {
        if same(text_of(&jobs[i].name), job) {
            let structs = match &jobs[i].structs {
                Cow::Borrowed(structs) => *structs,
                Cow::Owned(structs) => structs.as_slice(),
            };
            let mut at = 0;
            while at < structs.len() {
                if same(text_of(&structs[at].name), name) {
                    return &structs[at];
                }
                at += 1;
            }
            panic!("assert_layout!: the job has no uniform, storage or vertex struct of that name");
        }
        i += 1;
    }
    panic!("assert_layout!: there is no built-in job of that name");
}

/// The size of the field to which a projection refers.
#[doc(hidden)]
pub const fn field_size<T, F>(_project: fn(&T) -> &F) -> usize {
    size_of::<F>()
}

const fn position(fields: &[crate::FieldLayout], name: &str) -> Option<usize> {
    let mut i = 0;
    while i < fields.len() {
        if same(text_of(&fields[i].name), name) {
            return Some(i);
        }
        i += 1;
    }
    None
}

const fn names(fields: &[RustField], name: &str) -> bool {
    let mut i = 0;
    while i < fields.len() {
        if same(fields[i].wgsl, name) {
            return true;
        }
        i += 1;
    }
    false
}

const fn is_padding(name: &str) -> bool {
    starts_with(name, "_") || starts_with(name, "padding")
}

#[allow(
    clippy::ptr_arg,
    reason = "in a constant, a Cow does not deref by itself"
)]
const fn text_of<'a>(text: &'a Cow<'static, str>) -> &'a str {
    match text {
        Cow::Borrowed(text) => text,
        Cow::Owned(text) => text.as_str(),
    }
}

const fn same(a: &str, b: &str) -> bool {
    a.len() == b.len() && starts_with(a, b)
}

const fn starts_with(text: &str, start: &str) -> bool {
    let (text, start) = (text.as_bytes(), start.as_bytes());
    if text.len() < start.len() {
        return false;
    }
    let mut i = 0;
    while i < start.len() {
        if text[i] != start[i] {
            return false;
        }
        i += 1;
    }
    true
}

/// Checks at compile time that a `#[repr(C)]` struct has the size, the field offsets and the field sizes of a WGSL struct.
///
/// The struct is given by its built-in job and its WGSL name, or by any constant `&'static StructLayout`. Fields with the same name are listed
/// once, others as `rust_name: wgsl_name`. Padding need not be listed: WGSL members whose name begins with `_` or `padding` may be left out,
/// and any Rust field may.
///
/// ```
/// use std::borrow::Cow;
/// use antumbra_shaders::{FieldLayout, LayoutKind, StructLayout, assert_layout};
/// static SETTINGS: StructLayout = StructLayout {
///     name: Cow::Borrowed("Settings"), kind: LayoutKind::Memory, size: 8, align: 4, tail: None,
///     fields: Cow::Borrowed(&[
///         FieldLayout { name: Cow::Borrowed("threshold"), offset: 0, size: 4 },
///         FieldLayout { name: Cow::Borrowed("count"), offset: 4, size: 4 },
///     ]),
/// };
/// #[repr(C)]
/// struct Settings { threshold: u32, batches: u32 }
/// assert_layout!(Settings, &SETTINGS, { threshold, batches: count });
/// ```
///
/// A wrong type fails the build: "`Settings.batches` has 8 bytes, but `Settings.count` has 4 in WGSL".
///
/// ```compile_fail,E0080
/// use std::borrow::Cow;
/// use antumbra_shaders::{FieldLayout, LayoutKind, StructLayout, assert_layout};
/// static SETTINGS: StructLayout = StructLayout {
///     name: Cow::Borrowed("Settings"), kind: LayoutKind::Memory, size: 8, align: 4, tail: None,
///     fields: Cow::Borrowed(&[
///         FieldLayout { name: Cow::Borrowed("threshold"), offset: 0, size: 4 },
///         FieldLayout { name: Cow::Borrowed("count"), offset: 4, size: 4 },
///     ]),
/// };
/// #[repr(C)]
/// struct Settings { threshold: u32, batches: u64 }
/// assert_layout!(Settings, &SETTINGS, { threshold, batches: count });
/// ```
#[macro_export]
macro_rules! assert_layout {
    ($rust:ty, $job:literal, $wgsl:literal, { $($field:ident $(: $member:ident)?),* $(,)? }) => {
        $crate::assert_layout!(
            $rust,
            $crate::__built_in_layout($crate::jobs::ALL, $job, $wgsl),
            { $($field $(: $member)?),* }
        );
    };
    ($rust:ty, $layout:expr, { $($field:ident $(: $member:ident)?),* $(,)? }) => {
        const _: () = $crate::__demand_layout(
            stringify!($rust),
            ::core::mem::size_of::<$rust>(),
            &$crate::layout_fields!($rust, { $($field $(: $member)?),* }),
            $layout,
        );
    };
}

/// The offsets and sizes of a Rust struct's fields as `[RustField; N]`, for [`check_layout`] with a [`StructLayout`] that is known only at run
/// time. Fields are listed as in [`assert_layout!`](crate::assert_layout).
#[macro_export]
macro_rules! layout_fields {
    ($rust:ty, { $($field:ident $(: $member:ident)?),* $(,)? }) => {
        [$($crate::RustField {
            name: stringify!($field),
            wgsl: $crate::layout_fields!(@name $field $($member)?),
            offset: ::core::mem::offset_of!($rust, $field),
            size: $crate::__field_size(|value: &$rust| &value.$field),
        }),*]
    };
    (@name $field:ident) => { stringify!($field) };
    (@name $field:ident $member:ident) => { stringify!($member) };
}
