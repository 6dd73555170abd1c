//! The page, and without a browser the program: `antumbra-web [--shaders] [ADAPTER]` prints the report as JSON, with `--shaders` that of shaders and the self-test alone.

#[cfg(target_family = "wasm")]
mod page;

/// Starts the page.
#[cfg(target_family = "wasm")]
fn main() {
    page::start();
}

/// Prints the report.
#[cfg(not(target_family = "wasm"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let given = arguments.len();
    arguments.retain(|argument| argument != "--shaders");
    let extent = match given > arguments.len() {
        true => antumbra_web::Extent::Shaders,
        false => antumbra_web::Extent::All,
    };
    let wanted = arguments.first().cloned().unwrap_or_default();
    let progress = |what: &str| eprintln!("antumbra-web: {what}");
    let report = pollster::block_on(antumbra_web::run(&wanted, extent, &progress))?;
    println!("{}", serde_json::to_string_pretty(&report)?);
    Ok(())
}
