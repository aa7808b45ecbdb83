//! Pictures of scenes: cameras, lights, exposures and what is done to pictures afterwards. One program, so that it is linked once.

mod camera;
mod deep;
mod edges;
mod lights;
mod post;
mod second;
mod soup;
