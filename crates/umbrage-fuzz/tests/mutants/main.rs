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
        let seeds = (target.seeds)();
        let start = std::time::Instant::now();
        let before = ALLOCATOR.allocated();
        let mut read = 0;
        for (seed, file) in (1..).zip(&seeds) {
            assert!((target.takes)(file), "{}: the good file {seed}", target.name);
            let mutants = Mutants::of(file, seed).take(MUTANTS.div_ceil(seeds.len()));
            let t = std::time::Instant::now();
            let r = mutants.filter(|mutant| (target.takes)(mutant)).count();
            eprintln!("{} {seed} {} bytes {r} read {:?}", target.name, file.len(), t.elapsed());
            read += r;
        }
        let most = ALLOCATOR.max_allocated() - before;
        eprintln!("{} {:?} {read} {most}", target.name, start.elapsed());
        assert!(read > MUTANTS / 50 && read < MUTANTS, "{}: {read} were read", target.name);
        assert!(most as u64 <= most_bytes(&[]), "{}: {most} bytes", target.name);
    }
}
