//! Derivatives, and images that are sampled at the level that derivatives give, need all four fragments of a quad. WGSL refuses them where some of the four may be missing: browsers check
//! that, and naga does not.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::HashMap;

use antumbra_shaders::jobs;
use naga::{Block, Expression, Function, Handle, Module, SampleLevel, Statement};

/// Which functions need whole quads, by themselves or by what they call.
type Needy = HashMap<Handle<Function>, bool>;

/// Where a function is looked at.
struct Walk<'a> {
    function: &'a Function,
    needy: &'a Needy,
    /// Something in it needs whole quads.
    needs: bool,
    /// Something of that is where fragments may be missing.
    fault: bool,
}

impl Walk<'_> {
    /// `apart`: whether fragments of a quad may have gone another way. Returns whether they may have after the block.
    fn block(&mut self, block: &Block, mut apart: bool) -> bool {
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for expression in range.clone() {
                        if needs_quad(&self.function.expressions[expression]) {
                            self.find(apart);
                        }
                    }
                }
                Statement::Call { function, .. } if self.needy[function] => self.find(apart),
                Statement::Block(block) => apart = self.block(block, apart),
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let within = apart || !self.is_constant(*condition);
                    self.block(accept, within);
                    self.block(reject, within);
                    apart |= within && (leaves(accept) || leaves(reject));
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        self.block(&case.body, true);
                        apart |= leaves(&case.body);
                    }
                }
                Statement::Loop {
                    body, continuing, ..
                } => {
                    self.block(body, true);
                    self.block(continuing, true);
                    apart |= leaves(body);
                }
                _ => {}
            }
        }
        apart
    }

    fn find(&mut self, apart: bool) {
        self.needs = true;
        self.fault |= apart;
    }

    /// Whether a condition is made of constants of the pipeline alone.
    fn is_constant(&self, condition: Handle<Expression>) -> bool {
        match &self.function.expressions[condition] {
            Expression::Literal(_) | Expression::Constant(_) | Expression::Override(_) => true,
            Expression::Unary { expr, .. } => self.is_constant(*expr),
            Expression::Binary { left, right, .. } => {
                self.is_constant(*left) && self.is_constant(*right)
            }
            _ => false,
        }
    }
}

fn needs_quad(expression: &Expression) -> bool {
    match expression {
        Expression::ImageSample { level, .. } => {
            matches!(level, SampleLevel::Auto | SampleLevel::Bias(_))
        }
        Expression::Derivative { .. } => true,
        _ => false,
    }
}

/// Whether a block may leave its function. A discarded fragment goes on as a helper.
fn leaves(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Return { .. } => true,
        Statement::Block(block) => leaves(block),
        Statement::If { accept, reject, .. } => leaves(accept) || leaves(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| leaves(&case.body)),
        Statement::Loop { body, .. } => leaves(body),
        _ => false,
    })
}

/// The functions and entry points of a module that need whole quads where they may not have them.
fn faults(module: &Module) -> Vec<String> {
    let mut needy = Needy::new();
    let mut faults = Vec::new();
    let mut look = |function: &Function, name: &str, needy: &Needy| {
        let mut walk = Walk {
            function,
            needy,
            needs: false,
            fault: false,
        };
        walk.block(&function.body, false);
        if walk.fault {
            faults.push(name.to_owned());
        }
        walk.needs
    };
    // A function stands behind those that it calls.
    for (handle, function) in module.functions.iter() {
        let name = function.name.as_deref().unwrap_or("?");
        let needs = look(function, name, &needy);
        needy.insert(handle, needs);
    }
    for entry in &module.entry_points {
        look(&entry.function, &entry.name, &needy);
    }
    faults
}

#[test]
fn images_are_sampled_where_no_fragment_is_missing() {
    for job in jobs::ALL {
        let module = naga::front::wgsl::parse_str(&job.source).unwrap();
        let faults = faults(&module);
        assert!(faults.is_empty(), "{}: {faults:?}", job.name);
    }
}

#[test]
fn what_browsers_refuse_is_found() {
    let with = |body: &str| {
        let text = format!(
            "@group(0) @binding(0) var image: texture_2d<f32>;
             @group(0) @binding(1) var how: sampler;
             override on: bool = true;
             fn picked(at: vec2<f32>) -> f32 {{ return textureSample(image, how, at).a; }}
             @fragment fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {{
                 {body}
                 return vec4<f32>(1.0);
             }}"
        );
        faults(&naga::front::wgsl::parse_str(&text).unwrap())
    };
    let refused = [
        "if at.z > 0.5 && picked(at.xy) > 0.5 { discard; }",
        "if at.z > 0.5 { let found = picked(at.xy); }",
        "if at.z > 0.5 { return vec4<f32>(0.0); } let found = dpdx(at.x);",
        "for (var i = 0; i < i32(at.x); i++) { let found = picked(at.xy); }",
    ];
    for body in refused {
        assert_eq!(with(body), ["fragment"], "{body}");
    }
    let taken = [
        "let found = picked(at.xy); if at.z > 0.5 && found > 0.5 { discard; }",
        "if !on { return vec4<f32>(0.0); } let found = picked(at.xy);",
        "if at.z > 0.5 { discard; } let found = dpdx(at.x);",
        "if at.z > 0.5 { let found = textureSampleLevel(image, how, at.xy, 0.0); }",
    ];
    for body in taken {
        assert!(with(body).is_empty(), "{body}");
    }
}
