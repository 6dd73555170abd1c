//! The vertex attributes of an entry point.

use std::borrow::Cow;

use naga::{Binding, Scalar, ScalarKind, TypeInner, VectorSize};
use wgpu::VertexFormat;

use crate::job::VertexInput;

/// The `@location` arguments of a function, with those in struct arguments, by location.
pub(super) fn inputs(module: &naga::Module, function: &naga::Function) -> Vec<VertexInput> {
    let mut found = Vec::new();
    for argument in &function.arguments {
        match (&argument.binding, &module.types[argument.ty].inner) {
            (Some(binding), _) => {
                found.extend(input(module, binding, &argument.name, argument.ty));
            }
            (None, TypeInner::Struct { members, .. }) => found.extend(of_members(module, members)),
            (None, _) => {}
        }
    }
    found.sort_by_key(|input| input.location);
    found
}

/// The `@location` members of an input struct, in order.
pub(super) fn of_members(
    module: &naga::Module,
    members: &[naga::StructMember],
) -> Vec<VertexInput> {
    members
        .iter()
        .filter_map(|member| input(module, member.binding.as_ref()?, &member.name, member.ty))
        .collect()
}

fn input(
    module: &naga::Module,
    binding: &Binding,
    name: &Option<String>,
    ty: naga::Handle<naga::Type>,
) -> Option<VertexInput> {
    let Binding::Location { location, .. } = *binding else {
        return None;
    };
    Some(VertexInput {
        location,
        name: Cow::Owned(name.clone().unwrap_or_default()),
        format: format(&module.types[ty].inner)?,
    })
}

fn format(inner: &TypeInner) -> Option<VertexFormat> {
    let (Scalar { kind, width }, size) = match *inner {
        TypeInner::Scalar(scalar) => (scalar, 1),
        TypeInner::Vector { size, scalar } => (
            scalar,
            match size {
                VectorSize::Bi => 2,
                VectorSize::Tri => 3,
                VectorSize::Quad => 4,
            },
        ),
        _ => return None,
    };
    Some(match (kind, width, size) {
        (ScalarKind::Float, 4, 1) => VertexFormat::Float32,
        (ScalarKind::Float, 4, 2) => VertexFormat::Float32x2,
        (ScalarKind::Float, 4, 3) => VertexFormat::Float32x3,
        (ScalarKind::Float, 4, 4) => VertexFormat::Float32x4,
        (ScalarKind::Uint, 4, 1) => VertexFormat::Uint32,
        (ScalarKind::Uint, 4, 2) => VertexFormat::Uint32x2,
        (ScalarKind::Uint, 4, 3) => VertexFormat::Uint32x3,
        (ScalarKind::Uint, 4, 4) => VertexFormat::Uint32x4,
        (ScalarKind::Sint, 4, 1) => VertexFormat::Sint32,
        (ScalarKind::Sint, 4, 2) => VertexFormat::Sint32x2,
        (ScalarKind::Sint, 4, 3) => VertexFormat::Sint32x3,
        (ScalarKind::Sint, 4, 4) => VertexFormat::Sint32x4,
        (ScalarKind::Float, 2, 1) => VertexFormat::Float16,
        (ScalarKind::Float, 2, 2) => VertexFormat::Float16x2,
        // There is no format of three halves. The fourth is fetched and ignored.
        (ScalarKind::Float, 2, 3 | 4) => VertexFormat::Float16x4,
        (ScalarKind::Float, 8, 1) => VertexFormat::Float64,
        (ScalarKind::Float, 8, 2) => VertexFormat::Float64x2,
        (ScalarKind::Float, 8, 3) => VertexFormat::Float64x3,
        (ScalarKind::Float, 8, 4) => VertexFormat::Float64x4,
        _ => return None,
    })
}
