//! The three builders of second surfaces, tags, and texels sampled at several places.

use glam::{DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::{bake, bake_by_normals, bake_multi, bake_tags};
use umbrage_depth::{BackFace, DepthMap, First, Midpoint, Reduction, SameSurface, Second, Tiled};
use umbrage_plane::{Sampling, SurfacePoint, TexelRect, View};
use umbrage_raster::Cull;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Soup, light_map, picture};
use umbrage_scene::{Material, Mesh, Object, Scene, gallery};
use umbrage_shadow::Shadow;

const GREY: Material = Material::matt(Vec3::splat(0.7));

fn view(scene: &Scene, side: u32) -> View {
    scene.lights[0].view.with_size(UVec2::splat(side)).unwrap()
}

fn with(objects: Vec<Object>) -> Scene {
    Scene { objects, ..gallery::sphere_plane() }
}

fn texels(a: &impl DepthMap, b: &impl DepthMap) -> (usize, usize) {
    let size = a.view().size();
    let all = TexelRect::of_size(size).texels();
    let seen = all.filter(|texel| a.depth(*texel).is_finite() || b.depth(*texel).is_finite());
    seen.fold((0, 0), |(apart, seen), texel| (apart + usize::from(a.depth(texel) != b.depth(texel)), seen + 1))
}

#[test]
fn wm94_1_wm94_2_two_buffers_and_culling_agree_on_solids_apart() {
    for scene in [gallery::sphere_plane(), gallery::box_plane()] {
        let view = view(&scene, 256);
        let soup = Soup::casters(&scene, &view);
        let second = bake(&view, soup.triangles(), &Second, Cull::None).map;
        let tested = bake(&view, soup.triangles(), &BackFace, Cull::None).map;
        let culled = bake(&view, soup.triangles(), &BackFace, Cull::Front).map;
        assert_eq!(tested, culled, "the rule and the rasteriser's culling");
        let (apart, seen) = texels(&second, &culled);
        assert!(seen > 10_000);
        assert_eq!(apart, 0, "{}", scene.name);
    }
}

#[test]
fn wm94_1_normals_that_are_flat_are_culling_and_smooth_ones_differ_at_silhouettes_alone() {
    // A box has flat normals: the test of N·L is that of its faces.
    let scene = gallery::box_plane();
    let view_ = view(&scene, 256);
    let soup = Soup::casters(&scene, &view_);
    let culled = bake(&view_, soup.triangles(), &BackFace, Cull::Front).map;
    assert_eq!(bake_by_normals(&view_, soup.casting(), &BackFace).map, culled);
    // A sphere's interpolated normals turn away within its last ring of triangles.
    let round = with(vec![Object::solid("ball", Mesh::sphere(Vec3::new(0.0, 0.0, 25.0), 12.0, 96), GREY)]);
    let view_ = view(&round, 256);
    let soup = Soup::casters(&round, &view_);
    let culled = bake(&view_, soup.triangles(), &BackFace, Cull::Front).map;
    let smooth = bake_by_normals(&view_, soup.casting(), &BackFace).map;
    let centre = view_.eye_to_texel(view_.world_to_eye().transform_point3(DVec3::new(0.0, 0.0, 25.0)));
    let radius = TexelRect::of_size(view_.size())
        .texels()
        .filter(|texel| culled.depth(*texel).is_finite())
        .map(|texel| (texel.as_dvec2() + 0.5 - centre).length())
        .fold(0.0, f64::max);
    let mut apart = 0;
    for texel in TexelRect::of_size(view_.size()).texels() {
        if culled.depth(texel) != smooth.depth(texel) {
            apart += 1;
            let out = (texel.as_dvec2() + 0.5 - centre).length() / radius;
            assert!(out > 0.97, "{texel} is at {out} of the radius");
        }
    }
    assert!(apart < texels(&culled, &smooth).1 / 20, "{apart}");
}

