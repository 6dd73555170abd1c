//! The host values of a plan. During a frame each is in a `RefCell`, so that a body can borrow several at once. Between frames they are
//! outside of it, so that the plan can return plain references.

use std::any::Any;
use std::cell::{Ref, RefCell, RefMut};

use crate::resource::HostType;

type Value = Box<dyn Any + Send>;

/// The host values, by slot.
#[derive(Default)]
pub(crate) struct Store {
    types: Vec<HostType>,
    cells: Vec<RefCell<Option<Value>>>,
    at_rest: Vec<Option<Value>>,
}

/// Why a value cannot be borrowed.
pub(crate) enum StoreError {
    /// It is borrowed in a way that excludes this borrow.
    Borrowed,
    /// It holds nothing.
    Empty,
}

impl Store {
    /// Adds a value and returns its slot.
    pub fn add(&mut self, host: HostType) -> u32 {
        self.types.push(host);
        self.cells.push(RefCell::new(None));
        self.at_rest.push(Some((host.make)()));
        (self.types.len() - 1) as u32
    }

    /// Moves the values into their cells.
    pub fn begin_frame(&mut self) {
        for (cell, rest) in self.cells.iter_mut().zip(&mut self.at_rest) {
            *cell.get_mut() = rest.take();
        }
    }

    /// Moves the values back.
    pub fn end_frame(&mut self) {
        for (cell, rest) in self.cells.iter_mut().zip(&mut self.at_rest) {
            *rest = cell.get_mut().take();
        }
    }

    pub fn get<T: 'static>(&self, slot: u32) -> Result<Ref<'_, T>, StoreError> {
        let cell = self.cells.get(slot as usize).ok_or(StoreError::Empty)?;
        let value = cell.try_borrow().map_err(|_| StoreError::Borrowed)?;
        Ref::filter_map(value, |value| {
            value.as_ref()?.downcast_ref::<Option<T>>()?.as_ref()
        })
        .map_err(|_| StoreError::Empty)
    }

    pub fn get_mut<T: 'static>(&self, slot: u32) -> Result<RefMut<'_, T>, StoreError> {
        let cell = self.cells.get(slot as usize).ok_or(StoreError::Empty)?;
        let value = cell.try_borrow_mut().map_err(|_| StoreError::Borrowed)?;
        RefMut::filter_map(value, |value| {
            value.as_mut()?.downcast_mut::<Option<T>>()?.as_mut()
        })
        .map_err(|_| StoreError::Empty)
    }

    /// Between frames: sets an imported value. Returns false for an unknown slot or another type.
    pub fn set<T: 'static>(&mut self, slot: u32, value: T) -> bool {
        let place = self
            .at_rest
            .get_mut(slot as usize)
            .and_then(Option::as_mut)
            .and_then(|rest| rest.downcast_mut::<Option<T>>());
        match place {
            Some(place) => {
                *place = Some(value);
                true
            }
            None => false,
        }
    }

    /// Between frames: whether an imported value is set.
    pub fn is_set(&self, slot: u32) -> bool {
        let host = self.types.get(slot as usize);
        let rest = self.at_rest.get(slot as usize).and_then(Option::as_ref);
        matches!((host, rest), (Some(host), Some(rest)) if (host.is_set)(rest.as_ref()))
    }

    /// Between frames: borrows a value.
    pub fn rest<T: 'static>(&self, slot: u32) -> Option<&T> {
        self.at_rest
            .get(slot as usize)?
            .as_ref()?
            .downcast_ref::<Option<T>>()?
            .as_ref()
    }

    /// Between frames: drops an imported value. The slot stays.
    pub fn empty(&mut self, slot: u32) {
        if let (Some(host), Some(Some(rest))) = (
            self.types.get(slot as usize),
            self.at_rest.get_mut(slot as usize),
        ) {
            (host.empty)(rest.as_mut());
        }
    }

    /// Between frames: exchanges a value with one of another store, where both are of one type.
    pub fn swap(&mut self, slot: u32, other: &mut Self, theirs: u32) {
        let (Some(Some(ours)), Some(Some(theirs))) = (
            self.at_rest.get_mut(slot as usize),
            other.at_rest.get_mut(theirs as usize),
        ) else {
            return;
        };
        if ours.as_ref().type_id() == theirs.as_ref().type_id() {
            std::mem::swap(ours, theirs);
        }
    }

    /// Between frames: sets a value to its initial one.
    pub fn reset(&mut self, slot: u32) {
        if let (Some(host), Some(rest)) = (
            self.types.get(slot as usize),
            self.at_rest.get_mut(slot as usize),
        ) {
            *rest = Some((host.make)());
        }
    }
}
