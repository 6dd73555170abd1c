//! The tree of city objects: which object is a child of which.

use super::document::CityObject;
use super::error::syntax_error;
use crate::error::{LoadProblem, shorten};
use std::borrow::Cow;
use std::collections::HashMap;

/// The trees of one document's objects.
pub(super) struct Tree {
    /// The parent of each object.
    pub(super) parents: Vec<Option<usize>>,
    /// Every object that becomes an entity, parents first, one tree after another.
    pub(super) order: Vec<usize>,
}

/// The type of groups. A group only lists other objects.
const GROUP: &str = "CityObjectGroup";

impl Tree {
    /// An object is a child of the first of its parents that exists, or else of the first object that lists it as a
    /// child.
    ///
    /// # Errors
    /// An id that occurs twice; an object that is its own ancestor.
    pub(super) fn new(
        objects: &[(Cow<'_, str>, CityObject<'_>)],
        line: usize,
    ) -> Result<Self, LoadProblem> {
        let mut known: HashMap<&str, usize> = HashMap::with_capacity(objects.len());
        for (i, (id, _)) in objects.iter().enumerate() {
            if known.insert(id, i).is_some() {
                let problem = format!("two objects have the id \"{}\"", shorten(id));
                return Err(syntax_error(format!("line {line}"), problem));
            }
        }
        let is_group = |i: usize| (objects.get(i)).is_some_and(|(_, object)| object.kind == GROUP);
        let found = |id: &Cow<'_, str>| known.get(&**id).copied().filter(|i| !is_group(*i));
        let mut parents: Vec<Option<usize>> = (objects.iter())
            .map(|(_, object)| object.parents.iter().find_map(found))
            .collect();
        for (i, (_, object)) in objects.iter().enumerate().filter(|(i, _)| !is_group(*i)) {
            for child in object.children.iter().filter_map(found) {
                if let Some(parent) = parents.get_mut(child) {
                    parent.get_or_insert(i);
                }
            }
        }
        let mut children = vec![Vec::new(); objects.len()];
        for (i, parent) in parents.iter().enumerate() {
            if let Some(siblings) = parent.and_then(|parent| children.get_mut(parent)) {
                siblings.push(i);
            }
        }
        let mut order = Vec::with_capacity(objects.len());
        let mut is_reached: Vec<bool> = (0..objects.len()).map(is_group).collect();
        let is_root = |i: &usize| parents.get(*i) == Some(&None) && !is_group(*i);
        for root in (0..objects.len()).filter(is_root) {
            let mut next = order.len();
            order.push(root);
            while let Some(object) = order.get(next).copied() {
                next += 1;
                if let Some(is_reached) = is_reached.get_mut(object) {
                    *is_reached = true;
                }
                order.extend(children.get(object).into_iter().flatten());
            }
        }
        let lost = is_reached.iter().position(|is_reached| !is_reached);
        if let Some((id, _)) = lost.and_then(|lost| objects.get(lost)) {
            return Err(LoadProblem::NodeCycle {
                node: format!("line {line}: object \"{}\"", shorten(id)),
            });
        }
        Ok(Self { parents, order })
    }

    /// The trees, each as a range of `order`.
    pub(super) fn trees(&self) -> impl Iterator<Item = &[usize]> {
        self.order
            .chunk_by(|_, next| self.parents.get(*next) != Some(&None))
    }
}