#[test]
fn wm94_14_an_open_mesh_passed_off_as_solid_throws_no_shadow_and_a_sheet_does() {
    let corners = [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, 20.0));
    let sheet = Object::two_sided("sheet", umbrage_scene::Shape::Mesh(Mesh::sheet(corners, 2)), GREY);
    for (solid, surfaces) in [(true, false), (false, true)] {
        let scene = with(vec![Object { solid, ..sheet.clone() }]);
        let view = view(&scene, 64);
        for map in [
            bake(&view, Soup::casters(&scene, &view).triangles(), &Second, Cull::None).map,
            bake(&view, Soup::casters(&scene, &view).triangles(), &BackFace, Cull::Front).map,
            bake_by_normals(&view, Soup::casters(&scene, &view).casting(), &BackFace).map,
        ] {
            assert_eq!(map.tile_count() > 0, surfaces, "solid: {solid}");
        }
    }
}

#[test]
fn wm94_16_tags_are_the_nearest_objects() {
    let scene = gallery::sphere_plane();
    let view = view(&scene, 128);
    let soup = Soup::casters(&scene, &view);
    let tags = bake_tags(&view, soup.triangles());
    let first = bake(&view, soup.triangles(), &First, Cull::None).map;
    let alone = |object: usize| {
        let one = with(vec![scene.objects[object].clone()]);
        bake(&view, Soup::casters(&one, &view).triangles(), &First, Cull::None).map
    };
    let maps = [alone(0), alone(1)];
    let mut counted = [0; 3];
    for texel in TexelRect::of_size(view.size()).texels() {
        let nearest =
            (0..2).find(|&object| maps[object].depth(texel) == first.depth(texel) && first.depth(texel).is_finite());
        assert_eq!(tags.id(texel), nearest.map(|object| object as u32), "{texel}");
        counted[nearest.unwrap_or(2)] += 1;
    }
    assert!(counted.iter().all(|&texels| texels > 100), "{counted:?}");
}

#[test]
fn w92_3_texels_sampled_at_several_places_keep_the_two_nearest_surfaces_over_them() {
    let scene = gallery::sphere_plane();
    let view = view(&scene, 64);
    let soup = Soup::casters(&scene, &view);
    let axis = 4;
    let fine_view = view.with_size(view.size() * axis).unwrap();
    let fine = bake(&fine_view, soup.triangles(), &First, Cull::None).map;
    let multi = bake_multi(&view, soup.triangles(), &First, Cull::None, axis).unwrap().map;
    let within = |map: &Tiled, texel: IVec2| -> Vec<f32> {
        let corner = texel * axis as i32;
        TexelRect::new(corner, corner + axis as i32).texels().map(|at| map.depth(at)).collect()
    };
    for texel in TexelRect::of_size(view.size()).texels() {
        let nearest = within(&fine, texel).into_iter().fold(f32::INFINITY, f32::min);
        assert_eq!(multi.depth(texel), nearest, "{texel}");
    }
    // Midpoints of whole texels lie behind every place of the nearest surface: no acne, whatever the texel.
    let rule = Midpoint::default().with_same(SameSurface::Surface);
    let middle = bake_multi(&view, soup.triangles(), &rule, Cull::None, axis).unwrap().map;
    let by_depth = bake_multi(&view, soup.triangles(), &Midpoint::default(), Cull::None, axis).unwrap().map;
    let on_surface = |map: &Tiled| {
        let behind =
            |texel: &IVec2| within(&fine, *texel).iter().any(|depth| depth.is_finite() && *depth > map.depth(*texel));
        // Texels a texel and more from any silhouette: there the front meets its own back, and nothing lies between them.
        let tags = bake_tags(&fine_view, soup.triangles());
        let one = |texel: &IVec2| {
            let (low, high) = ((*texel - 1) * axis as i32, (*texel + 2) * axis as i32);
            let ids: Vec<_> = TexelRect::new(low, high).texels().map(|at| tags.id(at)).collect();
            ids[0].is_some() && ids.iter().all(|id| *id == ids[0])
        };
        TexelRect::of_size(view.size()).texels().filter(|texel| one(texel) && behind(texel)).count()
    };
    assert_eq!(on_surface(&middle), 0);
    assert!(on_surface(&by_depth) > 500, "one surface taken for two: {}", on_surface(&by_depth));
    // A size that is no multiple of a tile, three samples a side, jittered places.
    let odd = view.with_size(UVec2::new(75, 41)).unwrap().with_sampling(Sampling::Jittered { seed: 4 });
    let many = odd.with_size(odd.size() * 3).unwrap();
    let fine = bake(&many, soup.triangles(), &First, Cull::None).map;
    let multi = bake_multi(&odd, soup.triangles(), &First, Cull::None, 3).unwrap().map;
    for texel in TexelRect::of_size(odd.size()).texels() {
        let parts = TexelRect::new(texel * 3, texel * 3 + 3).texels();
        let nearest = parts.map(|part| fine.depth(part)).fold(f32::INFINITY, f32::min);
        assert_eq!(multi.depth(texel), nearest, "{texel}");
    }
    assert!(bake_multi(&view, soup.triangles(), &First, Cull::None, 0).is_err());
    assert!(bake_multi(&view, soup.triangles(), &First, Cull::None, 600).is_err());
}

