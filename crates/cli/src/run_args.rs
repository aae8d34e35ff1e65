//! The options that choose the run; several verbs share them.

use std::path::PathBuf;

use clap::Args;

use super::error::{CliError, escaped};
use super::{output, values};
use model::obj::{self, ModelLight};
use model::placement::Placement;
use photon_list::reader::refuse_pipe;
use photon_mapping::assignment8;
use photon_mapping::scene::Scene;
use variants::reading::Reading;
use variants::run::Run;

/// The options that choose the scene.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// A Wavefront OBJ model, y up, instead of the handout's; it is turned so that z is up. Needs
    /// --light
    #[arg(long, value_name = "FILE.obj", requires = "light")]
    scene: Option<PathBuf>,
    /// A point light of the scene: its position (z up), then its color, white if left out; may be
    /// given several times; lights share the photons by brightness
    #[arg(long, value_name = "x,y,z[,r,g,b]", requires = "scene", value_parser = values::light,
          allow_hyphen_values = true)]
    light: Vec<ModelLight>,
}

impl SceneArgs {
    /// Whether the handout's scene is meant.
    pub fn is_built_in(&self) -> bool {
        self.scene.is_none()
    }

    /// The scene, and where it stands.
    ///
    /// # Errors
    /// When the model cannot be read.
    pub fn load(&self) -> Result<(Scene, Placement), CliError> {
        match &self.scene {
            None => Ok((assignment8::create_scene(), Placement::WORLD)),
            Some(path) => {
                refuse_pipe(path)?;
                let model = obj::load(path)?;
                output::protect(&model.libraries);
                model.notes.iter().for_each(|note| eprintln!("note: {}", escaped(note)));
                Ok(model::place(model, &self.light))
            }
        }
    }
}

/// The options that choose the run of the reference.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The seed of all random numbers: the same seed gives the same photons [default: 148]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(0, u64::MAX))]
    pub seed: Option<u64>,
    /// How many photons are emitted, over all lights, up to 2^32 - 1 [default: 1000000]
    #[arg(long, value_name = "N",
          allow_negative_numbers = true, value_parser = values::whole(1, u64::from(u32::MAX)))]
    pub photons: Option<u64>,
    /// How often a photon may bounce at most, 0 to 1000 times [default: 1000]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(0_i32, 1000))]
    pub max_bounces: Option<i32>,
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Use t and b as equations (7) and (8) give them, without normalizing, to see what that
    /// changes
    #[arg(long)]
    pub letter_of_the_handout: bool,
}

impl RunArgs {
    /// The run, nothing of it traced yet.
    ///
    /// # Errors
    /// When the model cannot be read.
    pub fn load(&self) -> Result<Run, CliError> {
        let seed = self.seed.unwrap_or(assignment8::SEED);
        let photons = self.photons.unwrap_or(assignment8::PHOTON_COUNT);
        let (scene, placement) = self.scene.load()?;
        let mut run = Run::of_scene(scene, placement, seed, photons);
        run.renderer.max_photon_bounces =
            self.max_bounces.unwrap_or(assignment8::MAX_PHOTON_BOUNCES);
        if self.letter_of_the_handout {
            run.reading = Reading::LETTER_OF_THE_HANDOUT;
        }
        Ok(run)
    }
}
