//! What was made already and is kept.

use std::sync::{Arc, Mutex};

/// Each with what it depends on.
type Kept<K, V> = Vec<(K, Arc<V>)>;

/// Things by what they depend on. Clones share what they hold.
#[derive(Debug)]
pub(crate) struct Memo<K, V>(Arc<Mutex<Kept<K, V>>>);

impl<K, V> Clone for Memo<K, V> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<K: PartialEq, V> Memo<K, V> {
    /// What is kept.
    pub fn known(&self, key: &K) -> Option<Arc<V>> {
        let kept = self.0.lock().ok()?;
        kept.iter().find(|(other, _)| other == key).map(|(_, value)| value.clone())
    }

    /// Keeps it.
    pub fn keep(&self, key: K, value: &Arc<V>) {
        if let Ok(mut kept) = self.0.lock() {
            kept.push((key, value.clone()));
        }
    }

    /// What is kept, made only the first time.
    pub fn once(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        if let Some(known) = self.known(&key) {
            return known;
        }
        // Nothing is locked meanwhile: what is made takes all threads, and two callers at once make the same bits.
        let value = Arc::new(make());
        self.keep(key, &value);
        value
    }
}
