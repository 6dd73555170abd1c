//! What is removed when the process ends before its work is done: parts, locks, and folders that were made for outputs.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
/// Changed under the lock of the list alone.
static FINISHED: AtomicU64 = AtomicU64::new(0);

/// The list of what is unfinished. While it is held, no signal ends the process ([`discard_all`] waits for it).
pub(crate) struct Unfinished(MutexGuard<'static, BTreeSet<PathBuf>>);

pub(crate) fn unfinished() -> Unfinished {
    // The list is whole even where a thread ended while it held it.
    Unfinished(UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Removes every unfinished file of this process, and the folders that were made for outputs and are empty. For the end of the process: no
/// file can be begun or finished after it, and a thread that tries waits.
///
/// A set of files that is just taking its place is waited for.
pub fn discard_all() {
    let Unfinished(list) = unfinished();
    // Backwards, what is in a folder comes before the folder.
    for path in list.iter().rev() {
        // What cannot be removed now is swept by a later run.
        let _ = fs::remove_file(path).or_else(|_| fs::remove_dir(path));
    }
    std::mem::forget(list);
}

/// How many files this process has finished so far. After [`discard_all`] the number is final.
#[must_use]
pub fn finished() -> u64 {
    FINISHED.load(Ordering::Relaxed)
}

/// A path on the list, until it is dropped.
#[derive(Debug)]
pub(crate) struct Discarded(PathBuf);

impl Discarded {
    pub(crate) fn add(list: &mut Unfinished, path: &Path) -> Self {
        list.0.insert(path.to_owned());
        Self(path.to_owned())
    }

    /// Takes the path off the list, which the caller holds, and counts the file.
    pub(crate) fn finish(mut self, list: &mut Unfinished) {
        FINISHED.fetch_add(1, Ordering::Relaxed);
        self.take_off(list);
    }

    /// Takes the path off the list, which the caller holds.
    pub(crate) fn take_off(&mut self, list: &mut Unfinished) {
        let path = std::mem::take(&mut self.0);
        list.0.remove(&path);
    }
}

impl Drop for Discarded {
    fn drop(&mut self) {
        if !self.0.as_os_str().is_empty() {
            unfinished().0.remove(&self.0);
        }
    }
}
