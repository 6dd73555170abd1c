//! Every built-in shader as a module.

use antumbra_cull::Gpu;
use antumbra_shaders::{Job, jobs};

use crate::report::Case;
use crate::scope::scoped;

/// Makes a module of each built-in shader.
pub(crate) async fn cases(gpu: &Gpu) -> Vec<Case> {
    let mut cases = Vec::new();
    for job in jobs::ALL {
        cases.push(Case {
            name: job.name.to_string(),
            outcome: outcome(gpu, job).await,
        });
    }
    cases
}

async fn outcome(gpu: &Gpu, job: &Job) -> String {
    let lacking = job.features - gpu.device.features();
    if !lacking.is_empty() {
        let names = lacking.iter_names().map(|(name, _)| name);
        return format!("needs {}", names.collect::<Vec<_>>().join(" and "));
    }
    let (module, refused) =
        scoped(&gpu.device, || antumbra_shaders::module(&gpu.device, job)).await;
    let said = module.get_compilation_info().await.messages;
    let wrong = said
        .iter()
        .filter(|message| message.message_type == wgpu::CompilationMessageType::Error)
        .map(|message| {
            let line = message.location.map_or(0, |location| location.line_number);
            format!("line {line}: {}", message.message)
        });
    let wrong: Vec<String> = refused.into_iter().chain(wrong).collect();
    match wrong.is_empty() {
        true => "accepted".to_owned(),
        false => format!("refused: {}", wrong.join("; ")),
    }
}
