//! Good files with something broken: each is read, or refused by one line, and none takes more memory than was allowed.

use cap::Cap;
use umbrage_fuzz::{Mutants, TARGETS, most_bytes};

/// Counts what is allocated. It counts for the whole program, which is why all is one test.
#[global_allocator]
static ALLOCATOR: Cap<std::alloc::System> = Cap::new(std::alloc::System, usize::MAX);

/// Of every target.
const MUTANTS: usize = 20_000;

#[test]
fn mutants_end_in_a_result_or_a_line_within_their_memory() {
    // Those of glTF are in `gltf_mutants`, whose scene has everything.
    for target in TARGETS.iter().filter(|target| target.name != "gltf") {
        // Lines are read one by one, but a command begins with its options and its map, which takes longer than some lines.
        let together = if target.name == "lookup_lines" { 4 } else { 1 };
        let seeds = (target.seeds)();
        let before = ALLOCATOR.allocated();
        let (mut read, mut count) = (0, 0);
        for (seed, file) in (1..).zip(&seeds) {
            assert!((target.takes)(file), "{}: the good file {seed}", target.name);
            let mut mutants = Mutants::of(file, seed);
            for _ in 0..MUTANTS.div_ceil(together * seeds.len()) {
                let some: Vec<Vec<u8>> = mutants.by_ref().take(together).collect();
                read += usize::from((target.takes)(&some.join(&b'\n')));
                count += 1;
            }
        }
        let most = ALLOCATOR.max_allocated() - before;
        assert!((1..count).contains(&read), "{}: {read} of {count} were read", target.name);
        assert!(most as u64 <= most_bytes(&[]), "{}: {most} bytes", target.name);
    }
}
