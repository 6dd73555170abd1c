//! The page's side: runs, and writes the report into the document.

use antumbra_web::Extent;
use web_sys::Document;

/// What the page's `body` says of how far it is: `data-state`.
const STATE: &str = "data-state";

/// Runs, and writes the report into the element `report`. The state of `body` is `done` then, or `failed`.
pub(crate) fn start() {
    console_error_panic_hook::set_once();
    wasm_bindgen_futures::spawn_local(async {
        let Some(document) = web_sys::window().and_then(|window| window.document()) else {
            return;
        };
        let progress = |what: &str| write(&document, "progress", what);
        let outcome = antumbra_web::run("", Extent::All, &progress).await;
        let outcome = outcome
            .map_err(|error| error.to_string())
            .and_then(|report| {
                serde_json::to_string_pretty(&report).map_err(|error| error.to_string())
            });
        let (text, state) = match outcome {
            Ok(json) => (json, "done"),
            Err(error) => (error, "failed"),
        };
        write(&document, "report", &text);
        if let Some(body) = document.body() {
            // The one thing that can fail is the attribute's name.
            let _ = body.set_attribute(STATE, state);
        }
    });
}

fn write(document: &Document, id: &str, text: &str) {
    if let Some(element) = document.get_element_by_id(id) {
        element.set_text_content(Some(text));
    }
}
