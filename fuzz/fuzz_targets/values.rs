//! [`umbrage_fuzz::values`] over what libFuzzer makes.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    umbrage_fuzz::values(data);
});
