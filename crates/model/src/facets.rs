//! The flat faces of a scene: a quad of the model is one facet of two triangles.

use photon_mapping::scene::Scene;
use photon_mapping::scene::triangle::Triangle;

/// The facets of `scene`, each as its triangles, in the model's order.
pub fn facets(scene: &Scene) -> impl Iterator<Item = &[Triangle]> {
    scene.triangles().chunk_by(|a, b| facet_of(a) == facet_of(b))
}

/// The index of the facet, in the order of [`facets`], of every triangle of `scene`.
pub fn facet_of_triangles(scene: &Scene) -> Vec<usize> {
    let facets = facets(scene).enumerate();
    facets.flat_map(|(index, triangles)| vec![index; triangles.len()]).collect()
}

fn facet_of(triangle: &Triangle) -> (usize, usize) {
    (triangle.parent_mesh_object, triangle.facet)
}
