//! What the rasteriser promises, checked against naive exact arithmetic and ray casting.

mod depth;
mod indexed;
mod input;
mod meshes;
mod near;
mod oracle;
mod scenes;
mod spans;
mod tiles;
mod triangles;
