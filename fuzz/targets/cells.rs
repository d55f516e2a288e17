//! The `cells` target; its body is shared with `tests/fuzz_cases.rs`.

#![no_main]

#[path = "../../tests/fuzzing/mod.rs"]
mod fuzzing;

libfuzzer_sys::fuzz_target!(|data: &[u8]| fuzzing::run("cells", data));