#[test]
fn w92_11_memory_does_not_grow_with_the_number_of_objects() {
    // The same texels behind one, two and fifty panes: maps of one surface are as large, deep ones are not.
    let stack = |count: u8| {
        let pane = |i: u8| {
            let low = Vec3::new(-20.0, -20.0, f32::from(i) * 0.4);
            let mesh = Mesh::cuboid(low, low + Vec3::new(40.0, 40.0, 0.2));
            Object { passes: Vec3::splat(0.9), ..Object::solid("pane", mesh, GREY) }
        };
        with((0..count).map(pane).collect())
    };
    let bytes = |count: u8, recipe: &str| {
        let scene = stack(count);
        let recipe: Recipe = recipe.parse().unwrap();
        // From straight above: all panes cover the same texels.
        let above = View::orthographic(DVec3::Z * 99.0, DVec3::ZERO, DVec3::Y, 30.0, 1.0, 200.0, UVec2::splat(128));
        light_map(&recipe, &scene, &above.unwrap()).bytes()
    };
    for recipe in ["reeves87", "woo92", "wang-molnar94", "wang-molnar94,stored=second"] {
        assert!(bytes(1, recipe) > 4096);
        assert_eq!([1, 2, 50].map(|count| bytes(count, recipe)), [bytes(1, recipe); 3], "{recipe}");
    }
    assert!(bytes(50, "reeves87,stored=deep,epsilon=0") > 10 * bytes(2, "reeves87,stored=deep,epsilon=0"));
    assert_eq!(
        size_of::<<Midpoint as Reduction>::Cell>(),
        16,
        "two keys and what tells surfaces apart, while a map is drawn"
    );
}

#[test]
fn wm94_11_shadows_may_be_given_the_interpolated_normal() {
    use std::sync::Mutex;
    struct Heard(Mutex<Vec<Vec3>>);
    impl Shadow for Heard {
        fn fractions(&self, at: &[SurfacePoint], _key: umbrage_sample::Key, out: &mut [f32]) {
            out.fill(0.0);
            self.0.lock().unwrap().extend(at.iter().filter(|point| point.object == 0).map(|point| point.normal));
        }
    }
    let scene = gallery::sphere_plane();
    let scene = Scene { camera: scene.camera.with_size(UVec2::splat(64)).unwrap(), ..scene };
    let centre = Vec3::new(0.0, 0.0, 25.0);
    let told = |smooth: bool| {
        let heard = Heard(Mutex::new(Vec::new()));
        let seen = picture(&scene, &[&heard], &Frame { smooth, ..Frame::CENTRES });
        let on_ball = (0..seen.object.len()).filter(|&i| seen.object[i] == 0);
        let radial: Vec<Vec3> = on_ball.map(|i| (seen.position[i].as_vec3() - centre).normalize()).collect();
        let normals = heard.0.into_inner().unwrap();
        // Tiles come in any order: compare the largest angle to the nearest radial direction.
        let worst = |normal: &Vec3| radial.iter().map(|way| way.dot(*normal)).fold(-1.0, f32::max);
        (normals.iter().map(worst).fold(1.0, f32::min), seen.facing)
    };
    let ((smooth, facing), (flat, also)) = (told(true), told(false));
    assert!(smooth > 0.99999 && flat < smooth, "{smooth} against {flat}");
    assert_eq!(facing, also, "the measure's cosine stays geometric");
}

