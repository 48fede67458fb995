//! Instances by handles. A handle is a number that is given once: one that was freed, or never given, is told from one that lives.

use std::any::Any;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use crate::boundary::Logger;
use crate::instance::{Instance, Said};
use crate::outcome::{Outcome, Told};

/// An instance with where its texts go.
struct Entry {
    instance: Instance,
    logger: Logger,
}

type Entries = HashMap<usize, Arc<Mutex<Entry>>>;

static ENTRIES: LazyLock<Mutex<Entries>> = LazyLock::new(Mutex::default);

/// The next handle; not 0, which is NULL.
static NEXT: AtomicUsize = AtomicUsize::new(0x1000);

/// A handle that nothing has had.
pub fn fresh() -> usize {
    NEXT.fetch_add(16, Ordering::Relaxed)
}

fn panicked(what: &(dyn Any + Send)) -> String {
    let text = what
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| what.downcast_ref::<String>().cloned())
        .unwrap_or_default();
    format!("a mistake of the library, please report it: {text}")
}

/// Makes an instance; its handle. What is wrong goes to the logger.
pub fn insert(logger: Logger, make: impl FnOnce() -> Result<Instance, String>) -> Option<usize> {
    let made = catch_unwind(AssertUnwindSafe(make)).unwrap_or_else(|what| Err(panicked(&*what)));
    match made {
        Ok(instance) => {
            let handle = fresh();
            let entry = Arc::new(Mutex::new(Entry { instance, logger }));
            let mut entries = ENTRIES.lock().unwrap_or_else(PoisonError::into_inner);
            entries.insert(handle, entry);
            Some(handle)
        }
        Err(message) => {
            logger.say(Outcome::Refused, &message);
            None
        }
    }
}

/// Forgets an instance.
pub fn remove(handle: usize) {
    let mut entries = ENTRIES.lock().unwrap_or_else(PoisonError::into_inner);
    entries.remove(&handle);
}

/// Does something with an instance. What it says goes to its logger once the instance is free again, which a logger may want.
pub fn call(handle: usize, action: impl FnOnce(&mut Instance, &mut Logger) -> Said) -> Outcome {
    let entries = ENTRIES.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(entry) = entries.get(&handle).cloned() else {
        return Outcome::Refused;
    };
    drop(entries);
    let mut guard = entry.lock().unwrap_or_else(PoisonError::into_inner);
    let Entry { instance, logger } = &mut *guard;
    let said = catch_unwind(AssertUnwindSafe(|| action(instance, logger)))
        .unwrap_or_else(|what| Err(panicked(&*what)));
    let (outcome, message) = match said {
        Ok(None) => return Outcome::Fine,
        Ok(Some(Told {
            outcome,
            text: None,
        })) => return outcome,
        Ok(Some(Told {
            outcome,
            text: Some(text),
        })) => (outcome, text),
        Err(message) => (Outcome::Refused, message),
    };
    let logger = logger.clone();
    drop(guard);
    logger.say(outcome, &message);
    outcome
}
