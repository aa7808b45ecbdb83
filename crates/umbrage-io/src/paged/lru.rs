/// No slot.
const NONE: u32 = u32::MAX;

/// Values of the keys that were looked up last; when all slots are taken, the value of the key whose look-up was longest ago gives way.
#[derive(Debug)]
pub(super) struct Lru<T> {
    /// The slot of each key.
    slot_of: Vec<u32>,
    /// Linked in a ring by when they were looked up.
    slots: Vec<Slot<T>>,
    newest: u32,
    most: usize,
}

#[derive(Debug)]
struct Slot<T> {
    key: usize,
    value: T,
    /// Of the newest slot, the oldest.
    newer: u32,
    /// Of the oldest slot, the newest.
    older: u32,
}

impl<T> Lru<T> {
    /// For keys below `keys`, which are fewer than 2³² − 1; of `most` slots, one at least.
    pub(super) fn new(keys: usize, most: usize) -> Self {
        Self { slot_of: vec![NONE; keys], slots: Vec::new(), newest: 0, most }
    }

    /// The values that are kept, in no order that matters.
    pub(super) fn values(&self) -> impl ExactSizeIterator<Item = &T> {
        self.slots.iter().map(|slot| &slot.value)
    }

    /// The key's value, made when it is not kept; now the newest.
    pub(super) fn get_or_make(&mut self, key: usize, make: impl FnOnce() -> T) -> &T {
        let found = self.slot_of[key];
        if found != NONE {
            self.unlink(found);
            self.link(found);
        } else if self.slots.len() < self.most {
            self.slots.push(Slot { key, value: make(), newer: NONE, older: NONE });
            self.link(self.slots.len() as u32 - 1);
        } else {
            // The oldest slot is reused; it becomes the newest by turning the ring.
            self.newest = self.slots[self.newest as usize].newer;
            let slot = &mut self.slots[self.newest as usize];
            self.slot_of[slot.key] = NONE;
            (slot.key, slot.value) = (key, make());
        }
        self.slot_of[key] = self.newest;
        &self.slots[self.newest as usize].value
    }

    fn unlink(&mut self, slot: u32) {
        let Slot { newer, older, .. } = self.slots[slot as usize];
        self.slots[newer as usize].older = older;
        self.slots[older as usize].newer = newer;
        if slot == self.newest {
            self.newest = older;
        }
    }

    /// Makes a slot that is not in the ring its newest.
    fn link(&mut self, slot: u32) {
        // Alone, it is its own neighbour on both sides.
        let newest = if self.slots.len() == 1 { slot } else { self.newest };
        let oldest = if self.slots.len() == 1 { slot } else { self.slots[newest as usize].newer };
        self.slots[newest as usize].newer = slot;
        self.slots[oldest as usize].older = slot;
        (self.slots[slot as usize].older, self.slots[slot as usize].newer) = (newest, oldest);
        self.newest = slot;
    }
}
