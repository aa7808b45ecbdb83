//! Who may use whom, inside the workspace and outside it.

use toml::{Table, Value};

/// What one package may depend on.
struct Rule {
    package: &'static str,
    /// Packages of the workspace, drawn arrows only: what they imply is allowed too.
    arrows: &'static [&'static str],
    /// Packages from outside.
    outside: &'static [&'static str],
    /// Packages from outside that only its tests and benches use.
    tests: &'static [&'static str],
}

const EVERY: &[&str] = &["umbrage-render", "umbrage-oracle", "umbrage-io"];
const COMMAND: &[&str] =
    &["umbrage-render", "umbrage-oracle", "umbrage-report", "umbrage-gltf", "umbrage-engines", "umbrage-view"];
const FIGURES: &[&str] = &["umbrage-render", "umbrage-oracle", "umbrage-report", "umbrage-engines"];
const PROPERTIES: &[&str] = &["proptest"];

/// The drawing of the architecture page. A package that is not here may not exist.
const RULES: &[Rule] = &[
    Rule { package: "umbrage-plane", arrows: &[], outside: &["fearless_simd", "glam", "thiserror"], tests: PROPERTIES },
    Rule {
        package: "umbrage-sample",
        arrows: &["umbrage-plane"],
        outside: &["fearless_simd", "glam", "rand", "rand_xoshiro"],
        tests: PROPERTIES,
    },
    Rule { package: "umbrage-engines", arrows: &["umbrage-plane"], outside: &["glam", "thiserror"], tests: PROPERTIES },
    Rule {
        package: "umbrage-depth",
        arrows: &["umbrage-plane"],
        outside: &["fearless_simd", "glam", "half", "thiserror"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-raster",
        arrows: &["umbrage-plane"],
        outside: &["fearless_simd", "glam", "rayon"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-bake",
        arrows: &["umbrage-raster", "umbrage-depth"],
        outside: &["fearless_simd", "glam", "rayon"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-shadow",
        arrows: &["umbrage-plane", "umbrage-sample", "umbrage-depth"],
        outside: &["arrayvec", "fearless_simd", "glam", "rayon", "thiserror"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-recipe",
        arrows: &["umbrage-bake", "umbrage-shadow", "umbrage-engines"],
        outside: &["thiserror", "toml"],
        tests: &["glam", "proptest"],
    },
    Rule {
        package: "umbrage-scene",
        arrows: &["umbrage-plane"],
        outside: &["glam", "serde", "thiserror"],
        tests: &["proptest", "serde_json"],
    },
    Rule {
        package: "umbrage-render",
        arrows: &["umbrage-scene", "umbrage-bake", "umbrage-shadow", "umbrage-recipe"],
        outside: &["glam", "rayon"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-oracle",
        arrows: &["umbrage-scene", "umbrage-shadow", "umbrage-recipe"],
        outside: &["glam", "obvhs", "rayon", "thiserror"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-io",
        arrows: &["umbrage-depth"],
        outside: &["exr", "fearless_simd", "glam", "png", "rayon", "thiserror"],
        tests: PROPERTIES,
    },
    Rule {
        package: "umbrage-gltf",
        arrows: &["umbrage-scene"],
        outside: &["base64", "glam", "png", "zune-jpeg", "serde_json", "thiserror"],
        tests: &[],
    },
    Rule {
        package: "umbrage-report",
        arrows: &["umbrage-io"],
        outside: &["anyhow", "glam", "indicatif", "rayon", "serde", "serde_json"],
        tests: &[],
    },
    Rule {
        package: "umbrage-view",
        arrows: &[],
        outside: &["form_urlencoded", "getrandom", "http-body-util", "hyper", "hyper-util", "thiserror", "tokio"],
        tests: &[],
    },
    Rule { package: "umbrage-figures", arrows: FIGURES, outside: &["anyhow", "clap", "glam", "rayon"], tests: &[] },
    Rule {
        package: "umbrage-cli",
        arrows: COMMAND,
        outside: &[
            "anyhow",
            "clap",
            "clap_complete",
            "clap_mangen",
            "ctrlc",
            "glam",
            "indicatif",
            "rayon",
            "serde_json",
        ],
        tests: &["exr"],
    },
    Rule {
        package: "umbrage-bench",
        arrows: EVERY,
        outside: &["cpu-time", "euc", "fearless_simd", "glam", "obvhs", "rayon"],
        tests: &["criterion"],
    },
    Rule { package: "umbrage-examples", arrows: EVERY, outside: &[], tests: &["glam"] },
    Rule {
        package: "umbrage-fuzz",
        arrows: &["umbrage-cli"],
        outside: &["crc32fast", "exr", "glam", "png"],
        tests: &["cap", "miniz_oxide", "serde_json"],
    },
    Rule { package: "umbrage-fuzz-targets", arrows: &["umbrage-fuzz"], outside: &["libfuzzer-sys"], tests: &[] },
    Rule { package: "xtask", arrows: &[], outside: &["anyhow", "proc-macro2", "toml"], tests: &[] },
    Rule { package: "umbrage-tests", arrows: EVERY, outside: &["fearless_simd", "glam", "rayon"], tests: PROPERTIES },
];

fn rule(package: &str) -> Option<&'static Rule> {
    RULES.iter().find(|rule| rule.package == package)
}

/// Whether the drawn arrows lead from a package to another, over however many others.
fn leads(from: &Rule, to: &str) -> bool {
    from.arrows.iter().any(|arrow| *arrow == to || rule(arrow).is_some_and(|next| leads(next, to)))
}

/// Findings of one package's manifest.
pub fn manifest(file: &str, text: &str) -> Vec<String> {
    let finding = |what: String| format!("{file}: {what}");
    let manifest: Table = match text.parse() {
        Ok(manifest) => manifest,
        Err(error) => return vec![finding(format!("is no manifest: {}", error.to_string().replace('\n', " ")))],
    };
    let mut findings = Vec::new();
    let inherits = manifest.get("lints").and_then(|lints| lints.get("workspace")).and_then(Value::as_bool);
    if inherits != Some(true) {
        findings.push(finding("lints are not the workspace's".into()));
    }
    let package = manifest.get("package").and_then(|package| package.get("name")).and_then(Value::as_str).unwrap_or("");
    let Some(rule) = rule(package) else {
        findings.push(finding(format!("{package:?} is not in the drawing of the architecture page")));
        return findings;
    };
    for (dependency, for_tests) in dependencies(&manifest) {
        let internal = RULES.iter().any(|rule| rule.package == dependency) || dependency.starts_with("umbrage-");
        let allowed = if internal {
            leads(rule, &dependency)
        } else {
            let listed = |list: &[&str]| list.contains(&dependency.as_str());
            listed(rule.outside) || (for_tests && listed(rule.tests))
        };
        if !allowed {
            findings.push(finding(format!("{package} may not use {dependency}")));
        }
    }
    findings
}

/// Every direct dependency by its package's own name, and whether only tests and benches use it.
fn dependencies(manifest: &Table) -> Vec<(String, bool)> {
    const KINDS: [(&str, bool); 3] =
        [("dependencies", false), ("build-dependencies", false), ("dev-dependencies", true)];
    let targets = manifest.get("target").and_then(Value::as_table).into_iter().flat_map(Table::values);
    let places = std::iter::once(manifest).chain(targets.filter_map(Value::as_table));
    places
        .flat_map(|place| {
            KINDS.into_iter().flat_map(move |(kind, for_tests)| {
                let listed = place.get(kind).and_then(Value::as_table).into_iter().flatten();
                listed.map(move |(key, value)| {
                    let renamed = value.get("package").and_then(Value::as_str);
                    (renamed.unwrap_or(key).to_string(), for_tests)
                })
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(package: &str, rest: &str) -> Vec<String> {
        manifest("m", &format!("[package]\nname = \"{package}\"\n[lints]\nworkspace = true\n{rest}"))
    }

    #[test]
    fn arrows_may_be_implied_but_not_turned_round() {
        assert!(found("umbrage-oracle", "[dependencies]\numbrage-plane.workspace = true\n").is_empty());
        assert_eq!(
            found("umbrage-plane", "[dependencies]\numbrage-sample.workspace = true\n"),
            ["m: umbrage-plane may not use umbrage-sample"]
        );
        for (package, other) in [("umbrage-shadow", "raster"), ("umbrage-raster", "depth"), ("umbrage-io", "render")] {
            let rest = format!("[dev-dependencies]\numbrage-{other} = {{ path = \"x\" }}\n");
            assert_eq!(found(package, &rest), [format!("m: {package} may not use umbrage-{other}")]);
        }
    }

    #[test]
    fn packages_from_outside_are_listed_wherever_they_hide() {
        assert_eq!(found("umbrage-plane", "[dependencies]\nrayon = \"1\"\n"), ["m: umbrage-plane may not use rayon"]);
        assert_eq!(
            found("umbrage-plane", "[dependencies]\nglam = { package = \"evil\" }\n"),
            ["m: umbrage-plane may not use evil"]
        );
        assert_eq!(
            found("umbrage-plane", "[target.'cfg(unix)'.build-dependencies]\ncc = \"1\"\n"),
            ["m: umbrage-plane may not use cc"]
        );
        assert!(found("umbrage-plane", "[dev-dependencies]\nproptest = \"1\"\n").is_empty());
        assert_eq!(
            found("umbrage-plane", "[dependencies]\nproptest = \"1\"\n"),
            ["m: umbrage-plane may not use proptest"]
        );
    }

    #[test]
    fn manifests_inherit_lints_and_are_in_the_drawing() {
        assert_eq!(manifest("m", "[package]\nname = \"umbrage-plane\"\n"), ["m: lints are not the workspace's"]);
        assert_eq!(found("umbrage-core", ""), ["m: \"umbrage-core\" is not in the drawing of the architecture page"]);
        assert!(manifest("m", "[package")[0].starts_with("m: is no manifest"));
    }

    #[test]
    fn every_arrow_of_the_drawing_leads_to_a_package_of_it_and_never_back() {
        for from in RULES {
            assert!(from.arrows.iter().all(|arrow| rule(arrow).is_some()), "{}", from.package);
            assert!(!leads(from, from.package), "{} leads to itself", from.package);
        }
    }
}
