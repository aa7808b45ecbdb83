use glam::DVec3;

/// The barycentric weights of a point of a triangle's plane, clamped to the triangle; `None` where it has no area, and for a point that
/// is not finite.
pub(crate) fn weights(at: DVec3, [a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (ab, ac, ap) = (b - a, c - a, at - a);
    let (d00, d01, d11) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    let (d20, d21) = (ap.dot(ab), ap.dot(ac));
    let area = d00 * d11 - d01 * d01;
    if area <= 0.0 {
        return None;
    }
    let (v, w) = ((d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area);
    if v.is_nan() || w.is_nan() {
        return None;
    }
    let v = v.clamp(0.0, 1.0);
    let w = w.clamp(0.0, 1.0 - v);
    Some(DVec3::new(1.0 - v - w, v, w))
}
