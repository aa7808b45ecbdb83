//! Shadow maps as EXR, pictures as PNG, one safe way to write a file.
