//! Triangles to maps: what each kind of map stores, for every rule, sampling, size and number of threads.

mod casting;
mod deep;
mod facets;
mod hits;
mod masks;
mod normals;
mod pass1;
mod shapes;
mod streamed;
