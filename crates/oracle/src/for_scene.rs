//! The oracle asked about a scene of the tracer, of which it takes the geometry alone.

use glam::{DVec3, Vec3};
use model::facets;

use super::{Accuracy, Emitter, Expectation, Facet, FacetHits, expect};
use photon_mapping::scene::Scene;
use photon_mapping::scene::triangle::Triangle;

/// Which face of the model a number belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FacetId {
    /// The mesh object, by its place in the model file.
    pub surface: usize,
    /// The face of that mesh object.
    pub facet: usize,
}

/// Expected hits on every face of `scene` when its lights send out `photons_per_light`, and the
/// faces in the order of the hits, which is the model file's.
pub fn expect_for_scene(
    scene: &Scene,
    photons_per_light: &[u64],
    accuracy: Accuracy,
) -> (Vec<FacetId>, Expectation) {
    let emitted: u64 = photons_per_light.iter().sum();
    let share = |photons: u64| photons as f64 / emitted.max(1) as f64;
    let emitters: Vec<_> = scene
        .lights()
        .iter()
        .zip(photons_per_light)
        .map(|(light, photons)| Emitter {
            position: figures(light.position),
            share: share(*photons),
        })
        .collect();
    let mut ids: Vec<FacetId> = Vec::new();
    let mut owners = Vec::new();
    let mut all_facets = Vec::new();
    for triangles in facets::facets(scene) {
        let first = &triangles[0];
        ids.push(FacetId { surface: first.parent_mesh_object, facet: first.facet });
        let material = scene.mesh_objects()[first.parent_mesh_object].material;
        let survival = figure(material.base_diffuse_reflection().max_element());
        for vertices in polygons(triangles) {
            owners.push(ids.len() - 1);
            let normal = first.normal.as_dvec3();
            all_facets.push(Facet {
                surface: first.parent_mesh_object,
                vertices,
                normal,
                survival,
            });
        }
    }
    let mut expectation = expect(&all_facets, &emitters, accuracy);
    expectation.facets = join(expectation.facets, &owners, ids.len());
    (ids, expectation)
}

/// The face of `triangles`, a fan about its first corner, as one polygon where it is flat and
/// convex, else as its triangles.
fn polygons(triangles: &[Triangle]) -> Vec<Vec<DVec3>> {
    let fan: Vec<_> = triangles.iter().map(|triangle| triangle.vertices.map(figures)).collect();
    let mut polygon = vec![fan[0][0], fan[0][1]];
    polygon.extend(fan.iter().map(|[_, _, last]| *last));
    let is_fan = fan.windows(2).all(|pair| pair[0][0] == pair[1][0] && pair[0][2] == pair[1][1]);
    if is_fan && is_flat_and_convex(&polygon) {
        vec![polygon]
    } else {
        fan.into_iter().map(Vec::from).collect()
    }
}

fn is_flat_and_convex(polygon: &[DVec3]) -> bool {
    let count = polygon.len();
    let turn = |k: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| polygon[(k + step) % count]);
        (b - a).cross(c - b)
    };
    let area: DVec3 = (0..count).map(turn).sum();
    let normal = area.normalize_or_zero();
    let size = polygon.iter().map(|corner| corner.distance(polygon[0])).fold(0.0, f64::max);
    let is_flat = polygon.iter().all(|p| normal.dot(*p - polygon[0]).abs() <= 1e-7 * size);
    is_flat && (0..count).all(|k| turn(k).dot(normal) > 0.0)
}

fn join(hits: Vec<FacetHits>, owners: &[usize], count: usize) -> Vec<FacetHits> {
    let mut joined: Vec<Option<FacetHits>> = vec![None; count];
    for (part, owner) in hits.into_iter().zip(owners) {
        match &mut joined[*owner] {
            empty @ None => *empty = Some(part),
            Some(whole) => {
                for (sums, parts) in
                    [(&mut whole.hits, &part.hits), (&mut whole.error, &part.error)]
                {
                    sums.resize(sums.len().max(parts.len()), 0.0);
                    sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
                }
            }
        }
    }
    joined.into_iter().flatten().collect()
}

/// The figures that a model file has for `vector`.
fn figures(vector: Vec3) -> DVec3 {
    DVec3::from_array(vector.to_array().map(figure))
}

/// The shortest decimal that rounds to `float`: what stood in the model file, where the tracer had
/// to round it to f32 and the oracle has not.
fn figure(float: f32) -> f64 {
    float.to_string().parse().expect("what a number prints as is a number")
}
