//! What is costly to make and is asked for in every frame.

use std::cell::RefCell;
use std::sync::Arc;

/// The last value made, kept for as long as what it was made of stays the same. The value depends on the key alone,
/// so that a frame with a memo is the frame without it.
#[derive(Debug)]
pub struct Memo<K, V>(RefCell<Option<(K, Arc<V>)>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(RefCell::new(None))
    }
}

impl<K: PartialEq, V> Memo<K, V> {
    /// The value for `key`: the one kept, or what `make` gives, which is kept from then on.
    pub fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        if let Some((kept, value)) = &*self.0.borrow()
            && *kept == key
        {
            return Arc::clone(value);
        }
        let value = Arc::new(make());
        *self.0.borrow_mut() = Some((key, Arc::clone(&value)));
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_made_once_for_as_long_as_its_key_stays() {
        let memo = Memo::default();
        let made = std::cell::Cell::new(0);
        let ask = |key: u32| {
            *memo.get(key, || {
                made.set(made.get() + 1);
                key * 10
            })
        };
        assert_eq!([ask(1), ask(1), ask(2), ask(2), ask(1)], [10, 10, 20, 20, 10]);
        assert_eq!(made.get(), 3);
    }
}
