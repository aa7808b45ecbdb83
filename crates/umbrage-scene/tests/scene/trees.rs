//! Light trees: nodes with known values, and data against composed code (R87-18).

use glam::{DVec3, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_scene::Light;
use umbrage_scene::tree::{Colour, Cone, Distribution, Emission, Falloff, Mix, Passing, Product, Sight, Sum, Tree};

fn sight(distance: f32, degrees: f32, lit: f32) -> Sight {
    Sight { distance, cos_axis: degrees.to_radians().cos(), transmittance: Vec3::splat(lit) }
}

#[test]
fn r87_18_nodes_have_known_values() {
    let falloff = Falloff { exponent: 2.0, reference: 10.0, most: 4.0 };
    for (distance, want) in [(10.0, 1.0), (20.0, 0.25), (1.0, 4.0), (f32::INFINITY, 1.0)] {
        assert!((falloff.light(&sight(distance, 0.0, 1.0)).x - want).abs() < 1e-6, "{distance}");
    }
    let cone = Cone { inner_deg: 20.0, outer_deg: 40.0 };
    let at = |degrees| cone.light(&sight(1.0, degrees, 1.0)).x;
    assert_eq!((at(0.0), at(19.9), at(40.1), at(180.0)), (1.0, 1.0, 0.0, 0.0));
    assert!(at(25.0) > at(30.0) && at(30.0) > at(35.0));
    let bowl = Distribution(vec![1.0, 0.0, 2.0]);
    let at = |degrees| bowl.light(&sight(1.0, degrees, 1.0)).x;
    for (degrees, want) in [(0.0, 1.0), (45.0, 0.5), (90.0, 0.0), (135.0, 1.0), (180.0, 2.0)] {
        assert!((at(degrees) - want).abs() < 1e-5, "{degrees}: {}", at(degrees));
    }
    assert_eq!(Distribution(Vec::new()).light(&sight(1.0, 5.0, 1.0)), Vec3::ZERO);
    assert_eq!(Tree::Product(Vec::new()).light(&sight(1.0, 0.0, 1.0)), Vec3::ONE);
    assert_eq!(Tree::Sum(Vec::new()).light(&sight(1.0, 0.0, 1.0)), Vec3::ZERO);
}

fn lamp() -> (Tree, impl Emission) {
    let (warm, cool) = (Vec3::new(1.3, 0.9, 0.4), Vec3::new(0.1, 0.2, 0.5));
    let falloff = Falloff { exponent: 1.7, reference: 12.0, most: 9.0 };
    let cone = Cone { inner_deg: 17.0, outer_deg: 61.0 };
    let bowl = Distribution(vec![1.0, 0.9, 0.4, 0.1, 0.0]);
    let data = Tree::Sum(vec![
        Tree::Product(vec![
            Tree::Mix(Box::new([Tree::Cone(cone), Tree::colour(cool), Tree::colour(warm)])),
            Tree::Falloff(falloff),
            Tree::Shadow { recipe: "reeves87,samples=64,res-factor=4".into() },
        ]),
        Tree::Product(vec![Tree::Distribution(bowl.clone()), Tree::colour(cool)]),
    ]);
    let composed =
        Sum(Product(Product(Mix(cone, Colour(cool), Colour(warm)), falloff), Passing), Product(bowl, Colour(cool)));
    (data, composed)
}

proptest! {
    #[test]
    fn r87_18_data_and_composed_code_agree_bit_for_bit(
        distance in prop_oneof![Just(f32::INFINITY), 0.01f32..1e4], degrees in 0f32..180.0, lit in 0f32..1.0,
    ) {
        let (data, composed) = lamp();
        let at = sight(distance, degrees, lit);
        let bits = |light: Vec3| light.to_array().map(f32::to_bits);
        prop_assert_eq!(bits(data.light(&at)), bits(composed.light(&at)));
    }
}

#[test]
fn r87_18_a_tree_is_written_and_read_as_text() {
    let (data, _) = lamp();
    let text = serde_json::to_string(&data).unwrap();
    assert!(text.contains("\"inner_deg\":17.0") && text.contains("samples=64"), "{text}");
    assert_eq!(serde_json::from_str::<Tree>(&text).unwrap(), data);
    let wrong = serde_json::from_str::<Tree>("{\"cone\":{\"inner_deg\":1}}").unwrap_err().to_string();
    assert!(wrong.contains("outer_deg"), "{wrong}");
}

#[test]
fn r87_18_a_light_shines_by_its_tree() {
    let at = DVec3::new(0.0, 10.0, 0.0);
    let light =
        Light::spot("lamp", at, DVec3::ZERO, 90.0, 1.0, 50.0, UVec2::splat(8)).unwrap().coloured(Vec3::splat(0.5));
    let half = Tree::Product(vec![
        Tree::Falloff(Falloff { exponent: 2.0, reference: 10.0, most: 1.0 }),
        Tree::Shadow { recipe: String::new() },
    ]);
    let tree = light.clone().with_tree(half);
    let arriving = |light: &Light, y: f64, lit: f32| light.arriving(DVec3::new(0.0, y, 0.0), Vec3::splat(lit)).1.x;
    assert!((arriving(&tree, 0.0, 1.0) - 0.5).abs() < 1e-6);
    assert!((arriving(&tree, -10.0, 0.5) - 0.5 * 0.25 * 0.5).abs() < 1e-6);
    assert_eq!(arriving(&tree, 11.0, 1.0), 0.0, "behind a spot");
    assert_eq!(arriving(&light, 0.0, 0.25), 0.125, "without a tree: colour times what passes");
    // A tree without a shadow node is not darkened, and says so.
    let open = light.with_tree(Tree::colour(Vec3::ONE));
    assert_eq!(arriving(&open, 0.0, 0.0), 0.5);
    assert!(!open.casts && tree.casts);
}
