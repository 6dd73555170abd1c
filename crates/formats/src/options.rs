//! The limits of loading.

/// The limits of loading. A file that exceeds one is refused before memory is allocated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadOptions {
    /// Bytes of the file and of all files it refers to, in total.
    pub max_file_bytes: u64,
    /// Vertices of all meshes. One takes up to 36 bytes.
    pub max_vertices: u64,
    /// Triangles, lines and points of all meshes. One takes up to 12 bytes.
    pub max_triangles: u64,
    /// Entities. One takes about 500 bytes.
    pub max_entities: u64,
    /// Pixels of all images. One takes 4 bytes.
    pub max_image_pixels: u64,
    /// Objects and arrays in the JSON of a glTF, of a CityJSON document or of one line of a CityJSON sequence, plus a
    /// sixteenth of its commas. One takes up to about 700 bytes while the file is read.
    pub max_json_objects: u64,
    /// Bytes of memory of everything that the file becomes: geometry, names, images and what is derived of them, up to the GPU's copies and the
    /// proxies. They are estimated, and taken before they are allocated.
    pub max_memory: u64,
    /// Steps of work that grow with the product of two of the file's numbers, such as morph targets times vertices. A step takes some
    /// nanoseconds.
    pub max_work: u64,
    /// Whether images are left out. Materials keep their colours.
    pub skip_images: bool,
    /// Whether a file is refused of which anything but shading details is left out.
    pub strict: bool,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            max_file_bytes: 2 << 30,
            max_vertices: 64_000_000,
            max_triangles: 128_000_000,
            max_entities: 4_000_000,
            max_image_pixels: 1 << 28,
            max_json_objects: 6_000_000,
            max_memory: antumbra_files::default_memory(),
            max_work: 1 << 30,
            skip_images: false,
            strict: false,
        }
    }
}
