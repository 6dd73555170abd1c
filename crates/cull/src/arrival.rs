//! A value that a callback of the device brings, as a future.

use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker};

/// Ready once [`Bringer::bring`] was called. If the bringer is dropped instead, the value is `None`.
pub(crate) struct Arrival<T>(Arc<Mutex<Inner<T>>>);

/// Brings the value of an [`Arrival`].
pub(crate) struct Bringer<T>(Arc<Mutex<Inner<T>>>);

struct Inner<T> {
    value: Option<T>,
    gone: bool,
    waker: Option<Waker>,
}

/// A future, and what a callback takes along to end it.
pub(crate) fn arrival<T>() -> (Bringer<T>, Arrival<T>) {
    let inner = Arc::new(Mutex::new(Inner {
        value: None,
        gone: false,
        waker: None,
    }));
    (Bringer(Arc::clone(&inner)), Arrival(inner))
}

impl<T> Bringer<T> {
    /// Ends the future.
    pub fn bring(self, value: T) {
        lock(&self.0).value = Some(value);
    }
}

impl<T> Drop for Bringer<T> {
    fn drop(&mut self) {
        let mut inner = lock(&self.0);
        inner.gone = true;
        let waker = inner.waker.take();
        drop(inner);
        if let Some(waker) = waker {
            waker.wake();
        }
    }
}

impl<T> Future for Arrival<T> {
    type Output = Option<T>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<T>> {
        let mut inner = lock(&self.0);
        if inner.gone {
            return Poll::Ready(inner.value.take());
        }
        inner.waker = Some(context.waker().clone());
        Poll::Pending
    }
}

fn lock<T>(inner: &Mutex<Inner<T>>) -> MutexGuard<'_, Inner<T>> {
    inner.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::arrival;

    #[test]
    fn a_value_arrives_from_another_thread_and_a_dropped_callback_brings_none() {
        let (bringer, value) = arrival();
        let other = std::thread::spawn(move || bringer.bring(7));
        assert_eq!(pollster::block_on(value), Some(7));
        other.join().unwrap();
        let (bringer, value) = arrival::<u32>();
        drop(bringer);
        assert_eq!(pollster::block_on(value), None);
    }
}
