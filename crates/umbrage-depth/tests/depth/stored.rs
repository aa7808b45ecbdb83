//! The names of what maps store.

use umbrage_depth::Stored;

#[test]
fn names_lead_back_to_what_they_name() {
    for stored in Stored::ALL {
        assert_eq!(Stored::named(stored.name()), Some(stored));
    }
    assert_eq!(Stored::named("First"), None);
}
