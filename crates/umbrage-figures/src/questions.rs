//! Questions that readers come with, and the figures that answer them.

/// A question and the ids of its figures, the best first.
pub const QUESTIONS: &[(&str, &[&str])] = &[
    (
        "Why does my shadow have stripes or speckles on surfaces that should be lit?",
        &["W92-F1", "WM94-F2", "R87-F9", "U-acne", "U-faults"],
    ),
    ("Why is the shadow detached from what casts it?", &["WM94-F3", "WM94-F4", "U-faults", "U-bias"]),
    (
        "Which bias do I need, and what does my engine's default do?",
        &["U-acne", "U-bias", "U-offsets", "WM94-pcfbias", "R87-F9"],
    ),
    ("Can I do without a bias?", &["U-auto", "W92-F3", "WM94-F5", "WM94-F6", "B06-I75"]),
    ("Why does light leak in where things touch or are thin?", &["WM94-F7", "WM94-F12", "U-presets", "U-auto-where"]),
    ("Why are the shadow's edges jagged?", &["R87-F6", "R87-F2", "U-auto"]),
    ("Why is the shadow noisy?", &["R87-F7", "U-noise", "R87-pass1", "W78-F4"]),
    ("How do shadows become softer with distance?", &["R87-nopen", "B06-I76", "U-softness", "U-auto-area"]),
    (
        "How large must the map be, and how much memory does it take?",
        &["R87-F10", "U-sizes", "U-auto-bytes", "R87-T2", "U-storage", "U-paging"],
    ),
    ("What do shadows cost in time?", &["R87-T1", "W78-cost", "W92-cost", "WM94-cost"]),
    ("What if the light shines in all directions, or is a wide spot?", &["R87-omni", "W92-rim"]),
    ("What about glass, leaves, hair and things that move?", &["B06-deep", "U-auto-kinds"]),
    ("What does a low sun do?", &["U-grazing", "WM94-F9"]),
    ("Does it matter how depths are stored?", &["R87-float", "W78-F3", "R87-T2", "U-storage"]),
    ("Which method suits my scene?", &["U-presets", "U-sizes", "U-grazing"]),
    (
        "How good is the default, and where is it wrong?",
        &["U-auto", "U-auto-ladder", "U-auto-common", "U-auto-kinds", "U-auto-where"],
    ),
    ("Are the papers' listings right as printed?", &["R87-F4", "WM94-F10"]),
];
