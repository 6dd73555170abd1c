//! The scene `terrain`: a fractal landscape, triangulated by greedy insertion, with its horizons and groups, boxes on
//! it, and a sun.

use antumbra_terrain::{Field, PreparedScene, RasterDetail, Terrain, TerrainError};

mod boxes;
mod fractal;
mod options;

use boxes::spread_boxes;
pub use fractal::FractalOptions;
pub use options::TerrainSceneOptions;

impl TerrainSceneOptions {
    /// Builds the scene. `done` is called after each sector of horizons, from several threads.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for an option out of range.
    pub fn scene(&self, done: &(dyn Fn() + Sync)) -> Result<PreparedScene, TerrainError> {
        let seed = self.landscape.seed;
        let field = Field::from_raster(
            &self.landscape.raster()?,
            RasterDetail::Vertices(self.vertices),
        )?;
        let prepare = self.prepare.seeded(seed, &field);
        let terrain = Terrain::prepare(field, &prepare, done)?;
        let mut made = PreparedScene::from_terrain(terrain, "terrain")?;
        spread_boxes(&mut made.scene, &made.terrain, self.boxes, seed)?;
        Ok(made)
    }
}
