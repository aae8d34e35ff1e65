//! Large scenes, through their tree.

mod closed_meshes;
mod tree;
