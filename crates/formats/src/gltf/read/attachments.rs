//! Reading of attachments.

use super::document::Document;
use super::nodes::Entities;
use crate::error::LoadProblem;
use crate::gltf::attachment::Attachment;
use gltf::json::Value;

/// An attachment, or the reason why it is invalid.
type AttachmentResult = Result<Attachment, LoadProblem>;

/// Reads the attachment with this name; `None` if the file has none.
pub(super) fn read(
    document: &Document<'_>,
    name: &str,
    entities: &Entities,
) -> Option<AttachmentResult> {
    let all = document.root.extensions.as_ref()?;
    let found = all.others.get(name)?;
    Some(attachment(document, name, found, entities))
}

fn attachment(
    document: &Document<'_>,
    name: &str,
    found: &Value,
    entities: &Entities,
) -> AttachmentResult {
    let bad = |problem: String| LoadProblem::BadAttachment {
        attachment: name.to_owned(),
        problem,
    };
    let object = found.as_object();
    let mut properties = object
        .cloned()
        .ok_or_else(|| bad("it is no JSON object".to_owned()))?;
    let index = |value: &Value| value.as_u64().and_then(|index| usize::try_from(index).ok());
    let nodes = match properties.remove(Attachment::NODES) {
        None => Vec::new(),
        Some(Value::Array(nodes)) => nodes,
        Some(_) => return Err(bad("its nodes are no array".to_owned())),
    };
    let entity = |(at, node): (usize, &Value)| {
        let entity = index(node).and_then(|node| entities.get(&node).copied());
        entity.ok_or_else(|| bad(format!("entry {at} of its nodes is no node of the scene")))
    };
    let bytes = match properties.remove(Attachment::BUFFER_VIEW) {
        None => Vec::new(),
        Some(view) => {
            let view = index(&view).ok_or_else(|| bad("its bufferView is no index".to_owned()))?;
            let view = document.view(&format!("the extension {name}"), view)?;
            view.bytes.to_vec()
        }
    };
    Ok(Attachment {
        name: name.to_owned(),
        entities: nodes
            .iter()
            .enumerate()
            .map(entity)
            .collect::<Result<_, _>>()?,
        properties,
        bytes,
    })
}
