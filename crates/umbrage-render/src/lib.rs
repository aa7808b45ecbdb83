//! Pass 1 (depth maps), pass 2 (images) and shading.
