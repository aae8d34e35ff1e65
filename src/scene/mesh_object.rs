//! A named surface of the scene: triangles that share a material.

use super::material::Material;

/// One object of the model file. Its triangles stand in [`super::Scene::triangles`].
#[derive(Clone, Debug, PartialEq)]
pub struct MeshObject {
    /// The object's name in the model file.
    pub name: String,
    /// What all of its triangles are made of: C++ `MeshObject::GetMaterial()`.
    pub material: Material,
}
