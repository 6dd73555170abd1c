//! The page, and without a browser the program: `antumbra-web [ADAPTER]` prints the report as JSON.

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
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let progress = |what: &str| eprintln!("antumbra-web: {what}");
    let report = pollster::block_on(antumbra_web::run(&wanted, &progress))?;
    println!("{}", serde_json::to_string_pretty(&report)?);
    Ok(())
}
