//! No compiler can reorder the subtraction of two halves of a coordinate, in any language that a job is written in.
//!
//! `(a - b) + (c - d)` is what fast maths reassociates. So what is subtracted goes through an exclusive or of integers before it is added.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_shaders::{Job, jobs};
use naga::back::pipeline_constants::process_overrides;
use naga::back::{hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{BinaryOperator, Expression, Function, Handle, Module};

/// What subtracts the eye from a place in the world.
const FUNCTION: &str = "eye_relative";

/// A job's module, its overrides at their defaults.
fn parsed(source: &str) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(source).unwrap();
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap();
    let made = process_overrides(&module, &info, None, &Default::default()).unwrap();
    (made.0.into_owned(), made.1.into_owned())
}

/// The jobs whose shaders subtract the eye.
fn jobs_that_subtract() -> Vec<&'static Job> {
    let of = |job: &&&Job| job.source.contains("fn eye_relative(");
    let found: Vec<_> = jobs::ALL.iter().filter(of).copied().collect();
    assert!(found.len() > 10, "{} jobs", found.len());
    found
}

/// Whether floats are added or subtracted somewhere below an expression before integers hide it, with what is added or subtracted in turn: what a compiler with fast maths may reorder.
fn reorders(function: &Function, at: Handle<Expression>) -> bool {
    let sum = |at: Handle<Expression>| {
        matches!(
            function.expressions[at],
            Expression::Binary {
                op: BinaryOperator::Add | BinaryOperator::Subtract,
                ..
            }
        )
    };
    match function.expressions[at] {
        Expression::Binary {
            op: BinaryOperator::Add | BinaryOperator::Subtract,
            left,
            right,
        } => sum(left) || sum(right) || reorders(function, left) || reorders(function, right),
        Expression::Binary {
            op: BinaryOperator::ExclusiveOr,
            ..
        } => false,
        Expression::As { expr, .. } | Expression::Unary { expr, .. } => {
            sum(expr) || reorders(function, expr)
        }
        _ => false,
    }
}

/// Whether a function gives the sum of differences that a compiler may reorder, or no sum at all.
fn may_be_reordered(source: &str) -> bool {
    let (module, _) = parsed(source);
    let function = module
        .functions
        .iter()
        .find_map(|(_, function)| (function.name.as_deref() == Some(FUNCTION)).then_some(function))
        .expect("the function is there");
    let mut results = function
        .body
        .iter()
        .filter_map(|statement| match statement {
            naga::Statement::Return { value } => *value,
            _ => None,
        });
    let result = results.next().expect("it returns something");
    assert!(results.next().is_none(), "it returns once");
    reorders(function, result)
}

#[test]
fn differences_are_hidden_before_they_are_added() {
    for job in jobs_that_subtract() {
        assert!(!may_be_reordered(&job.source), "{}", job.name);
        let others = job.source.matches("view.eye_").count();
        assert_eq!(others, 2, "{}: the eye is subtracted elsewhere", job.name);
    }
}

#[test]
fn a_plain_sum_of_differences_is_found() {
    let plain = "
        struct View { eye_high: vec3<f32>, eye_low: vec3<f32> }
        @group(0) @binding(0) var<uniform> view: View;
        fn eye_relative(high: vec3<f32>, low: vec3<f32>) -> vec3<f32> {
            return (high - view.eye_high) + (low - view.eye_low);
        }";
    assert!(may_be_reordered(plain));
    let through_casts = plain.replace(
        "(high - view.eye_high)",
        "bitcast<vec3<f32>>(bitcast<vec3<u32>>(high - view.eye_high))",
    );
    assert!(may_be_reordered(&through_casts));
}

/// The lines of a function of this name, up to the line of its last brace.
fn body<'a>(text: &'a str, name: &str) -> &'a str {
    let start = text.find(name).expect("the function is written");
    let end = text[start..].find("\n}").expect("it ends");
    &text[start..start + end]
}

/// Metal's shading language has each of two differences as integers, and an exclusive or of each.
#[test]
fn metal_gets_integers() {
    for job in jobs_that_subtract() {
        let (module, info) = parsed(&job.source);
        let options = msl::Options {
            fake_missing_bindings: true,
            lang_version: (2, 1),
            ..Default::default()
        };
        let (text, _) = msl::write_string(&module, &info, &options, &Default::default()).unwrap();
        let text = body(&text, FUNCTION);
        assert_eq!(
            text.matches("as_type<metal::uint3>(").count(),
            2,
            "{}: {text}",
            job.name
        );
        assert_eq!(
            text.matches("as_type<metal::float3>(").count(),
            2,
            "{}: {text}",
            job.name
        );
        assert_eq!(text.matches(" ^ ").count(), 2, "{}: {text}", job.name);
    }
}

#[test]
fn hlsl_gets_integers() {
    for job in jobs_that_subtract() {
        let (module, info) = parsed(&job.source);
        let options = hlsl::Options {
            fake_missing_bindings: true,
            ..Default::default()
        };
        let mut text = String::new();
        hlsl::Writer::new(&mut text, &options, &Default::default())
            .write(&module, &info, None)
            .unwrap();
        let text = body(&text, FUNCTION);
        assert_eq!(text.matches("(asuint((").count(), 2, "{}: {text}", job.name);
        assert!(text.contains("return (asfloat("), "{}: {text}", job.name);
        assert_eq!(text.matches(" ^ ").count(), 2, "{}: {text}", job.name);
    }
}

/// SPIR-V has at least the two exclusive ors, and nowhere says that maths may be fast (`FPFastMathMode` is decoration 40, and its default forbids reordering in shaders).
#[test]
fn spirv_gets_integers_and_no_fast_maths() {
    const BITWISE_XOR: u32 = 198;
    const DECORATE: u32 = 71;
    const FAST_MATHS: u32 = 40;
    for job in jobs_that_subtract() {
        let (module, info) = parsed(&job.source);
        let words = spv::write_vec(&module, &info, &spv::Options::default(), None).unwrap();
        let mut at = 5;
        let mut hidden = 0;
        while let Some(&word) = words.get(at) {
            match word & 0xffff {
                BITWISE_XOR => hidden += 1,
                DECORATE => assert_ne!(words[at + 2], FAST_MATHS, "{}", job.name),
                _ => {}
            }
            at += (word >> 16).max(1) as usize;
        }
        assert!(hidden >= 2, "{}", job.name);
    }
}

/// The barrier changes no bit: what is subtracted is what comes out, for numbers of every kind.
#[test]
fn the_sign_of_a_width_is_zero() {
    for width in [1u32, 2, 640, 8192, 1 << 24] {
        assert_eq!((width as f32).to_bits() >> 31, 0);
    }
}
