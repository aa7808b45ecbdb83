//! [`umbrage_fuzz::paging`] over what libFuzzer makes.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    umbrage_fuzz::paging(data);
});