#[test]
fn threads_change_no_bit_of_any_builder() {
    let scene = gallery::spot_room();
    let view = view(&scene, 200);
    let soup = Soup::casters(&scene, &view);
    let all = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let multi = bake_multi(&view, soup.triangles(), &Second, Cull::None, 2).unwrap().map;
            (multi, bake_by_normals(&view, soup.casting(), &BackFace).map, bake_tags(&view, soup.triangles()))
        })
    };
    assert!(all(1) == all(3));
}

#[test]
fn t_1_w92_9_a_single_sheet_over_a_floor_that_is_left_out_loses_its_shadow_to_midpoints_and_a_solid_does_not() {
    let sheet = |height: f32| {
        let corners = [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, height));
        Object::two_sided("sheet", umbrage_scene::Shape::Mesh(Mesh::sheet(corners, 1)), GREY)
    };
    let solid = |height: f32| {
        let mesh = Mesh::cuboid(Vec3::new(-9.0, -9.0, height), Vec3::new(9.0, 9.0, height + 2.0));
        Object::solid("board", mesh, GREY)
    };
    let floor = |casts| {
        let mesh = Mesh::cuboid(Vec3::new(-60.0, -60.0, -4.0), Vec3::new(60.0, 60.0, 0.0));
        Object { casts, ..Object::solid("floor", mesh, GREY) }
    };
    let recipe: Recipe = "woo92".parse().unwrap();
    let shadow = |caster: Object, casts: bool| {
        let scene = with(vec![caster, floor(casts)]);
        // Below the middle of the caster, along the light.
        let view = view(&scene, 256);
        let away = (DVec3::new(0.0, 0.0, 20.0) - view.light().truncate()).normalize();
        let under = DVec3::new(0.0, 0.0, 20.0) + away * (20.0 / -away.z);
        let map = light_map(&recipe, &scene, &view);
        let shadow = recipe.bind(map, umbrage_depth::Storage::Tiled).unwrap();
        shadow.fraction(&SurfacePoint::at(under.as_vec3(), Vec3::Z), umbrage_sample::Key::new(0, 0, 0))
    };
    assert_eq!(shadow(sheet(20.0), false), 0.0, "one surface is none");
    assert_eq!(shadow(sheet(20.0), true), 1.0, "the floor in the map is the second");
    assert_eq!(shadow(solid(20.0), false), 1.0, "a solid has two of its own");
}

#[test]
fn t_8_wm94_4_shading_darkens_the_backs_of_solids_and_lights_the_side_of_a_sheet_that_faces_the_light() {
    // The light stands on the camera's side of a sheet and on the far side of a ball.
    let ball = Object::solid("ball", Mesh::sphere(Vec3::new(30.0, 0.0, 20.0), 8.0, 48), GREY);
    let corners = [(-30.0, -10.0), (-10.0, -10.0), (-10.0, 10.0), (-30.0, 10.0)].map(|(x, y)| Vec3::new(x, y, 20.0));
    let shape = umbrage_scene::Shape::Mesh(Mesh::sheet(corners, 1));
    let sheet = Object::two_sided("sheet", shape, GREY);
    let camera =
        View::orthographic(DVec3::Z * 80.0, DVec3::ZERO, DVec3::Y, 40.0, 1.0, 200.0, UVec2::splat(80)).unwrap();
    let lit_from = |z: f64| {
        let to_light = DVec3::new(0.0, 0.0, z);
        let light = umbrage_scene::Light::directional("sun", to_light, DVec3::ZERO, 60.0, 1.0, 300.0, UVec2::splat(64));
        let scene = Scene {
            lights: vec![light.unwrap()],
            ambient: Vec3::ZERO,
            camera,
            ..with(vec![ball.clone(), sheet.clone()])
        };
        let seen = picture(&scene, &[&umbrage_shadow::Unshadowed], &Frame::CENTRES);
        let brightest = |object: u32| {
            let all = (0..seen.object.len()).filter(|&i| seen.object[i] == object && seen.share[i] == 1.0);
            all.map(|i| seen.colour[i].max_element()).fold(0.0, f32::max)
        };
        [brightest(0), brightest(1)]
    };
    let (front, back) = (lit_from(1.0), lit_from(-1.0));
    assert!(front[0] > 0.6 && front[1] > 0.6, "{front:?}");
    assert_eq!(back, [0.0, 0.0], "nothing that faces away is lit by |N·L|");
}
